"""The commands of the program ``signorini``: their names, and what each does, in one line.

A name of two words is a part of a group: ``signorini benchmark point``. The module of a command has
its name: ``contact-line`` is in ``commands/contact_line.py``, ``benchmark point`` in
``commands/benchmark/point.py``. It has a docstring, the help; ``add_arguments(parser)``; and
``run(arguments)``, which returns an `Outcome`.
"""

from dataclasses import dataclass

# Heading of the help -> command -> what it does.
CATALOGUE = {
    "A question": {
        "scenes": "list the scenes of a folder",
        "new": "write a commented scene to start from",
        "check": "validate a scene: all that can be checked before any work",
        "forecast": "tell what a scene takes: solves, jobs, seconds, memory, disk",
    },
    "Its answer": {
        "mesh": "make the coarsest mesh of a scene",
        "solve": "discretise a scene at one level, solve it, and prove the result",
        "adapt": "refine adaptively until an error is guaranteed",
        "errors": "measure errors against a scene's reference or exact solution",
        "rates": "fit slopes of the errors",
        "outputs": "compute the quantities that a scene asks for",
        "steps": "count active-set steps, beside a plain active set",
        "certificate": "bound the errors of one level, guaranteed and without a truth",
        "certificates": "gather the bounds of all levels of a scene, with their table",
        "certify": "solve finer levels until a guaranteed bound is small enough",
        "expect": "compare slopes and errors with what a scene expects",
        "show": "say what is in a result file",
    },
    "Tables and pictures": {
        "table": "write the error table in LaTeX and Markdown",
        "field": "prepare a solution for a figure",
        "contact-line": "tabulate what happens along the contact part",
        "figures": "draw the figures of a scene",
        "details": "measure errors, jumps and bounds triangle by triangle",
        "draw-details": "draw the mesh, and errors, jumps and bounds on it",
        "gallery": "draw the solutions of many scenes on one sheet",
        "gallery-page": "write a page with a card for each scene and links to its results",
        "viewer": "write a page on which the solutions can be turned",
        "vtu": "write a solution as VTU, for ParaView",
    },
    "A sweep": {
        "sweep": "solve every point of a scene's sweep, gather and draw them",
        "sweep-points": "solve the points of a sweep, or a bundle of them",
        "sweep-table": "gather the points of a sweep in one table, and sum it up",
        "sweep-figure": "draw a sweep over the values of a key",
    },
    "A paper": {
        "compare": "compare errors and slopes with published numbers",
        "verify": "fail if a published number is not met, or results are not as recorded",
        "surface": "sample a solution for a surface plot",
        "draw-surface": "draw a surface plot",
        "draw-convergence": "draw errors against mesh width",
        "guaranteed": "hold published errors against guaranteed bounds",
        "effects": "change, one at a time, the options that the paper leaves open",
        "macros": "write every number of the text as a LaTeX macro",
        "typeset": "typeset a manuscript with its tables and figures",
    },
    "An artifact": {
        "provenance": "say what results were built from, by what and where",
        "codecheck": "write the file from which a codechecker starts",
        "crate": "pack a build as a Workflow Run RO-Crate",
    },
    "The benchmark": {
        "benchmark machine": "describe the machine, the versions and the load",
        "benchmark point": "measure an element, a level and a route of a scene",
        "benchmark rival": "measure a rival and our routes in turn",
        "benchmark guarantee": "measure the time to a guaranteed error, and to the true one",
        "benchmark gather": "gather what was measured, and sum it up",
        "benchmark figure": "draw a figure of it",
        "benchmark report": "write its page",
    },
    "The sensitivity study": {
        "sensitivity errors": "measure a scene's errors under other options",
        "sensitivity combinations": "compare every combination with published numbers",
        "sensitivity digits": "count the last digits that a sixth choice meets",
        "sensitivity figures": "draw its figures",
        "sensitivity report": "write its page",
    },
    "The adaptive study": {
        "adaptive figures": "draw its figures",
        "adaptive report": "write its page",
    },
    "The theory study": {
        "theory estimates": "measure both sides of the paper's estimates on a scene",
        "theory traces": "compute the sharp constants of trace inequalities",
        "theory figures": "draw its figures",
        "theory report": "write its page",
    },
    "The stability suite": {
        "stability success": "solve generated problems and judge the answers",
        "stability digits": "compute a table in other ways that are equally right",
        "stability round-off": "see where accuracy ends",
        "stability extremes": "solve extreme problems",
        "stability figures": "draw its figures",
        "stability report": "write its page",
    },
    "A solver of yours": {
        "suite export": "write the stability suite's problems and solutions as files",
        "suite score": "judge answers to them",
    },
}


@dataclass(frozen=True)
class Outcome:
    """What a command has to say.

    Parameters
    ----------
    text : str
        For a person: one line, or a table.
    data : object, optional
        The same for a program, lists, dicts, text and numbers; printed by ``--json``.
    failed : bool
        Whether what was looked for is not so; the exit code is then 1.
    """

    text: str
    data: object = None
    failed: bool = False


def commands():
    """Every command with what it does, a dict."""
    return {name: summary for section in CATALOGUE.values() for name, summary in section.items()}


def module_of(command):
    """The name of the module that has a command.

    Examples
    --------
    >>> module_of("contact-line"), module_of("benchmark point")
    ('signorini.commands.contact_line', 'signorini.commands.benchmark.point')
    """
    return "signorini.commands." + command.replace("-", "_").replace(" ", ".")
