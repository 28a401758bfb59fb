"""The benchmark's figures: time and unknowns against error, growth, where time goes, rivals."""

from signorini.figures.benchmark_bars import draw_rivals, draw_stages
from signorini.figures.benchmark_curves import draw_dofs, draw_error, draw_growth

__all__ = ("draw_dofs", "draw_error", "draw_growth", "draw_rivals", "draw_stages")
