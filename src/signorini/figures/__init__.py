"""Figures of the paper, of any scene and of the studies, drawn from numbers in files.

Nothing is computed here but places on the page: what a figure shows, `signorini.report` computes.
Import the module of the figure, and `figures.style.save_figure`.
"""
