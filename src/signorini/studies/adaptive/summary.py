"""What adaptive meshes save, from the steps of an adaptive and of a uniform run."""

import numpy as np
import pandas as pd

_ELEMENT = "P1"  # whose bound both runs refine for
_STAGES = ["refine", "solve", "certify"]


def run_of(steps, seconds, element=_ELEMENT):
    """The steps of a run with the time that they took.

    Parameters
    ----------
    steps, seconds : list of dict
        As `signorini adapt` writes them; numbers are numbers.
    element : {"P1", "CR"}

    Returns
    -------
    pandas.DataFrame
        Indexed by step: ``dofs``, ``upper``, ``lower``, ``error``, ``effectivity``, ``own``, the
        seconds of making its mesh and solving and certifying on it alone, and ``total``, those of
        all steps so far.
    """
    rows = pd.DataFrame([row for row in steps if row["element"] == element]).set_index("step")
    took = pd.DataFrame(seconds).set_index("step")[_STAGES]
    rows["own"] = took["refine"].cumsum() + took["solve"] + took["certify"]
    rows["total"] = took.sum(axis=1).cumsum()
    return rows


def slope(run):
    """The power of the unknowns with which the bound falls, over the second half of the steps.

    Parameters
    ----------
    run : pandas.DataFrame

    Returns
    -------
    float
        Dimensionless; -0.5 is optimal for affine elements in the plane.

    Examples
    --------
    >>> slope(pd.DataFrame({"dofs": [100, 400, 1600], "upper": [0.4, 0.2, 0.1]}))
    -0.5
    """
    late = run.iloc[len(run) // 2 :] if len(run) > 3 else run.iloc[-2:]
    return float(np.polyfit(np.log(late["dofs"]), np.log(late["upper"]), 1)[0])


def needed(run, bound, column):
    """What a run needs for a bound, interpolated between its steps in logarithms.

    Parameters
    ----------
    run : pandas.DataFrame
    bound : float
    column : {"dofs", "own", "total"}

    Returns
    -------
    float or None
        None where the run does not get there.

    Examples
    --------
    Between a bound of .2 for 400 unknowns and one of .05 for 6,400:

    >>> run = pd.DataFrame({"dofs": [400, 6400], "upper": [0.2, 0.05]})
    >>> round(needed(run, 0.1, "dofs")), needed(run, 0.01, "dofs")
    (1600, None)
    """
    upper, cost = run["upper"].to_numpy(), run[column].to_numpy()
    if upper.min() > bound:
        return None
    last = int(np.argmax(upper <= bound))
    if not last:
        return float(cost[0])
    share = np.log(upper[last - 1] / bound) / np.log(upper[last - 1] / upper[last])
    return float(cost[last - 1] * (cost[last] / cost[last - 1]) ** share)


def compare(adaptive, uniform):
    """An adaptive run against a uniform one, at the finest bound that both reach.

    Parameters
    ----------
    adaptive, uniform : pandas.DataFrame
        Of `run_of`.

    Returns
    -------
    dict
        ``bound``; the unknowns ``dofs`` and ``uniform_dofs`` that it takes, ``fewer``, their ratio;
        ``seconds`` of all adaptive steps up to it, ``uniform_seconds`` of the one uniform mesh
        alone and ``uniform_run_seconds`` of all uniform meshes up to it, ``faster`` and
        ``run_faster``, their ratios to the first; both slopes; the greatest effectivity, or None.
    """
    bound = max(adaptive["upper"].min(), uniform["upper"].min())
    dofs, uniform_dofs = (needed(run, bound, "dofs") for run in (adaptive, uniform))
    seconds = needed(adaptive, bound, "total")
    uniform_seconds, run_seconds = (needed(uniform, bound, column) for column in ("own", "total"))
    known = pd.concat([adaptive["effectivity"], uniform["effectivity"]]).dropna()
    return {
        "bound": float(bound),
        "dofs": dofs,
        "uniform_dofs": uniform_dofs,
        "fewer": uniform_dofs / dofs,
        "seconds": seconds,
        "uniform_seconds": uniform_seconds,
        "uniform_run_seconds": run_seconds,
        "faster": uniform_seconds / seconds,
        "run_faster": run_seconds / seconds,
        "slope": slope(adaptive),
        "uniform_slope": slope(uniform),
        "effectivity": float(known.max()) if len(known) else None,
    }
