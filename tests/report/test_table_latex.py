"""Tables in LaTeX: as wide as the lines of the article, and no wider."""

import re
import shutil
import subprocess

import pytest

from signorini.errors.norms import RATED
from signorini.report.tables import error_table, markdown_table

LATEX = pytest.mark.skipif(not shutil.which("pdflatex"), reason="pdflatex is not installed")
LEVELS = (4, 8, 16)
# Of order 2 for P1 and 1 for CR, in every norm.
ERRORS = [
    {"element": element, "n": n, "h": 1 / n, "dofs": n * n}
    | dict.fromkeys(RATED, 0.1 * (4 / n) ** order)
    for element, order in (("P1", 2), ("CR", 1))
    for n in LEVELS
]
RATES = [
    {"element": element, "norm": norm, "kind": "mean", "slope": order, "floor": "0"}
    for element, order in (("P1", 2), ("CR", 1))
    for norm in RATED
]
FULL = {"columns": ("n", "h", "unknowns"), "rates": True}


def cells(line):
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_unknowns_widths_and_rates_stand_beside_the_errors():
    table = markdown_table(ERRORS, RATES, norms=["l2"], decimals=4, labels="name", **FULL)
    header, _, first, second, third, slopes = map(cells, table.splitlines())
    assert header == [
        *("N", "h", "unknowns of P1", "unknowns of CR"),
        *("L2 P1", "L2 rate", "L2 CR", "L2 rate"),
    ]
    assert first == ["4", "0.25", "16", "16", "0.1000", "--", "0.1000", "--"]
    assert second == ["8", "0.125", "64", "64", "0.0250", "2.00", "0.0500", "1.00"]
    assert third[4:] == ["0.0063", "2.00", "0.0250", "1.00"]
    assert slopes == ["slope", "", "", "", "2.00", "", "1.00", ""]


def test_levels_elements_and_slopes_are_a_choice():
    table = markdown_table(
        ERRORS, RATES, norms=["h1"], elements=["CR"], levels=[8, 16], columns=["h"], slopes=False
    )
    assert [cells(line) for line in table.splitlines()] == [
        ["h", "H1 NCF"],
        ["---:", "---:"],
        ["0.125", "0.05000000"],
        ["0.0625", "0.02500000"],
    ]


@pytest.mark.parametrize(
    ("form", "printed"),
    [
        ({"notation": "scientific", "digits": 3}, "2.50e-02"),
        ({"notation": "fixed", "decimals": 2}, "0.03"),  # 0.025 is above the half
        ({"decimals": 3}, "0.025"),
    ],
)
def test_the_notation_is_a_choice(form, printed):
    table = markdown_table(ERRORS, RATES, norms=["l2"], elements=["P1"], **form)
    assert cells(table.splitlines()[3]) == ["8", printed]


def test_a_rate_of_round_off_is_a_dash():
    errors = [row | {"floor": "l2" * (row["n"] == 8)} for row in ERRORS]
    table = markdown_table(errors, RATES, norms=["l2", "h1"], elements=["P1"], rates=True)
    rows = [cells(line) for line in table.splitlines()[2:5]]
    assert [row[2] for row in rows] == ["--", "--", "--"]
    assert [row[4] for row in rows] == ["--", "2.00", "2.00"]


def test_a_narrow_table_is_one_tabular_without_a_choice():
    text = error_table(ERRORS, RATES)
    assert text.startswith("\\begin{tabular}")
    assert text.count("\\begin{tabular}") == 1


def test_side_by_side_says_where_it_is_cut():
    text = error_table(ERRORS, RATES, norms=RATED, side_by_side=3)
    assert text.count("\\begin{tabular}") == 1
    assert text.count("\\heavyrulewidth") == 2
    heads = re.findall(r"\\cmidrule\(lr\)\{(\d)-(\d)\}", text)
    assert heads == [("2", "3"), ("4", "5"), ("6", "7")] * 2 + [("2", "3")]


def typeset(folder, options, text, geometry=""):
    """The log of a LaTeX run on a table in an article."""
    (folder / "table.tex").write_text(text)
    (folder / "mine.tex").write_text(
        rf"\documentclass[{options}]{{article}}\usepackage{{booktabs}}{geometry}"
        r"\begin{document}\begin{table}\centering\caption{A table.}\input{table.tex}\end{table}"
        r"\showoutput\end{document}"
    )
    command = ["pdflatex", "-interaction=nonstopmode", "mine.tex"]
    subprocess.run(command, cwd=folder, capture_output=True, check=False)
    return (folder / "mine.log").read_text(errors="replace")


SLOPE = r"/10\.95 s\n\.+\\OT1/cmr/m/n/10\.95 l\n"  # how the word begins
WIDE = r"\usepackage[paperwidth=40cm,margin=1cm]{geometry}"


@LATEX
@pytest.mark.parametrize("options", ["10pt", "11pt", "12pt"])
@pytest.mark.parametrize("count", [2, 3, 6, 7])
def test_no_table_is_wider_than_the_article(tmp_path, options, count):
    text = error_table(ERRORS, RATES, norms=RATED[:count])
    log = typeset(tmp_path, options, text)
    assert "Overfull" not in log
    assert not re.search("^!", log, re.M)


@LATEX
def test_six_norms_with_all_columns_fit_an_article_of_eleven_points(tmp_path):
    """Rates, widths and unknowns besides."""
    log = typeset(tmp_path, "11pt", error_table(ERRORS, RATES, norms=RATED[:6], **FULL))
    assert "Overfull" not in log
    assert not re.search("^!", log, re.M)


@LATEX
def test_a_table_is_cut_only_where_it_must_be(tmp_path):
    """Lines of slopes in the output: one for each part of the table."""
    text = error_table(ERRORS, RATES, norms=RATED[:6])
    parts = {}
    for name, geometry in (("narrow", ""), ("wide", WIDE)):
        folder = tmp_path / name
        folder.mkdir()
        shown = typeset(folder, "11pt", text, geometry).partition("Completed box being shipped")[2]
        parts[name] = len(re.findall(SLOPE, shown))
    assert parts["wide"] == 1
    assert parts["narrow"] > 1
