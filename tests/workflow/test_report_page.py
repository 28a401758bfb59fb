"""The report of what was built, as a browser shows it."""

import pytest

from browser import CHROMIUM, MISSING, told_by

# Clicks through to the list of a scene's results, and to the first of them.
STEPS = """
const named = (text) => [...document.querySelectorAll("*")].reverse()
  .find((found) => found.textContent.trim() === text);
const press = async (text) => { await until(() => named(text)); named(text).click(); };
await press("Results");
await press("small");
await until(() => named("3 figure: l2"));
told.steps.push(document.body.innerText);
"""
OF_TAILWIND = "cdn.tailwindcss.com should not be used in production"


@pytest.fixture(scope="module")
def report(built_small, tmp_path_factory):
    """Of a project that also asks for the paper, which was not built."""
    project = built_small.copy(tmp_path_factory.mktemp("report") / "project")
    project.ask_for("small", "paper")
    project.build("--report", "report.html")
    return (project / "report.html").read_text(encoding="utf-8")


def test_it_shows_what_is_built_and_says_what_one_sees(report):
    for name in ("solution.png", "contact_line.png", "l2.png", "h1.png", "errors.csv"):
        assert name in report
    assert report.count("Errors against mesh width") == 2
    assert "where contact begins or ends" in report
    assert "figure_5_1.png" not in report


@pytest.mark.skipif(not CHROMIUM, reason=MISSING)
def test_a_browser_opens_it_without_a_network(report, tmp_path):
    told = told_by(report, tmp_path, STEPS)
    assert [text for text in told["wrong"] if not text.startswith(OF_TAILWIND)] == []
    assert [name for name in told["requests"] if not name.startswith(("data:", "blob:"))] == []
    (shown,) = told["steps"]
    names = ["contact_line", "h1", "l2", "solution"]
    labels = ["2 errors of every solution", *(f"3 figure: {name}" for name in names)]
    places = [shown.find(label) for label in labels]
    assert -1 not in places
    assert places == sorted(places)  # the table of errors before any figure
