"""docs/update_readme.py: durations in README.md are those measured, within a factor of two."""

import importlib.util
import re
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


def test_durations_of_claims_are_those_measured(update):
    lines = ["| a | `make paper` | x | as above |\n", "| b | `snakemake b` | x | about 5 s |\n"]
    lines += ["| c | `signorini verify c` | x | - |\n", "| d | `make d` | x | - |\n", "about 5 s\n"]
    text = "".join(lines)
    assert update.timed_claims(text, check=False) == text
    rows = "make paper,9\nsnakemake b --config quick=true,61\nsignorini verify c,1\n"
    update.DURATIONS.write_text(f"command,seconds\n{rows}", encoding="utf-8")
    assert update.timed_claims(text, check=True) == text
    lines[1] = lines[1].replace("5 s", "60 s")
    lines[2] = lines[2].replace("-", "about 5 s")
    assert update.timed_claims(text, check=False) == "".join(lines)


def test_pages_of_scenes_have_a_place_for_every_block(update):
    pages = update.scene_pages
    names = {
        pages.APPLICATIONS: {f"outputs of {name}" for name in pages.PRACTICE},
        pages.MANY_PAPERS: {"rates", "steps"},
    }
    for page, expected in names.items():
        found = re.findall(r"<!-- (.*) -->", page.read_text(encoding="utf-8"))
        assert {name for name in found if not name.startswith("end of ")} == expected
        assert all(update.block(page, name).startswith("| ") for name in expected)


def test_a_block_of_outputs_has_a_column_for_each_quantity(update, monkeypatch, tmp_path):
    rows = "P1,4,0.25,paint_length,1.23456789,cm\nP1,4,0.25,spot,,\nCR,4,0.25,paint_length,1,cm\n"
    (tmp_path / "mine").mkdir()
    table = tmp_path / "mine/outputs.csv"
    table.write_text(f"element,n,h,name,value,unit\n{rows}CR,4,0.25,spot,2,\n", encoding="utf-8")
    monkeypatch.setattr(update.scene_pages, "RESULTS", tmp_path)
    assert update.scene_pages.outputs("mine").splitlines() == [
        "| element | n | paint length [cm] | spot |",
        "| :--- | ---: | ---: | ---: |",
        "| P1 | 4 | 1.2346 | none |",
        "| CR | 4 | 1 | 2 |",
    ]


def test_every_scene_of_a_page_ships(update):
    pages, scenes = update.scene_pages, update.ROOT / "config/scenes"
    for name in (*pages.PRACTICE, *pages.PUBLISHED):
        assert (scenes / f"{name}.yaml").is_file()
    assert set(pages.COUNTED) <= set(pages.PUBLISHED)


def test_the_first_page_counts_what_the_studies_kept(update, monkeypatch, tmp_path):
    page = update.first_page
    for name in ("stability", "benchmark", "sensitivity", "guaranteed"):
        (tmp_path / name).mkdir()
    statuses = "solutions,solved,wrong\n10,7,0\n5,4,1\n"
    times = "scene,element,method,n,dofs,total\npaper,CR,fourier,512,9,1\n"
    times += "paper,P1,fourier,256,9,1\npaper,P1,fourier,512,262656,0.0316\n"
    digits = "hypothesis,of,errors,digits\nnone,all,24,19\n"
    digits += "load in single precision,reference,24,20\nload in single precision,all,24,23\n"
    (tmp_path / "sensitivity/sensitivity_digits.csv").write_text(digits, encoding="utf-8")
    (tmp_path / "stability/statuses.csv").write_text(statuses, encoding="utf-8")
    (tmp_path / "benchmark/benchmark.csv").write_text(times, encoding="utf-8")
    bounds = "element,n,lower,upper,printed\nP1,64,1,2,3\nCR,8,1,2,3\n"
    bounds += "CR,64,0.0208769,0.0209381,0.0210075\n"
    (tmp_path / "guaranteed/guaranteed.csv").write_text(bounds, encoding="utf-8")
    monkeypatch.setattr(page, "STUDIES", tmp_path)
    assert page.proofs() == {"solutions": 15, "solved": 11, "wrong": 1}
    assert page.speed() == {"unknowns": "262 656", "milliseconds": pytest.approx(31.6)}
    text = page.promises("all 28 numbers met; largest distance 1\n")
    assert "all 28 numbers met (" in text
    assert "single precision, 23 of 24\n" in text
    assert "262 656 unknowns, takes 32 ms\n" in text
    assert "64 by 64 squares lies between 0.020876 and 0.020939" in text  # rounded outward


def test_the_first_page_says_none_where_no_solve_is_wrong(update):
    assert update.first_page.proofs()["wrong"] == "none"
