"""The benchmark's figures: time and unknowns against error, growth, guarantees, rivals."""

from signorini.figures.benchmark_bars import draw_rivals
from signorini.figures.benchmark_curves import draw_dofs, draw_error, draw_growth
from signorini.figures.benchmark_guaranteed import draw_guaranteed

__all__ = ("draw_dofs", "draw_error", "draw_growth", "draw_guaranteed", "draw_rivals")
