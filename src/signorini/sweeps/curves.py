"""What the figure of a sweep shows: quantities on the finest level over the first swept key."""

from signorini.errors.norms import NORMS
from signorini.sweeps.finest import finest_rows
from signorini.sweeps.names import QUANTITY

# Shown where they are known, after the quantities of the scene, in this order; the first four.
SHOWN = ("l2", "h1", "resultant", "contact_length", "energy", "trace_l2", "last_critical")
_MOST_PANELS = 4
LABELS = {
    "resultant": "contact force in all",
    "contact_length": "length in contact",
    "last_critical": "last critical point",
}


def sweep_curves(section, rows):
    """Series for `figures.sweep.draw_sweep`.

    Parameters
    ----------
    section : dict
        The section ``sweep`` of a scene.
    rows : sequence of mapping
        Of sweep.csv, texts or numbers.

    Returns
    -------
    dict
        ``label``, the key along the axis; ``log``, whether the axis is logarithmic; ``ticks``, the
        names of places 0, 1, ... where the values are no numbers, else None; and ``panels``, each
        with its ``label``, whether it is ``log``, and ``series``: ``element``, ``variant`` and the
        lists ``x`` and ``y``.

    Raises
    ------
    ValueError
        If no point was solved.
    """
    key, *others = section
    solved = finest_rows(rows)
    if not solved:
        raise ValueError("sweep: no point was solved; there is nothing to draw")
    places, ticks = _places([row[key] for row in solved])
    panels = []
    asked = [name for name in solved[0] if name.startswith(QUANTITY)]
    for name in (*asked, *SHOWN):
        if any(row.get(name) not in (None, "") for row in solved) and len(panels) < _MOST_PANELS:
            panels.append(_panel(name, solved, key, others, places))
    log = isinstance(section[key], dict) and section[key].get("spacing") == "log"
    return {"label": key, "log": log and ticks is None, "ticks": ticks, "panels": panels}


def _places(values):
    """Value -> its place on the axis; and the names of the places where they are no numbers."""
    distinct = list(dict.fromkeys(map(str, values)))
    try:
        return {text: float(text) for text in distinct}, None
    except ValueError:
        return {text: float(k) for k, text in enumerate(distinct)}, distinct


def _panel(name, rows, key, others, places):
    series = {}
    for row in rows:
        if row.get(name) in (None, ""):
            continue
        variant = ", ".join(f"{other.split('.')[-1]} {row[other]}" for other in others)
        x, y = series.setdefault((row["element"], variant), ([], []))
        x.append(places[str(row[key])])
        y.append(float(row[name]))
    curves = []
    for (element, variant), (x, y) in series.items():
        order = sorted(range(len(x)), key=x.__getitem__)
        x, y = [x[k] for k in order], [y[k] for k in order]
        curves.append({"element": element, "variant": variant, "x": x, "y": y})
    label = NORMS[name].axis if name in NORMS else LABELS.get(name, name.removeprefix(QUANTITY))
    return {"label": label, "log": name in NORMS and _spans_a_decade(curves), "series": curves}


def _spans_a_decade(series):
    values = [value for found in series for value in found["y"]]
    return 0.0 < 10.0 * min(values) <= max(values)
