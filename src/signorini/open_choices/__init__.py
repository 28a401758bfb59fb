"""The choices that the paper leaves open: the options of each, and what another one does to its numbers."""
