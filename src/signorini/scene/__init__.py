"""Scenes: the whole question, read from a file and validated before any work is done."""
