"""Rows of the quick variant, for tests of pages."""

from functools import cache
from pathlib import Path

from signorini import load_scene
from signorini.publication.published import read_published
from signorini.studies.sensitivity.digits import digits
from signorini.studies.sensitivity.hypotheses import HYPOTHESES
from signorini.studies.sensitivity.sixth_choice import SixthChoice

ROOT = Path(__file__).parents[2]
SCENE = load_scene(ROOT / "config/scenes/paper.yaml")
PUBLISHED = list(read_published(ROOT / "config/published/table_5_1.csv").values())


def hypotheses(*names):
    return [hypothesis for hypothesis in HYPOTHESES if hypothesis.name in names]


@cache
def rows(*names):
    """Of the paper's own table."""
    asked = SCENE.problem_statement, SCENE.elements, SCENE.levels, SCENE.truth["n"], PUBLISHED
    return digits(*asked, hypotheses(*names))


def sixth_choice(chance=(), more=()):
    found = rows("none", "load in single precision")
    return SixthChoice([*found, *more], list(chance), 512, 13)
