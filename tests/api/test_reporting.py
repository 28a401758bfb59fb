"""A table of errors for an article and as a figure: what the workflow makes of the same rows."""

import pandas as pd
import pytest

import signorini
from signorini.exceptions import SignoriniError

SCENE = "config/scenes/smooth.yaml"


@pytest.fixture(scope="module")
def errors():
    return signorini.convergence(signorini.load_scene(SCENE))


def test_every_error_stands_in_the_table_with_its_rate(errors):
    lines = signorini.latex_table(errors, ["l2"]).splitlines()
    cells = {line.split(" & ")[0]: line.removesuffix(r" \\").split(" & ")[1:] for line in lines}
    p1, cr = (errors[errors["element"] == element]["l2"].tolist() for element in ("P1", "CR"))
    for k, n in enumerate((16, 32, 64), start=1):
        for own, (error, rate) in ((p1, cells[str(n)][:2]), (cr, cells[str(n)][2:])):
            mantissa, _, exponent = error.strip("$").partition(r"\times10^")
            assert float(f"{mantissa}e{exponent.strip('{}')}") == pytest.approx(own[k], rel=5e-3)
            assert float(rate) == pytest.approx(2.0, abs=0.05)


def test_norms_are_those_of_the_domain_unless_others_are_named(errors):
    text = signorini.latex_table(errors, rates=False, slopes=True, notation="fixed", digits=4)
    assert "$L^2$ error" in text
    assert "$H^1$ error" in text
    assert r"\midrule" + "\nslope & " in text
    assert "contact" not in text
    assert signorini.latex_table(errors, "trace_l2") == signorini.latex_table(errors, ["trace_l2"])


def test_a_table_read_from_a_file_is_the_same(errors, tmp_path):
    errors.to_csv(tmp_path / "errors.csv", index=False)
    read = pd.read_csv(tmp_path / "errors.csv")
    assert signorini.latex_table(read, ["l2", "h1"]) == signorini.latex_table(errors, ["l2", "h1"])


def test_the_figure_has_a_line_and_a_slope_for_each_element(errors, tmp_path):
    path = tmp_path / "h1.pdf"
    (axes,) = signorini.plot_errors(errors, "h1", path).axes
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["CF (P1), slope 0.99", "NCF (CR), slope 1.00"]
    drawn = {tuple(line.get_ydata()) for line in axes.lines}
    for element in ("P1", "CR"):
        assert tuple(errors[errors["element"] == element]["h1"]) in drawn
    assert path.stat().st_size > 0


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda e: signorini.latex_table(e, ["l3"]), "norms: 'l3' is not there; did you mean l2?"),
        (lambda e: signorini.latex_table(e, notation="exp"), "notation: 'exp' is not there"),
        (lambda e: signorini.latex_table(e, labels="CR"), "labels: 'CR' is not there"),
        (lambda e: signorini.latex_table(pd.concat([e, e])), "an element and n occur twice"),
        (lambda e: signorini.latex_table(e.drop(columns="floor")), "errors: no column 'floor'"),
        (lambda e: signorini.plot_errors(e, "energy2"), "norms: 'energy2' is not there"),
        (lambda e: signorini.plot_errors(e.iloc[:1]), "two levels"),
        (lambda e: signorini.plot_errors(e.assign(element="Q1")), "element: 'Q1' is not there"),
        (lambda e: signorini.plot_errors(e, path="a.svg"), "path: 'a.svg' is no figure"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(errors, make, words):
    with pytest.raises(SignoriniError) as caught:
        make(errors)
    assert "\n" not in str(caught.value)
    assert words in str(caught.value)
