"""Errors of discrete solutions against a truth."""

from signorini.errors.reference import ReferenceErrors

__all__ = ["ReferenceErrors"]
