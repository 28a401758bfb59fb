"""A new quantity, figure or family of exact solutions goes where docs/architecture.md says."""

import pytest
from new_things import LIBRARY, SCENE, SCHEMA, answer_of, signorini
from project import Project


@pytest.fixture
def project(tmp_path):
    return Project.fresh(tmp_path / "project")


QUANTITY = """

def doubled_excess(problem, solution):
    return 2.0 * excess(problem, solution)
"""


def test_a_quantity(project):
    functionals = f"{LIBRARY}/fem/functionals.py"
    project.write(functionals, (project / functionals).read_text(encoding="utf-8") + QUANTITY)
    outputs = f"{LIBRARY}/report/outputs.py"
    project.edit(outputs, "critical_point, excess,", "critical_point, doubled_excess, excess,")
    project.edit(outputs, '"excess": excess,', '"excess": excess,\n    "twice": doubled_excess,')
    options = f"{LIBRARY}/scene/quantities.py"
    project.edit(options, '"excess": {},', '"excess": {},\n    "twice": {},')
    project.edit(SCHEMA, "flux, excess]", "flux, excess, twice]")
    asked = "quantities: {once: {kind: excess}, double: {kind: twice}}"
    project.edit(SCENE, "slope: mean", f"slope: mean\n{asked}")
    rows = answer_of(project, "outputs", SCENE)
    once, double = ([row["value"] for row in rows if row["name"] == name] for name in ASKED)
    assert once
    assert double == [2.0 * value for value in once]


ASKED = ("once", "double")

FIGURE = """\
from matplotlib.figure import Figure


def draw_range(field):
    figure = Figure()
    figure.subplots().bar(["least", "greatest"], field["range"])
    return figure
"""


def test_a_figure(project):
    project.write(f"{LIBRARY}/figures/range.py", FIGURE)
    command = f"{LIBRARY}/commands/figures.py"
    line = "from signorini.figures.style import"
    project.edit(command, line, "from signorini.figures.range import draw_range\n" + line)
    drawn = '    figures["range"] = draw_range(field)\n    if arguments.line:\n'
    project.edit(command, "    if arguments.line:\n", drawn)
    for words in (
        ("mesh", SCENE, "-o", "mesh.npz"),
        ("solve", SCENE, "--element", "P1", "--n", "4", "-o", "u.npz"),
        ("field", "mesh.npz", "u.npz", "-o", "field.npz"),
        ("figures", SCENE, "--field", "field.npz", "-o", "figures"),
    ):
        done = signorini(project, *words)
        assert done.returncode == 0, done.stderr
    drawn = {path.name for path in (project / "figures").iterdir()}
    assert {"range.pdf", "range.png", "solution.pdf", "solution.png"} <= drawn


FAMILY = """\
def _slope(alpha):
    return _from_text(f"({alpha!r})*(2 - y)", repr(2 * alpha))


FAMILIES = {
    "slope": Family("u = alpha (2 - y)", {"alpha": Parameter(1.0, 0.0, meaning="slope")}, _slope),
"""
ASKS_FOR_IT = """\
domain: {kind: rectangle}
boundary: {bottom: contact, right: dirichlet, top: dirichlet, left: dirichlet}
levels: [2, 4]
truth: {kind: exact, family: slope, parameters: {alpha: 3}}
norms: [l2, h1]
"""


def test_a_family_of_exact_solutions(project):
    """An affine one, which both elements find to round-off."""
    project.edit(f"{LIBRARY}/exact/families.py", "FAMILIES = {\n", FAMILY)
    project.write("config/scenes/slope.yaml", ASKS_FOR_IT)
    rows = answer_of(project, "errors", "config/scenes/slope.yaml")
    assert [(row["element"], row["n"]) for row in rows] == [
        ("P1", 2),
        ("P1", 4),
        ("CR", 2),
        ("CR", 4),
    ]
    assert max(row["h1"] for row in rows) < 1e-13
