"""Performance profiles: shares of problems solved against the ratio to the fastest."""

import matplotlib

from signorini.figures.style import ACCENT, STYLE, TEXT_WIDTH, new_figure

# Twelve lines that can be told apart, in grey too; the first is drawn thick.
_COLOURS = ("black", ACCENT, "0.6")
_LINES = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1)))
_MARGIN = 1.5  # by which the axis goes beyond the largest ratio


@matplotlib.rc_context(STYLE)
def draw_profiles(profiles):
    """Draw a step line for each solver.

    Parameters
    ----------
    profiles : dict
        Name of a solver -> (tau, rho), of `studies.profiles.profile`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(TEXT_WIDTH, 0.5 * TEXT_WIDTH)
    axes = figure.add_axes((0.09, 0.15, 0.63, 0.8), xscale="log")
    end = _MARGIN * max(tau[-1] for tau, _ in profiles.values())
    for number, (name, (tau, rho)) in enumerate(profiles.items()):
        look = {
            "color": _COLOURS[number % len(_COLOURS)],
            "linestyle": _LINES[number // len(_COLOURS) % len(_LINES)],
            "linewidth": 1.2 if number else 2.0,
        }
        axes.step([*tau, end], [*rho, rho[-1]], where="post", label=name, **look)
    axes.set(xlim=(1.0, end), ylim=(0.0, 1.02), ylabel="share of problems solved")
    axes.set_xlabel("time over that of the fastest, at most")
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
    return figure
