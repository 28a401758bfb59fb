"""The quantities that a scene asks for, of each of its solutions: the rows of outputs.csv."""

from signorini.fem.functionals import contact_length, critical_point, excess, flux, free_length
from signorini.scene.quantities import OPTIONS

_FUNCTIONALS = {
    "contact_length": contact_length,
    "free_length": free_length,
    "critical_point": critical_point,
    "flux": flux,
    "excess": excess,
}


def output_rows(problem, solution, quantities):
    """The quantities of one solution.

    Parameters
    ----------
    problem : Problem
    solution : StoredSolution
        Of that problem.
    quantities : dict
        The section of that name of a scene.

    Returns
    -------
    list of dict
        For each quantity ``element``, ``n``, ``h``, ``name``, ``value`` and ``unit``; the value is
        None where there is no such critical point.

    Examples
    --------
    >>> from signorini import discretize, load_scene
    >>> from signorini.api.solving import solve_level
    >>> scene = load_scene("config/scenes/punch.yaml")
    >>> problem, solution = discretize(scene, "CR", 64), solve_level(scene, "CR", 64)
    >>> output_rows(problem, solution, {"width": {"kind": "contact_length"}})[0]["value"]
    1.21875
    """
    identity = {"element": solution.element, "n": solution.n, "h": solution.h}
    rows = []
    for name, asked in quantities.items():
        value = _value(problem, solution, asked)
        rows.append(identity | {"name": name, "value": value, "unit": asked.get("unit", "")})
    return rows


def _value(problem, solution, asked):
    options = {key: asked.get(key, default) for key, default in OPTIONS[asked["kind"]].items()}
    value = _FUNCTIONALS[asked["kind"]](problem, solution, **options)
    return None if value is None else asked.get("factor", 1) * value
