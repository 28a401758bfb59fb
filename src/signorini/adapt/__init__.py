"""Adaptive meshes: solve, certify, mark, refine, until a guaranteed bound is met."""
