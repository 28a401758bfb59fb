"""What is kept of an adaptive run, so that it can be tabulated, drawn, and gone on with."""

import hashlib
import json
import os
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from signorini.adapt.loop import STAGES
from signorini.errors.exact import ExactErrors
from signorini.exceptions import StorageError
from signorini.storage import read_npz, write_csv, write_npz

_FILE, _KIND = "run.npz", "adaptive run"
_FILES = {_FILE, "steps.csv", "seconds.csv", "picture.npz", "solution.npz"}
# Of a goal: they may change, and the run goes on.
_LIMITS = ("bound", "max_dofs", "max_seconds", "max_memory")


@dataclass
class Record:
    """Rows and marks of the steps so far.

    Parameters
    ----------
    key : str
        What question the run answers: statement and goal, without limits.
    name : str, optional
        Of the scene, to tell whose run it is.
    rows : list of dict
        Two for each step, one for each element; see `rows_of`.
    seconds : list of dict
        One for each step.
    marks : list of ndarray of bool
        What was refined after each step but the last.
    """

    key: str
    name: str = ""
    rows: list = field(default_factory=list)
    seconds: list = field(default_factory=list)
    marks: list = field(default_factory=list)

    def add(self, step, exact=None):
        """Take a step down; its number follows that of the last one, or is that again.

        Parameters
        ----------
        step : Step
        exact : ExactSolution, optional
            For the true errors.
        """
        self.rows = [row for row in self.rows if row["step"] < step.number]
        self.seconds = [row for row in self.seconds if row["step"] < step.number]
        self.rows += rows_of(step, exact)
        self.seconds.append({"step": step.number} | step.seconds)
        if step.marked is not None:
            self.marks[step.number :] = [step.marked]

    def write(self, folder):
        """Keep the run, and write ``steps.csv`` and ``seconds.csv``.

        Parameters
        ----------
        folder : Path
        """
        sizes = np.array([marked.size for marked in self.marks], dtype=np.int64)
        bits = np.packbits(np.concatenate([np.zeros(0, dtype=bool), *self.marks]))
        facts = {"key": self.key, "name": self.name, "rows": self.rows, "seconds": self.seconds}
        text = json.dumps(facts)
        write_csv(folder / "steps.csv", self.rows)
        write_csv(folder / "seconds.csv", self.seconds)
        write_npz(folder / _FILE, _KIND, told=text, sizes=sizes, marks=bits)

    @classmethod
    def read(cls, folder, key, name=""):
        """Go on with what is kept in a folder, or begin where nothing is.

        Parameters
        ----------
        folder : Path
        key : str
        name : str, optional
            Of the scene.

        Returns
        -------
        Record

        Raises
        ------
        StorageError
            If what is kept is truncated or altered, or answers another question.
        """
        if not (folder / _FILE).exists():
            return cls(key, name)
        kept = read_npz(folder / _FILE, _KIND)
        facts = json.loads(str(kept["told"]))
        if facts["key"] != key:
            words = _run_of(facts, json.loads(key)[1])
            remedy = "name another folder, or --restart, which forgets it"
            raise StorageError(f"{folder}: holds {words}; {remedy}")
        flat = np.unpackbits(kept["marks"], count=int(kept["sizes"].sum())).astype(bool)
        ends = np.cumsum(kept["sizes"])
        return cls(key, name, facts["rows"], facts["seconds"], np.split(flat, ends)[: ends.size])


def _run_of(facts, chosen):
    """Words for a run: its scene, and what was chosen otherwise than here."""
    kept = json.loads(facts["key"])[1]
    others = [f"{name} {value}" for name, value in kept.items() if chosen.get(name) != value]
    name = facts.get("name") or "another scene"
    return f"a run of {name}" + (f" with {', '.join(others)}" if others else "")


def refuse_foreign(folder):
    """Refuse a folder that has files, and none of a run.

    Parameters
    ----------
    folder : Path

    Raises
    ------
    StorageError
    """
    if folder.exists() and not folder.is_dir():
        raise StorageError(f"{folder}: is no folder; name one that is new, or holds a run")
    names = sorted(os.listdir(folder)) if folder.is_dir() else []
    foreign = [name for name in names if name not in _FILES and not name.startswith(".")]
    if foreign and _FILE not in names:
        raise StorageError(f"{folder}: holds {foreign[0]} and no run; name a new folder")


