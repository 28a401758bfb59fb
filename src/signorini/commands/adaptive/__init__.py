"""Commands of the study `adaptive`, one file each."""
