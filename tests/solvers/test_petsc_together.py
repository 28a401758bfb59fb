"""Processes that share a solve: equal to ours, one voice, one message."""

import os
import shutil
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from builders import DATA, statement
from signorini import discretize, load_scene
from signorini.exceptions import SolverError
from signorini.fem.elements import find_element
from signorini.mesh.refined import Refined
from signorini.mesh.triangulation import Triangulation
from signorini.solvers import kkt_residual, petsc, solve
from signorini.solvers.petsc.piece import make_piece
from signorini.solvers.petsc.processes import check_alone
from signorini.solvers.proof import violation
from signorini.solvers.stored import read_solution

absent = petsc.why_not(None) is not None or shutil.which("mpiexec") is None
needs_petsc = pytest.mark.skipif(absent, reason="make petsc installs it")
CASES = [
    ("paper", "P1", 16, 1),
    ("paper", "CR", 16, 2),
    ("paper", "CR", 2, 2),
    ("punch", "P1", 16, 4),
    ("l-shape", "CR", 16, 2),
    ("l-shape", "P1", 32, 4),
    ("inclusion", "CR", 16, 4),
    ("ceiling", "P1", 16, 2),
    ("annulus", "P1", 16, 2),
]


def together(count, *words):
    """`signorini solve` by some processes."""
    mpiexec = ["mpiexec", "-q", "--oversubscribe", "--allow-run-as-root", "-n", str(count)]
    command = [*mpiexec, sys.executable, "-m", "signorini", "solve", *words, "--method", "petsc"]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "OMP_NUM_THREADS": "1"}
    return subprocess.run(command, capture_output=True, text=True, env=environment, check=False)


@needs_petsc
@pytest.mark.parametrize(("scene", "element", "n", "count"), CASES)
def test_the_solution_and_its_proof_are_ours(tmp_path, scene, element, n, count):
    path, file = f"config/scenes/{scene}.yaml", tmp_path / "u.npz"
    ran = together(count, path, "--element", element, "--n", str(n), "-o", str(file))
    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.count("\n") == 1  # one voice
    problem, theirs = discretize(load_scene(path), element, n), read_solution(file)
    ours = solve(problem, "direct")
    largest = np.abs(ours.multiplier).max()
    np.testing.assert_allclose(theirs.u, ours.u, rtol=0, atol=1e-9 * np.ptp(ours.u))
    np.testing.assert_allclose(theirs.multiplier, ours.multiplier, rtol=0, atol=1e-9 * largest)
    np.testing.assert_array_equal(theirs.active, ours.active)
    np.testing.assert_array_equal(theirs.contact, problem.contact)
    assert theirs.status == "solved"
    assert theirs.dofs == problem.free.size
    assert max(theirs.residual, kkt_residual(problem, theirs.u)[0]) < 1e-14


@needs_petsc
def test_an_error_is_told_once():
    words = ("config/scenes/paper.yaml", "--element", "CR", "--n", "2")
    ran = together(4, *words)
    assert ran.returncode == 1
    assert ran.stderr.count("error:") == 1
    assert "more processes than rows of cells, of which there are 2" in ran.stderr


def residual_of(problem):
    """The reduced proof on one process."""
    from mpi4py import MPI

    from signorini.solvers.petsc.share import whole

    share = whole(problem, MPI.COMM_SELF)
    return lambda u: violation(share, u, share.maxima)[0]


@needs_petsc
@pytest.mark.parametrize("element", ["P1", "CR"])
def test_the_proof_by_reductions_is_the_proof(element):
    """Also of what is no solution: on the free dofs, on the contact part, below the obstacle."""
    problem = discretize(load_scene("config/scenes/paper.yaml"), element, 8)
    u, reduced = solve(problem).u, residual_of(problem)
    for dofs, change in ((problem.free, 1e-3), (problem.contact, -1e-4), (problem.contact, 1e-4)):
        wrong = u.copy()
        wrong[dofs[: dofs.size // 2]] += change
        assert reduced(wrong) == pytest.approx(kkt_residual(problem, wrong)[0], rel=1e-9)


def test_a_body_in_several_parts_is_refused():
    """Before any process waits for another: no MPI is needed to see it."""
    apart = Triangulation(
        [[0, 1, 0, 3, 4, 3], [0, 0, 1, 0, 0, 1]],
        [[0, 3], [1, 4], [2, 5]],
        {"contact": [[0, 3], [1, 4]], "dirichlet": [[1, 2, 4, 5], [2, 0, 5, 3]]},
    )
    comm, domain = SimpleNamespace(size=2, rank=0), Refined(apart, 1, 1.0)
    with pytest.raises(SolverError, match="several parts; solve it on one process"):
        make_piece(domain, find_element("P1"), 1, statement(**DATA), comm)


def test_processes_without_petsc_are_told_of_it(monkeypatch):
    monkeypatch.setenv("OMPI_COMM_WORLD_SIZE", "2")
    monkeypatch.setenv("OMPI_COMM_WORLD_RANK", "0")
    with pytest.raises(SolverError, match=r"2 processes, but .*direct"):
        check_alone("direct")
