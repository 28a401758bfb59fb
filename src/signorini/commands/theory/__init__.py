"""Commands of the study `theory`, one file each."""
