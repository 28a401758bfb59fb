"""Errors of discrete solutions, their rates, and which of them are round-off alone."""
