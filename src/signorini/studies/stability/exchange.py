"""The suite's problems as files, for solvers that know nothing of this library.

Each file has the matrix, the data, and the solution of this matrix as pairs of doubles
(`judge.entries`), so that whoever has it can check every digit.
"""

from itertools import product
from pathlib import Path

import numpy as np

from signorini.exceptions import SolverError, StorageError
from signorini.fem.elements import ELEMENTS
from signorini.generated.bodies import FAMILIES
from signorini.generated.problems import LOADS, instance
from signorini.judge.entries import RESOLVED, solve_entries
from signorini.report.document import environment
from signorini.solvers import solve
from signorini.storage import read_npz, write_csv, write_npz, write_text

KIND = "problem of the stability suite"
PROBLEMS, INDEX = "problems", "index.csv"
LOADER = Path(__file__).with_name("load_problem.py")
_README = "studies/stability/suite.md.j2"
_DATA = ("b", "contact", "lower", "fixed", "fixed_values")
_TRUTH = ("u", "u_low", "multiplier", "multiplier_low", "active")
_NUMBERS = ("variation", "error", "limit", "condition")


def keys(seeds, families=tuple(FAMILIES)):
    """(family, load, element, seed) of all problems of some seeds.

    Parameters
    ----------
    seeds : iterable of int
    families : sequence of str, optional

    Returns
    -------
    list of (str, str, str, int)

    Examples
    --------
    >>> len(keys(range(25))), keys([0])[0]
    (3850, ('right-angled', 'white', 'P1', 0))
    """
    return list(product(families, LOADS, ELEMENTS, seeds))


def name_of(family, load, element, seed):
    """The name of a problem's file, without its ending.

    Parameters
    ----------
    family, load, element : str
    seed : int

    Returns
    -------
    str

    Examples
    --------
    >>> name_of("delaunay", "smooth", "P1", 3)
    'delaunay-smooth-P1-003'
    """
    return f"{family}-{load}-{element}-{seed:03d}"


def export(folder, chosen):
    """Write problems, their index, a README and a loader.

    Parameters
    ----------
    folder : path-like
    chosen : sequence of tuple
        Of `keys`.

    Returns
    -------
    written, left_out : list of dict
        Rows of the index; and of problems that pairs of doubles do not resolve, with why.
    """
    written, left_out = [], []
    for key in chosen:
        made = instance(*key)
        try:
            truth = solve_entries(made.problem, _first_guess(made.problem))
        except SolverError as error:
            left_out.append({"name": name_of(*key), "reason": str(error)})
            continue
        write_problem(Path(folder, PROBLEMS, f"{name_of(*key)}.npz"), made, truth)
        written.append(_row(made, truth))
    _write_papers(Path(folder), written, left_out)
    return written, left_out


def _first_guess(problem):
    """Where the search for the contact set begins: where our solution touches, or everywhere."""
    try:
        return solve(problem).active
    except SolverError:
        return np.ones(problem.contact.size, dtype=bool)


def write_problem(path, made, truth):
    """Write a problem and its solution.

    Parameters
    ----------
    path : path-like
    made : Instance
    truth : judge.entries.Pairs
    """
    problem = made.problem
    A = problem.A.sorted_indices()
    arrays = {"A_data": A.data, "A_indices": A.indices, "A_indptr": A.indptr}
    arrays |= {name: getattr(problem, name) for name in _DATA}
    arrays |= {name: getattr(truth, name) for name in (*_TRUTH, *_NUMBERS)}
    arrays |= {"vertices": problem.mesh.p, "triangles": problem.mesh.t}
    words = {name: getattr(made, name) for name in ("family", "load", "element", "seed")}
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    write_npz(path, KIND, **arrays, **words)


def _row(made, truth):
    problem = made.problem
    return {
        "name": name_of(made.family, made.load, made.element, made.seed),
        "mesh": made.family,
        "load": made.load,
        "element": made.element,
        "seed": made.seed,
        "unknowns": problem.b.size,
        "entries": problem.A.nnz,
        "contact_unknowns": problem.contact.size,
        "active": int(truth.active.sum()),
        "aspect": made.aspect,
        "condition": f"{truth.condition:.2e}",
        "limit": f"{truth.limit:.1e}",
        "error": f"{truth.error:.1e}",
    }


def _write_papers(folder, written, left_out):
    template = environment().get_template(_README)
    text = template.render(written=written, left_out=left_out, resolved=RESOLVED)
    write_csv(folder / INDEX, written)
    write_text(folder / "README.md", text)
    write_text(folder / LOADER.name, LOADER.read_text(encoding="utf-8"))


def read_problem(path):
    """Read a problem of the suite again, every checksum verified.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    key : tuple
        Family, load, element and seed.
    arrays : dict

    Raises
    ------
    StorageError
        If it is missing or altered, or no problem that this version generates.
    """
    arrays = read_npz(path, KIND)
    words = (str(arrays[name]) for name in ("family", "load", "element"))
    key = (*words, int(arrays["seed"]))
    problem = instance(*key).problem
    if not all(np.array_equal(arrays[name], getattr(problem, name)) for name in _DATA):
        raise StorageError(f"{path}: this version makes another problem {name_of(*key)}; export it")
    return key, arrays
