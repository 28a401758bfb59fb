"""Performance profiles: shares of problems solved against the ratio to the fastest."""

import matplotlib

from signorini.figures.style import ACCENT, FAINT, STYLE, TEXT_WIDTH, new_figure

# Twelve lines; more come again. The first is drawn thick, and each has its name at its end.
_COLOURS = ("black", ACCENT, "0.6")
_LINES = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1)))
_MARGIN = 1.5  # by which the axis goes beyond the largest ratio
_TOP = 1.02
_GAP = 0.07  # between names, in shares
_AWAY = 1.06  # of names, in widths of the axes


@matplotlib.rc_context(STYLE)
def draw_profiles(profiles):
    """Draw a step line for each solver, with its name at the right end.

    Parameters
    ----------
    profiles : dict
        Name of a solver -> (tau, rho), of `studies.profiles.profile`.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = new_figure(TEXT_WIDTH, 0.55 * TEXT_WIDTH)
    axes = figure.add_axes((0.09, 0.14, 0.575, 0.83), xscale="log")
    end = _MARGIN * max(tau[-1] for tau, _ in profiles.values())
    looks = {name: _look(number) for number, name in enumerate(profiles)}
    for name, (tau, rho) in profiles.items():
        axes.step([*tau, end], [*rho, rho[-1]], where="post", label=name, **looks[name])
    axes.set(xlim=(1.0, end), ylim=(0.0, _TOP), ylabel="share of problems solved")
    axes.set_xlabel("time over that of the fastest, at most")
    _name_ends(axes, {name: rho[-1] for name, (_, rho) in profiles.items()}, looks)
    return figure


def _look(number):
    return {
        "color": _COLOURS[number % len(_COLOURS)],
        "linestyle": _LINES[number // len(_COLOURS) % len(_LINES)],
        "linewidth": 1.2 if number else 2.0,
    }


def _name_ends(axes, ends, looks):
    """The name of each line beside its end, with a piece of it, and as high as there is room."""
    names = sorted(ends, key=ends.get)
    gap = min(_GAP, _TOP / max(len(names), 1))
    across = axes.get_yaxis_transform()
    options = {"transform": across, "clip_on": False}
    for name, height in zip(names, apart([ends[name] for name in names], gap, _TOP), strict=True):
        axes.plot([1, _AWAY], [ends[name], height], color=FAINT, linewidth=0.4, **options)
        axes.plot([_AWAY, _AWAY + 0.06], [height, height], **looks[name], **options)
        axes.text(_AWAY + 0.075, height, name, transform=across, va="center", fontsize=7)


def apart(places, gap, top):
    """Places that are at least a gap apart, moved as little upward and then downward as it takes.

    Parameters
    ----------
    places : sequence of float
        Increasing.
    gap, top : float
        No place is above `top`.

    Returns
    -------
    list of float
        In the same order.

    Examples
    --------
    >>> apart([0.0, 0.1, 0.9, 1.0], 0.25, 1.0)
    [0.0, 0.25, 0.75, 1.0]
    """
    found = []
    for place in places:
        found.append(max(place, found[-1] + gap) if found else place)
    limit = top
    for k in reversed(range(len(found))):
        found[k] = min(found[k], limit)
        limit = found[k] - gap
    return found
