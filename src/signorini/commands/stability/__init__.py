"""Commands of the study `stability`, one file each."""
