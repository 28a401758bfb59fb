"""Figures 5.1-5.3: drawn from numbers in files, nothing is computed here.

Import the room you need: `figures.surface`, `figures.convergence`, and `figures.style.save_figure`.
"""
