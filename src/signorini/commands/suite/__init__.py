"""Commands for the problems of the stability suite as files."""
