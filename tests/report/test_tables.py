import csv
import re
import subprocess
import sys
from itertools import pairwise
from math import log2
from pathlib import Path

import pytest

from signorini.report.macros import OPTIONAL, REQUIRED, check_summary, macros, paper_values
from signorini.report.tables import TEX, error_table, markdown_table

ROOT = Path(__file__).parents[2]
PRINTED = list(
    csv.DictReader((ROOT / "tests/data/table_5_1.csv").read_text().splitlines())
)  # the paper's
COLUMNS = {
    "l2_cf": ("l2", "P1"),
    "l2_ncf": ("l2", "CR"),
    "h1_cf": ("h1", "P1"),
    "h1_ncf": ("h1", "CR"),
}


@pytest.fixture
def errors():
    return [
        {"element": element, "n": row["n"], "l2": row[f"l2_{tag}"], "h1": row[f"h1_{tag}"]}
        for element, tag in (("P1", "cf"), ("CR", "ncf"))
        for row in PRINTED
    ]


@pytest.fixture
def rates():
    rows = []
    for column, (norm, element) in COLUMNS.items():
        steps = [log2(float(a[column]) / float(b[column])) for a, b in pairwise(PRINTED)]
        rows.append(
            {"element": element, "norm": norm, "kind": "mean", "slope": sum(steps) / len(steps)}
        )
    return rows


@pytest.fixture
def surface():
    return {
        "x": [0, 0.5, 1],
        "u": [[0.6080882434, 0, 0]],
        "contact_x": [0, 0.25, 0.5, 0.75, 1],
        "contact_u": [0.6, 0.4, 0.1, 0, 0],
        "critical_points": [[0.6982, 0]],
    }


def one_cell(value, **options):
    errors = [{"element": "P1", "n": 2, "l2": value}]
    return markdown_table(errors, [], norms=["l2"], elements=["P1"], **options).splitlines()[2]


def cells(table, separator):
    lines = [line.strip("| \\") for line in table.splitlines()]
    return [
        [cell.strip() for cell in line.split(separator)]
        for line in lines
        if re.match(r"\d|slope", line)
    ]


@pytest.mark.parametrize(("table", "separator"), [(error_table, "&"), (markdown_table, "|")])
def test_published_numbers_come_out_as_printed(errors, rates, table, separator):
    *levels, slopes = cells(table(errors, rates), separator)
    assert levels == [list(row.values()) for row in PRINTED]
    # the paper prints 1.89 for the first, the mean of whose numbers is 1.8955
    assert slopes == ["slope", "1.90", "2.10", "0.98", "1.02"]


@pytest.mark.parametrize(
    ("value", "printed"),
    [
        (0.125, "0.12"),  # exact ties go to even
        (0.375, "0.38"),
        (2.675, "2.67"),  # the double lies below the decimal
        (1.115, "1.11"),  # here too, though it multiplies up to 111.5
        (0.145, "0.14"),
        ("0.285", "0.28"),
        (0.0, "0.00"),
    ],
)
def test_rounding_is_of_the_exact_value(value, printed):
    assert one_cell(value, decimals=2) == f"| 2 | {printed} |"


@pytest.mark.parametrize(
    ("value", "printed"),
    [
        (0.00009866, "0.00009866"),
        (9.9e-6, "9.9000e-06"),
        (123456.0, "1.2346e+05"),
        (0.0, "0.00000000"),
        (None, "--"),
        ("", "--"),
    ],
)
def test_notation_follows_the_size(value, printed):
    assert one_cell(value) == f"| 2 | {printed} |"


def test_latex_writes_powers_of_ten():
    table = error_table(
        [{"element": "CR", "n": 4, "h1": 1.25e-7}], [], norms=["h1"], elements=["CR"]
    )
    assert r"4 & $1.2500\times10^{-7}$ \\" in table
    assert r"slope & -- \\" in table


def test_choice_and_order_of_columns(errors, rates):
    table = markdown_table(errors, rates, norms=["h1", "l2"], elements=["CR"])
    assert table.splitlines()[0] == "| N | H1 NCF | L2 NCF |"
    assert cells(table, "|")[-1] == ["slope", "1.02", "2.10"]


def test_absent_level_is_a_dash(errors, rates):
    assert cells(markdown_table(errors[1:], rates), "|")[0] == [
        "2",
        "--",
        "0.14182150",
        "--",
        "0.72540780",
    ]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"norms": ["l3"]}, "l3.*known: l2, h1, h1_semi"),
        ({"elements": ["P2"]}, "P2.*known: P1, CR"),
    ],
)
def test_unknown_names_are_refused(errors, rates, options, message):
    with pytest.raises(ValueError, match=message):
        error_table(errors, rates, **options)


