"""Where lines of the site may break."""

import importlib
import sys
from pathlib import Path

import pytest

SITE = Path(__file__).parents[2] / "docs/site"


@pytest.fixture
def line_breaks(monkeypatch):
    """The extension of the site."""
    monkeypatch.setattr(sys, "path", [str(SITE), *sys.path])
    return importlib.import_module("line_breaks")


def code(text, more=""):
    return f'<code><span class="pre{more}">{text}</span></code>'


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("fem.problem", "fem.<wbr>problem"),
        ("a_name/of_it.py", "a_<wbr>name/<wbr>of_<wbr>it.<wbr>py"),
        ("n&lt;n&gt;.npz", "n&lt;n&gt;.<wbr>npz"),
        ("__init__", "__init__"),
        ("...", "..."),
    ],
)
def test_names_break_at_their_joints_in_tables_alone(name, expected, line_breaks):
    outside = f"<p>{code(name)}</p>"
    page = f"<table><td>{code(name)}</td></table>{outside}"
    assert line_breaks.broken(page) == f"<table><td>{code(expected)}</td></table>{outside}"


def test_a_formula_stays_with_the_mark_after_it(line_breaks):
    first, second = "<math><mi>a</mi></math>", "<math><mi>b</mi></math>"
    page = f"<p>{first}&#8288; and {second}&#8288;, then</p>"
    expected = f'<p>{first}&#8288; and <span class="together">{second},</span> then</p>'
    assert line_breaks.together(page) == expected


@pytest.mark.parametrize("name", ["--max-dofs", "-o"])
def test_an_option_stays_whole(name, line_breaks):
    assert line_breaks.together(code(name)) == code(name, " together")


@pytest.mark.parametrize("name", ["l-shape", "-", "a--b"])
def test_any_other_name_may_break(name, line_breaks):
    assert line_breaks.together(code(name)) == code(name)
