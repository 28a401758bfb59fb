"""Triangulations with named boundaries: uniform grids as arithmetic, anything else through
scikit-fem.
"""
