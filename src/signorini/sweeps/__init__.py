"""Sweeps: the same scene with other values, point by point, and one table of all."""
