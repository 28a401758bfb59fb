"""docs/update_readme.py: durations in README.md are those measured, within a factor of two."""

import importlib.util
import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[1] / "docs"


@pytest.fixture
def update(monkeypatch, tmp_path):
    """The script as a module, with a file of measured durations of its own."""
    monkeypatch.setattr(sys, "path", [str(DOCS), *sys.path])
    specification = importlib.util.spec_from_file_location(
        "update_readme", DOCS / "update_readme.py"
    )
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    monkeypatch.setattr(module, "DURATIONS", tmp_path / "durations.csv")
    return module


def measured(update, paper, test, install):
    rows = f"command,seconds\ninstall,{install}\npaper,{paper}\ntest,{test}\n"
    update.DURATIONS.write_text(rows, encoding="utf-8")


def test_readme_tells_three_durations(update):
    assert len(update.told(update.block(update.README, "durations"))) == 3


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0, "about 5 s"),
        (11, "about 10 s"),
        (89, "about 90 s"),
        (91, "about 2 min"),
        (380, "about 6 min"),
    ],
)
def test_durations_are_round(update, seconds, text):
    assert update.about(seconds) == text
    assert 0.5 <= max(seconds, 5) / update.told(text)[0] <= 2


def test_nothing_measured_leaves_the_text(update):
    assert update.durations_block("as it is", check=False) == "as it is"


def test_a_measurement_is_written_and_a_check_lets_noise_pass_but_not_a_factor_of_two(update):
    told = update.durations({"paper": 10, "test": 240, "install": 60})
    assert update.told(told) == [10, 240, 60]
    measured(update, 18, 400, 35)
    assert update.durations_block(told, check=True) == told
    assert update.told(update.durations_block(told, check=False)) == [20, 420, 35]
    for paper, test, install in ((25, 240, 60), (10, 600, 60), (10, 100, 60), (10, 240, 25)):
        measured(update, paper, test, install)
        assert update.durations_block(told, check=True) != told
    measured(update, 10, 240, 60)
    assert update.told(update.durations_block("no duration", check=True)) == [10, 240, 60]
