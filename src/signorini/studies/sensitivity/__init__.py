"""The options that the paper leaves open, chosen otherwise: how far its numbers move."""
