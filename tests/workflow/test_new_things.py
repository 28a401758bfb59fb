"""Each new thing goes where docs/architecture.md says: it is added to a copy of the project, and
works.
"""

import pytest
from new_things import LIBRARY, SCENE, SCHEMA, answer_of, signorini
from project import Project


@pytest.fixture
def project(tmp_path):
    return Project.fresh(tmp_path / "project")


ELEMENT = """\
from signorini.fem.element_facts import NEW_FACTS
from signorini.fem.elements.p1 import _P1


class _New(_P1):
    facts = NEW_FACTS


NEW = _New()
"""


def test_an_element(project):
    """P1 under another name; it has P1's errors, by the direct route."""
    project.write(f"{LIBRARY}/fem/elements/new.py", ELEMENT)
    here = f"{LIBRARY}/fem/elements/__init__.py"
    project.edit(here, "\nELEMENTS =", "from signorini.fem.elements.new import NEW\n\nELEMENTS =")
    project.edit(here, "(P1, CR)}", "(P1, CR, NEW)}")
    facts = f"{LIBRARY}/fem/element_facts.py"
    new = 'NEW_FACTS = ElementFacts("NEW", "new", "N", 1100, 130, 500, 1e6)\n\nELEMENT_FACTS ='
    project.edit(facts, "ELEMENT_FACTS =", new)
    project.edit(facts, "(P1_FACTS, CR_FACTS)}", "(P1_FACTS, CR_FACTS, NEW_FACTS)}")
    project.edit(SCHEMA, "enum: [P1, CR]", "enum: [P1, CR, NEW]")
    styles = f"{LIBRARY}/figures/style.py"
    project.edit(styles, "ELEMENT_STYLES = {", 'ELEMENT_STYLES = {\n    "NEW": {"marker": "x"},')
    project.edit(SCENE, "[P1, CR]", "[P1, NEW]")
    assert answer_of(project, "solve", SCENE, "--element", "NEW", "--n", "4")["method"] == "direct"
    rows = answer_of(project, "errors", SCENE)
    old, new = ([row for row in rows if row["element"] == name] for name in ("P1", "NEW"))
    assert [row["n"] for row in new] == [2, 4]
    assert [row["h1"] for row in new] == pytest.approx([row["h1"] for row in old], rel=1e-10)


def test_a_norm(project):
    """Twice the L2 norm, of errors against a reference."""
    names = f"{LIBRARY}/errors/norms.py"
    entry = 'NORMS = {\n    "twice": Norm("twice", "twice", "twice", "twice"),'
    project.edit(names, "NORMS = {", entry)
    project.edit(names, 'DOMAIN = ("l2",', 'DOMAIN = ("l2", "twice",')
    values = f"{LIBRARY}/errors/reference.py"
    square = '        squares["twice"] = 4.0 * self._squared_l2(mesh, values)\n        return {\n'
    project.edit(
        values,
        "        return {\n            norm: self._root",
        square + " " * 12 + "norm: self._root",
    )
    lost = '        if norm == "twice":\n            return 4.0 * self._lost("l2", mesh)\n'
    project.edit(
        values,
        '        if norm == "h1":\n            return',
        lost + '        if norm == "h1":\n            return',
    )
    bounds = f"{LIBRARY}/errors/round_off.py"
    project.edit(bounds, '"l2": _l2,', '"l2": _l2,\n    "twice": lambda *parts: 4.0 * _l2(*parts),')
    project.edit(SCHEMA, "enum: [l2, h1_semi,", "enum: [l2, twice, h1_semi,")
    project.edit(SCENE, "norms: [l2, h1]", "norms: [l2, twice]")
    rows = answer_of(project, "errors", SCENE)
    assert [row["twice"] for row in rows] == pytest.approx([2.0 * row["l2"] for row in rows])


SOLVER = """\
from signorini.exceptions import NotApplicableError
from signorini.solvers.direct import solve_direct


def solve_again(problem, guess=None):
    reason = why_not(problem)
    if reason:
        raise NotApplicableError(reason)
    return solve_direct(problem, guess)


def why_not(problem):
    return None if problem.b.size > 9 else "solver.method: again takes ten dofs or more"
"""


def test_a_solver(project):
    """The direct route under another name, that does not take coarse levels."""
    project.write(f"{LIBRARY}/solvers/again.py", SOLVER)
    line = 'METHODS = {\n    "again": ("signorini.solvers.again", "solve_again"),'
    project.edit(f"{LIBRARY}/solvers/routes.py", "METHODS = {", line)
    project.edit(SCHEMA, "enum: [auto, fourier,", "enum: [auto, again, fourier,")
    facts, routes = f"{LIBRARY}/fem/element_facts.py", f"{LIBRARY}/scene/memory_check.py"
    project.edit(facts, '"fourier": GRID,', '"fourier": GRID,\n            "again": GRID,')
    project.edit(routes, '"direct")', '"direct", "again")')
    project.edit(SCENE, "slope: mean", "slope: mean\nsolver: {method: again}")
    solved = answer_of(project, "solve", SCENE, "--element", "P1", "--n", "4")
    assert (solved["method"], solved["status"]) == ("again", "solved")
    refused = signorini(project, "solve", SCENE, "--element", "P1", "--n", "2")
    assert refused.returncode == 1
    assert "again takes ten dofs or more" in refused.stderr


