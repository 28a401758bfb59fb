"""The benchmark's page, fragment and figures."""

import json
import re
from collections import Counter

import pytest

from signorini.figures import benchmark as figures
from signorini.figures.style import TEXT_WIDTH, save_figure
from signorini.studies.benchmark.columns import COUNTS, STAGES, TIMES, series
from signorini.studies.benchmark.report import page, tables
from signorini.studies.benchmark.summary import summary

FIGURES = ("error", "dofs", "growth", "stages", "rivals")
ASKED = {
    "scenes": {"paper": {"finest": 16, "reference": 128}, "corner": {"finest": 16}},
    "limits": {"seconds": 3, "megabytes": 400},
    "repeats": {"least": 3, "most": 9, "seconds": 1},
    "rivals": {"levels": [8, 16], "seconds": 2},
    "truths": {"paper": 32},
}
MACHINE = {
    "processor": "Some_Chip 100%", "cores": 2, "memory": 8.0, "system": "Linux", "python": "3.11",
    "blas": "blas 1", "threads": 1, "load": 0.25, "date": "2026-01-01 00:00 UTC",
    "versions": {"numpy": "2.4.6"},
}  # fmt: skip


def point(scene, element, method, n):
    slow = {"fourier": 1e-6, "direct": 1e-5}[method] * {"P1": 1.0, "CR": 3.0}[element]
    dofs = n * n * {"P1": 1, "CR": 3}[element]
    row = {
        "scene": scene,
        "element": element,
        "method": method,
        "status": "measured",
        "note": "",
        "n": n,
        "h": 1 / n,
    }
    row |= {name: slow * n**2 / (3 if name in STAGES else 1) for name in TIMES}
    row |= {f"{name}_min": 0.9 * row[name] for name in TIMES} | {
        f"{name}_max": 1.1 * row[name] for name in TIMES
    }
    row |= {"dofs": dofs, "memory": 1e3 * dofs, "peak": 1e8, "difference": 1e-13, "iterations": 4}
    return row | dict.fromkeys(COUNTS, 2) | {"l2": 1 / n**2, "h1_semi": 1 / n, "h1": 1 / n}


def rival(name, n, ratio, status="solved", ours="fourier"):
    row = {
        "scene": "paper",
        "element": "P1",
        "n": n,
        "rival": name,
        "status": status,
        "note": "",
        "claimed": 1,
    }
    row |= {"ours": ours, "auto": 1}
    return row | {
        "ratio": ratio,
        "ratio_min": ratio and 0.9 * ratio,
        "ratio_max": ratio and 1.1 * ratio,
    }


POINTS = [
    point(scene, element, method, n)
    for scene in ("paper", "corner")
    for element in ("P1", "CR")
    for method in ("fourier", "direct")
    for n in (2, 4, 8, 16)
]
POINTS[-1] |= {"status": "skipped", "note": "about 9 s foreseen"}
RIVALS = [rival("fast", 8, 0.5), rival("slow", 8, 20.0), rival("slow", 16, 40.0, "failed")]
RIVALS += [rival("gone", None, None, "absent", "") | {"note": "pip install gone"}]
ERRORS = {"paper": [{"element": "P1", "n": n, "l2": 1 / n**2, "h1": 1 / n} for n in (2, 4)]}
COARSE = {"paper": [{"element": "P1", "n": n, "l2": 1.01 / n**2, "h1": 1 / n} for n in (2, 4)]}
SUMMARY = summary(POINTS, RIVALS, COARSE, ERRORS) | {
    "titles": {"fast": "Fast", "slow": "Slow & sure", "gone": "Gone"}
}


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
    assert "to the power 1.00 to 1.00 by the fourier route" in words
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
    costs = table("Costs on the finest level")
    assert len(costs) == 8
    assert costs[0][-2:] == ["1.00", "1.00"]


def test_rivals_are_in_the_order_of_their_titles_with_what_became_of_their_problems():
    assert table("Rivals: problems solved") == [
        ["Fast", "1", "0", "0", "0.50 (0.45 to 0.55)"],
        ["Slow & sure", "1", "0", "1", "20 (18 to 22)"],
    ]


def test_what_is_too_wide_for_the_page_has_files_of_its_own():
    found = tables(SUMMARY)
    assert found.keys() == {"reach", "bias", "comparisons"}
    assert all(f"benchmark_{name}.csv" in written("markdown") for name in found)
    assert [(row["rival"], row["losses"], row["failed"]) for row in found["comparisons"]] == [
        ("fast", 0, 0),
        ("slow", 1, 1),
    ]


# Figures


def drawn():
    found = series(POINTS)
    return {
        "error": figures.draw_error(found),
        "dofs": figures.draw_dofs(found),
        "growth": figures.draw_growth(found, SUMMARY["growth"]),
        "stages": figures.draw_stages(found),
        "rivals": figures.draw_rivals(RIVALS, SUMMARY["titles"]),
    }


@pytest.fixture(scope="module")
def figure():
    return drawn()


def test_every_figure_of_the_report_is_drawn_at_the_width_of_the_text(figure):
    assert figure.keys() == set(FIGURES)
    assert {round(found.get_figwidth(), 6) for found in figure.values()} == {round(TEXT_WIDTH, 6)}
    assert max(found.get_figheight() for found in figure.values()) < 235 / 25.4


def test_every_point_of_the_error_figure_bears_its_level(figure):
    axes = figure["error"].axes
    assert [ax.get_title() for ax in axes] == ["paper", "paper", "corner", "corner"]
    assert Counter(text.get_text() for text in axes[0].texts) == Counter(
        {"2": 4, "4": 4, "8": 4, "16": 4}
    )
    assert Counter(text.get_text() for text in axes[2].texts)["16"] == 3


def test_legends_of_growth_hold_the_exponents(figure):
    labels = [text.get_text() for text in figure["growth"].axes[0].get_legend().get_texts()]
    assert labels == ["P1 fourier 1.00", "P1 direct 1.00", "CR fourier 1.00", "CR direct 1.00"]


def test_bars_of_the_stages_fill_the_total(figure):
    bars = figure["stages"].axes[0].patches
    assert len(bars) == 3 * 8
    ends = Counter(round(bar.get_x() + bar.get_width(), 9) for bar in bars)
    assert ends[1.0] == 8


def test_a_failed_rival_is_hollow_and_an_absent_one_not_drawn(figure):
    (axes,) = figure["rivals"].axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["Fast", "Slow & sure"]
    fills = [line.get_markerfacecolor() for line in axes.lines if line.get_marker() == "o"]
    assert fills == ["black", "black", "white"]


@pytest.mark.parametrize("name", FIGURES)
def test_same_numbers_same_bytes(figure, name, tmp_path):
    again = drawn()[name]
    for k, found in enumerate((figure[name], again)):
        save_figure(found, tmp_path / f"{k}.pdf")
    assert (tmp_path / "0.pdf").read_bytes() == (tmp_path / "1.pdf").read_bytes()
