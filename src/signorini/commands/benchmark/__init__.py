"""Commands of the study `benchmark`, one file each."""
