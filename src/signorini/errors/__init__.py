"""Errors of discrete solutions against a truth, their rates, and which of them are round-off alone."""
