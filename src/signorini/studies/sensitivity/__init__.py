"""The choices that the paper leaves unsaid, made otherwise: how far its numbers move."""
