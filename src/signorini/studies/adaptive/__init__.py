"""Adaptive against uniform meshes: unknowns and time to a guaranteed error."""
