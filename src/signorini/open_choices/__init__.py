"""The choices that the paper leaves open: their options, and what they do to its numbers."""