def test_a_level_given_twice_is_refused(errors, rates):
    with pytest.raises(ValueError, match="twice"):
        error_table([*errors, errors[0]], rates)


def test_macros_escape_what_tex_reserves():
    assert (
        macros({"Machine": "x86_64, 100 %"})
        == "\\newcommand{\\SignoriniMachine}{x86\\_64, 100 \\%}\n"
    )


@pytest.mark.parametrize("name", ["L2", "", "a_b", "a b", "ä"])
def test_macro_names_are_letters(name):
    with pytest.raises(ValueError, match="letters only"):
        macros({name: 1})


def test_check_summary_counts():
    rows = [
        {"cell": "a", "units": "0.5", "ok": "True"},
        {"cell": "b", "units": "-0.68", "ok": "True"},
        {"cell": "c", "units": 0.0, "ok": True},
        {"cell": "d", "units": "-7.25", "ok": "False"},
    ]
    summary = check_summary(rows)
    assert (summary.total, summary.matched, summary.exact) == (4, 3, 2)
    assert (summary.largest, summary.largest_cell) == (7.25, "d")
    assert str(summary).startswith("3 of 4 published numbers matched, 2 of them in every digit")


def test_check_summary_of_nothing_is_refused():
    with pytest.raises(ValueError, match="no published number"):
        check_summary([])


def test_every_build_has_the_required_macros(errors, rates, surface):
    values = paper_values(errors, rates, surface, 512)
    assert values.keys() == REQUIRED.keys()
    assert values["LastPositiveNode"] == "2/4"
    assert values["CriticalPoint"] == "0.698"
    assert values["CornerValue"] == "0.60808824"
    assert values["FinestErrorLtwoNCF"] == "0.00009866"


def test_groups_are_whole(errors, rates, surface):
    published = [{"norm": n, "element": e, "slope": "1.00"} for n, e in COLUMNS.values()]
    groups = {
        "check": [{"cell": "a", "units": 0.1, "ok": True}],
        "published": published,
        "effects": {"diagonal": 0.12345, "load": 0.48, "norm": 0.0221, "quadrature": 1.7e-5},
        "exact": (errors, rates),
        "environment": {"versions": "Python", "machine": "a computer"},
    }
    assert groups.keys() == OPTIONAL.keys()
    for group, argument in groups.items():
        values = paper_values(errors, rates, surface, 512, **{group: argument})
        assert values.keys() - REQUIRED.keys() == OPTIONAL[group].keys()
    percents = paper_values(errors, rates, surface, 512, effects=groups["effects"])
    assert [percents[name] for name in OPTIONAL["effects"]] == ["12", "48", "2.2", "0.0017"]


# The document and the macros agree


def read_document():
    """Return the head comment of main.tex, its body, and its guarded blocks as {macro asked for:
    text}.
    """
    source = (ROOT / "paper/main.tex").read_text(encoding="utf-8")
    head, body = source.split(r"\documentclass")
    body = re.sub(r"(?<!\\)%.*", "", body)
    guard = re.compile(r"\\ifdefined\\Signorini(\w+)(.*?)\\fi\b", re.S)
    return head, guard.sub("", body), dict(guard.findall(body))


def used(text):
    return set(re.findall(r"\\Signorini([A-Za-z]+)", text))


def test_text_uses_only_macros_that_are_always_there():
    _, text, _ = read_document()
    assert used(text) <= REQUIRED.keys()


def test_guarded_text_uses_the_group_it_asks_for():
    _, _, blocks = read_document()
    assert len(blocks) == len(OPTIONAL)
    for name, text in blocks.items():
        group = next(group for group in OPTIONAL.values() if name in group)
        assert used(text) <= group.keys() | REQUIRED.keys()


def test_every_macro_is_used_and_described_at_the_head():
    head, text, blocks = read_document()
    names = dict(REQUIRED)
    for group in OPTIONAL.values():
        names |= group
    assert dict(re.findall(r"%   \\Signorini(\w+) +(.+)", head)) == names
    assert used(text).union(*map(used, blocks.values())) == names.keys()


def test_no_decimal_is_typed_into_the_document():
    _, text, blocks = read_document()
    prose = text.split(r"\begin{document}")[1].split(r"\begin{thebibliography}")[0]
    prose = re.sub(r"\{0\.\d+\\\w+\}|[-\d.]+em|width=0\.\d+", "", prose)
    assert not re.findall(r"\d+\.\d+", prose + "".join(blocks.values()))


def test_tables_import_no_array_library():
    code = "import sys, signorini.report.tables; print({'numpy', 'pandas', 'matplotlib'} & sys.modules.keys())"
    run = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT / "src", capture_output=True, text=True, check=True
    )
    assert run.stdout == "set()\n"


