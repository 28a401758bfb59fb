"""The benchmark's page and fragment."""

import json
import re
from collections import Counter

import pytest
from benchmark_rows import ASKED, FIGURES, MACHINE, POINTS, RIVALS, SUMMARY

from signorini.studies.benchmark.report import page, tables


def written(layout):
    return page(layout, POINTS, RIVALS, json.loads(json.dumps(SUMMARY)), MACHINE, ASKED)


def table(caption):
    """The cells of the table whose caption starts so, without its head."""
    _, _, rest = written("markdown").partition(f".* {caption}")
    (block,) = re.findall(r"\A[^|]*((?:^\|.*\|\n)+)", rest, re.M)
    return [[cell.strip() for cell in row[1:-1].split("|")] for row in block.splitlines()[2:]]


@pytest.fixture(scope="module", params=["latex", "markdown"])
def text(request):
    return written(request.param)


def test_machine_versions_threads_and_load_are_told(text):
    for words in (
        "Chip 100",
        "numpy 2.4.6",
        "one thread per process",
        "load average 0.25 at the start",
    ):
        assert words in text


def test_limits_and_repeats_are_those_asked_for(text):
    for words in ("3 to 9 runs", "3 s or 400 MB", "1/8, 1/16", "no more than 2 s"):
        assert words in text


def test_wins_and_losses_are_told_alike(text):
    assert "ours was faster in 1, the rival in 1, and in 0 the ranges overlap" in text


def test_an_absent_rival_comes_with_its_install_line(text):
    assert "Not installed: Gone (pip install gone)." in text


def test_what_a_coarse_reference_changes_is_told(text):
    plain = text.replace(r"\,\%", " %")
    assert (
        "h = 1/32, changes the errors of its last level, h = 1/4, by P1 L2 +1.00 %, P1 H1 +0.00 %."
        in plain
    )
    assert "paper by P1 with h = 1/128" in text


def test_the_caption_of_the_first_figure_names_the_machine_and_the_others_refer_to_it():
    captions = re.findall(r"\\caption\{(.*)\}\\label", written("latex"))
    assert sum("load average 0.25" in caption for caption in captions) == 1
    assert (
        sum(r"as in \autoref{figure:benchmark_error}" in caption for caption in captions)
        == len(captions) - 1
    )
    assert all(rf"\includegraphics{{benchmark_{name}.pdf}}" in written("latex") for name in FIGURES)


def test_the_fragment_starts_with_its_section_and_is_balanced():
    text = written("latex")
    assert text.startswith(r"\section{Run time against error}")
    assert text.count("{") == text.count("}")
    begun, ended = (Counter(re.findall(rf"\\{word}{{(\w+)}}", text)) for word in ("begin", "end"))
    assert begun == ended
    assert r"Some\_Chip 100\%" in text
    assert r"Slow \& sure" in text


def test_the_page_shows_every_figure_and_every_table_is_square():
    text = written("markdown")
    assert re.findall(r"\]\(benchmark_(\w+)\.png\)", text) == list(FIGURES)
    for block in re.findall(r"(?:^\|.*\|\n)+", text, re.M):
        assert len({line.count("|") for line in block.splitlines()}) == 1


def test_the_page_begins_with_its_answer(text):
    first, _, rest = text.partition("benchmark_error")
    words = " ".join(first.split())
    assert "Of 6 errors that both elements reach between two levels" in words
    assert "P1 gets to 6 sooner than CR, CR to none" in words
    assert (
        "On the finest level of each series, multigrid in full takes 20 to 20 times as long as "
        "multigrid that ends at a tenth of the discretisation error, the most for paper P1 at an "
        "H1 error of 0.25; the latter does not pay for paper, where fourier in full is sooner."
    ) in words
    assert "faster than other people's solvers in 1 of 2 comparisons, and slower in 1." in words
    assert "Each point is measured" in rest


def test_no_table_is_wider_than_a_screen():
    for block in re.findall(r"(?:^\|.*\|\n)+", written("markdown"), re.M):
        assert block.splitlines()[0].count("|") <= 9
        assert max(map(len, block.splitlines())) <= 120


def test_the_cheaper_element_is_named_with_its_factor():
    rows = table("What an error costs")
    assert [row[0] for row in rows if len(set(row[1:])) == 1] == ["*L2 error*", "*H1 error*"]
    assert rows[1][:2] == ["paper", "0.1"]
    assert rows[1][-2:] == ["P1 3.0", "P1 3.0"]
    assert [row[:2] for row in rows[2:4]] == [["", "0.01"], ["corner", "0.1"]]


def test_growth_has_a_row_per_series():
    found = table("Costs on the finest level")
    assert len(found) == 12
    assert found[0][-2:] == ["1.00", "1.00"]


def test_the_stages_of_each_series_are_all_of_its_time():
    found = table("Where time goes on the finest level")
    assert len(found) == 12
    assert found[0][-3:] == ["33", "33", "33"]


def test_the_page_tells_what_a_guarantee_costs():
    rows = table("Seconds to the smallest energy error")
    assert [row[1] for row in rows] == ["P1 uniform", "P1 adaptive", "CR uniform", "CR adaptive"]
    assert rows[0][::2] == ["corner", "0.138", "53 ms"]
    words = " ".join(written("markdown").split())
    assert "takes 2.4 to 2.4 times as long as the error itself on uniform meshes" in words
    assert "Uniform meshes are sooner to it for corner (4.0 times)." in words


def test_the_page_tells_where_the_library_solves_in_full(text):
    words = " ".join(text.split())
    assert "On 2 of 4 levels, the coarsest, the library solves in full" in words
    assert "cannot be told" in words


def test_rivals_are_in_the_order_of_their_titles_with_what_became_of_their_problems():
    assert table("Rivals: problems solved") == [
        ["Fast", "1", "0", "0", "0.50 (0.45 to 0.55)"],
        ["Slow & sure", "1", "0", "1", "20 (18 to 22)"],
    ]


def test_what_is_too_wide_for_the_page_has_files_of_its_own():
    found = tables(SUMMARY)
    assert found.keys() == {"reach", "bias", "comparisons", "accuracy"}
    assert all(f"benchmark_{name}.csv" in written("markdown") for name in found)
    assert [(row["rival"], row["losses"], row["failed"]) for row in found["comparisons"]] == [
        ("fast", 0, 0),
        ("slow", 1, 1),
    ]
