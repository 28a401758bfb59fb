"""Commands of the study `sensitivity`, one file each."""