def test_a_key_of_a_scene(project):
    """A remark with a default, and a check beyond the schema."""
    key = "properties:\n  remark: {description: Anything., type: string, default: none}\n  title:"
    project.edit(SCHEMA, "properties:\n  title:", key)
    checks = f"{LIBRARY}/scene/checks.py"
    check = (
        '    if document["remark"] == document["title"]:\n'
        '        raise SceneError("remark: repeats the title; drop it")\n'
    )
    project.edit(checks, "    _check_norms(document)\n", "    _check_norms(document)\n" + check)
    assert answer_of(project, "check", SCENE)["document"]["remark"] == "none"
    project.edit(SCENE, "title: A scene for tests", "title: so\nremark: so")
    refused = signorini(project, "check", SCENE)
    assert refused.returncode == 1
    assert "small.yaml: remark: repeats the title" in refused.stderr


COMMAND = '''\
"""Count the scenes of a folder.

example:
  signorini count config/scenes
"""

from pathlib import Path

from signorini.commands.catalogue import Outcome


def add_arguments(parser):
    parser.add_argument("folder", type=Path)


def run(arguments):
    count = len(list(arguments.folder.glob("*.yaml")))
    return Outcome(f"{count} scenes", count)
'''


def test_a_command(project):
    project.write(f"{LIBRARY}/commands/count.py", COMMAND)
    catalogue = f"{LIBRARY}/commands/catalogue.py"
    project.edit(
        catalogue, '"scenes": "list', '"count": "count the scenes",\n        "scenes": "list'
    )
    assert answer_of(project, "count", "config/scenes") == len(
        list((project / "config/scenes").glob("*"))
    )
    assert "count the scenes" in signorini(project, "--help").stdout
    assert "signorini count config/scenes" in signorini(project, "count", "--help").stdout


MEASURE = '''\
from signorini.fem.element_facts import ELEMENT_NAMES
from signorini.fem.problem import discretize


def sizes(statement, n):
    """Degrees of freedom of each element at a level."""
    return [{"element": e, "dofs": discretize(statement, e, n).b.size} for e in ELEMENT_NAMES]
'''
COUNT = '''\
"""Count degrees of freedom."""

from signorini.commands.catalogue import Outcome
from signorini.commands.inputs import add_output, add_scene, scene_of
from signorini.storage import write_csv
from signorini.studies.size.measure import sizes


def add_arguments(parser):
    add_scene(parser)
    parser.add_argument("--n", type=int, required=True)
    add_output(parser, "the counts, .csv")


def run(arguments):
    rows = sizes(scene_of(arguments.scene).problem_statement, arguments.n)
    write_csv(arguments.output, rows)
    return Outcome(f"size: {len(rows)} elements")
'''
RULE = """\
rule size:
    input:
        library("size count"),
        scene=ancient(lambda wildcards: validated_file("small")),
    output:
        f"{STUDIES}/size/{{n}}.csv",
    params:
        content=content("size count"),
        statement=lambda wildcards: statement_of("small"),
    shell:
        "python3 -m signorini size count {input.scene:q} --n {wildcards.n} -o {output:q}"
"""


def test_a_study(project):
    """Its job runs, and again after an edit of what it measures, and then no more."""
    for folder in ("studies/size", "commands/size"):
        (project / LIBRARY / folder).mkdir()
        project.write(f"{LIBRARY}/{folder}/__init__.py", "")
    project.write(f"{LIBRARY}/studies/size/measure.py", MEASURE)
    project.write(f"{LIBRARY}/commands/size/count.py", COUNT)
    section = 'CATALOGUE = {\n    "Sizes": {"size count": "count degrees of freedom"},'
    project.edit(f"{LIBRARY}/commands/catalogue.py", "CATALOGUE = {", section)
    project.write("workflow/rules/size.smk", RULE)
    last = 'include: "rules/stability.smk"\n'
    project.edit("workflow/Snakefile", last, last + 'include: "rules/size.smk"\n')
    project.build("results/studies/size/4.csv")
    table = (project / "results/studies/size/4.csv").read_text(encoding="utf-8")
    assert table.splitlines() == ["element,dofs", "P1,25", "CR,56"]  # 5*5; 2*4*5 and 4*4 diagonals
    project.write(f"{LIBRARY}/studies/size/measure.py", MEASURE + "# a comment\n")
    assert project.jobs("results/studies/size/4.csv") == {"size": 1}
