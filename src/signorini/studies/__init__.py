"""Studies: what the software and the paper's choices are measured by, beyond the scenes."""