@pytest.mark.parametrize("make", [error_table, markdown_table])
def test_a_slope_of_round_off_is_marked_and_explained(make):
    errors = [{"element": name, "n": n, "l2": 1e-15} for name in ("P1", "CR") for n in (2, 4)]
    rates = [
        {"element": "P1", "norm": "l2", "kind": "mean", "slope": -0.5, "floor": "1"},
        {"element": "CR", "norm": "l2", "kind": "mean", "slope": 1.5, "floor": "0"},
    ]
    table = make(errors, rates, norms=["l2"])
    slope, note = (line for line in table.splitlines() if "slope" in line)
    assert "-0.50*" in slope
    assert "1.50*" not in slope
    assert (
        note.strip("\\ ")
        .rstrip("}")
        .endswith("* an error in this column is round-off, the slope means nothing")
    )
    clean = make(errors, [row | {"floor": "0"} for row in rates], norms=["l2"])
    assert "*" not in clean
    assert len(clean.splitlines()) < len(table.splitlines())


def test_a_missing_slope_of_round_off_is_a_marked_dash():
    rates = [{"element": "P1", "norm": "l2", "kind": "mean", "slope": "", "floor": "1"}]
    table = markdown_table(
        [{"element": "P1", "n": 2, "l2": 0}], rates, norms=["l2"], elements=["P1"]
    )
    assert "| slope | --* |" in table


@pytest.mark.parametrize(
    ("make", "marks"), [(error_table, ("$^\\dagger$",)), (markdown_table, ("†",))]
)
def test_rows_of_an_inaccurate_solve_are_marked_and_the_note_tells_the_worst(make, marks):
    proof = {"residual": "1e-16", "accuracy": "3.4e-07", "multiplier_accuracy": ""}
    errors = [
        {"element": "P1", "n": 2, "l2": 0.25, "status": "solved"} | proof,
        {"element": "P1", "n": 4, "l2": 1.25e-7, "status": "inaccurate"} | proof,
        {"element": "CR", "n": 4, "l2": "", "status": "inaccurate", "accuracy": "0.5"},
    ]
    table = make(errors, [], norms=["l2"], elements=["P1"])
    marked = [line for line in table.splitlines() if marks[0] in line]
    assert len(marked) == 2
    assert marked[0].lstrip("| ").startswith("4 ")
    assert (
        f"solved inaccurately, not to ten digits of u and of the contact force (at worst {3.4e-7:.0e}"
        in marked[1]
    )
    both = make(errors, [], norms=["l2"], elements=["P1", "CR"])
    assert "--" + marks[0] not in both  # a dash has nothing to mark
    assert "(at worst 5e-01" in both
    clean = make([row | {"status": "solved"} for row in errors], [], norms=["l2"])
    assert marks[0] not in clean


def test_latex_keeps_a_power_of_ten_and_its_mark_apart():
    errors = [{"element": "CR", "n": 4, "h1": 1.25e-7, "status": "inaccurate"}]
    table = error_table(errors, [], norms=["h1"], elements=["CR"])
    assert r"4 & $1.2500\times10^{-7}$$^\dagger$ \\" in table


@pytest.mark.parametrize(
    ("floor", "mark", "said"),
    [
        ("reference", "‡", "is the reference itself and has no error"),
        ("zero", "§", "a distance in this column is zero"),
    ],
)
def test_a_slope_that_is_not_there_says_why_and_does_not_blame_round_off(floor, mark, said):
    rates = [{"element": "P1", "norm": "l2", "kind": "mean", "slope": "", "floor": floor}]
    errors = [{"element": "P1", "n": 2, "l2": 0.1}]
    table = markdown_table(errors, rates, norms=["l2"], elements=["P1"])
    assert f"| slope | --{mark} |" in table
    assert said in table
    assert "round-off" not in table
    assert (f"--{TEX[mark]}" in error_table(errors, rates, norms=["l2"], elements=["P1"])) == (
        mark in TEX
    )


def test_a_note_stands_under_the_table():
    errors = [{"element": "P1", "n": 2, "l2": 0.1, "critical_points": 0.2}]
    assert markdown_table(errors, [], norms=["l2"], elements=["P1"], note="25 % off").endswith(
        "\nNote: 25 % off.\n"
    )
    assert r"{Note: 25 \% off.} \\" in error_table(
        errors, [], norms=["l2"], elements=["P1"], note="25 % off"
    )
    assert "distances jump" in markdown_table(
        errors, [], norms=["critical_points"], elements=["P1"]
    )
    assert "Note" not in markdown_table(errors, [], norms=["l2"], elements=["P1"], note="")
