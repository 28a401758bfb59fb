"""Triangulations with a labelled boundary: uniform grids by arithmetic, others through files."""