def key_of(scene, goal):
    """The question that a run answers, as text: scene, first mesh, goal, and what is timed.

    Parameters
    ----------
    scene : Scene
    goal : Goal

    Returns
    -------
    str
    """
    chosen = {name: value for name, value in asdict(goal).items() if name not in _LIMITS}
    mesh = scene.problem_statement.triangulations.level(goal.start)
    arrays = (np.ascontiguousarray(array).tobytes() for array in (mesh.p, mesh.t))
    digest = hashlib.sha256(b"".join(arrays)).hexdigest()  # a mesh file may have changed
    return json.dumps([scene.statement, chosen, digest, STAGES], sort_keys=True)


def rows_of(step, exact=None):
    """What a step found, a row for each element.

    Parameters
    ----------
    step : Step
    exact : ExactSolution, optional

    Returns
    -------
    list of dict
        ``step``, ``element``, ``triangles``, ``dofs``, ``h_min`` and ``h_max`` (longest edges, unit
        of length), the guaranteed bounds ``upper`` and ``lower`` of the energy error, ``error`` and
        ``effectivity`` where the solution is known, ``in_contact``, ``contact_dofs``, ``status``,
        ``method`` and ``reason``.
    """
    longest = _longest_edges(step.mesh)
    rows = []
    for element, certificate in step.certificates.items():
        solution = step.solutions[element]
        error = _true_error(step.mesh, solution.problem, solution.u, exact)
        rows.append(
            {
                "step": step.number,
                "element": element,
                "triangles": step.mesh.number_of_triangles,
                "dofs": int(solution.problem.free.size),
                "h_min": float(longest.min()),
                "h_max": float(longest.max()),
                "upper": certificate.upper,
                "lower": certificate.lower,
                "error": error,
                "effectivity": certificate.upper / error if error else None,
                "in_contact": int(solution.active.sum()),
                "contact_dofs": int(solution.active.size),
                "status": solution.status,
                "method": solution.method,
                "reason": step.reason,
            }
        )
    return rows


def _longest_edges(mesh):
    edges = mesh.edge_vectors(slice(None))
    return np.sqrt((edges**2).sum(axis=1).max(axis=0))


def _true_error(mesh, problem, u, exact):
    """The energy error where the solution is known, else None."""
    if exact is None:
        return None
    norms = ExactErrors(exact, ["energy"])
    return norms.of(mesh, problem.finite_element, u, problem.coefficient)["energy"]


def picture_of(step):
    """A mesh with its contact set, to be drawn.

    Parameters
    ----------
    step : Step

    Returns
    -------
    dict of str to ndarray
        ``p`` (2, nv), ``t`` (3, nt), ``contributions`` (nt,), the contact facets ``contact`` and
        those of them whose ends both bind, ``binding``, (2, 2, k): axis, end, facet.
    """
    mesh, solution = step.mesh, step.solutions["P1"]
    binds = np.zeros(mesh.number_of_vertices, dtype=bool)
    binds[solution.problem.contact[solution.active]] = True
    ends = np.asarray(mesh.facet_ends(mesh.boundary_facets("contact")))
    p = np.asarray(mesh.p)
    return {
        "p": p,
        "t": np.asarray(mesh.t),
        "contributions": step.certificates["P1"].contributions,
        "contact": p[:, ends],
        "binding": p[:, ends[:, binds[ends].all(axis=0)]],
    }


def write_picture(path, step):
    """Keep a mesh with its contact set, see `picture_of`.

    Parameters
    ----------
    path : Path
    step : Step
    """
    write_npz(path, "adapted mesh", **picture_of(step))


def read_picture(path):
    """Read what `write_picture` wrote.

    Parameters
    ----------
    path : Path

    Returns
    -------
    dict of str to ndarray

    Raises
    ------
    StorageError
        If the file is missing, truncated or altered.
    """
    return read_npz(Path(path), "adapted mesh")


def write_solution_of(path, step):
    """Keep the last mesh and both solutions on it.

    Parameters
    ----------
    path : Path
    step : Step
    """
    solutions = {f"u_{element}": solution.u for element, solution in step.solutions.items()}
    mesh = {"p": np.asarray(step.mesh.p), "t": np.asarray(step.mesh.t)}
    shares = {
        f"contributions_{element}": certificate.contributions
        for element, certificate in step.certificates.items()
    }
    write_npz(path, "adapted solution", **mesh, **solutions, **shares)
