"""Pages: one template, two layouts."""

from pathlib import Path

import jinja2
import pytest

from signorini.report import document, quantities
from signorini.report.document import Table, render_text
from signorini.report.markup import latex_text

PAGE = """
# A_B

50 % of $a_1$, see @b_c
and @t-u; `x_y`, *so*, [data](b.csv).

{% call figure("b_c") %} A & B, beside @t-u {% endcall %}

## Then {{ costs|seconds }}

{% call table("t-u", shown) %} T {% endcall %}

{% if not latex %}
[rows](b.csv) only here
{% endif %}
"""
SHOWN = Table(
    header=("x", "y", "z"),
    rows=[["first"], ["p", 1, "-3 %"], ["a|b", "", ""]],
    groups=(("", 1), ("both", 2)),
)


@pytest.fixture(params=["markdown", "latex"])
def layout(request):
    return request.param


def page(layout):
    return render_text(PAGE, layout, costs=0.02, shown=SHOWN)


def test_a_page_in_latex():
    text = page("latex")
    assert text.startswith(
        "\\section{A\\_B}\n\n"
        "50\\,\\% of $a_1$, see \\autoref{figure:b_c} and \\autoref{table:t-u};"
        " \\texttt{x\\_y}, \\emph{so}, data.\n"
    )
    assert "\\includegraphics{b_c.pdf}\n\\caption{A \\& B, beside \\autoref{table:t-u}}" in text
    assert "}\\label{figure:b_c}\n\\end{figure}\n\n\\subsection{Then 20 ms}\n\n" in text
    assert "\\begin{tabular}{lrr}\n" in text
    assert "\\multicolumn{1}{c}{} & \\multicolumn{2}{c}{both} \\\\\n\\cmidrule(lr){2-3}\n" in text
    assert "\\multicolumn{3}{l}{\\emph{first}} \\\\\np & 1 & $-$3\\,\\% \\\\\n" in text
    assert "only here" not in text
    assert text.endswith("\\clearpage\n")


def test_a_page_in_markdown():
    text = page("markdown")
    assert text.startswith(
        "# A_B\n\n50 % of $a_1$, see Figure 1 and Table 1; `x_y`, *so*, [data](b.csv).\n\n"
    )
    figure = "![A & B, beside Table 1](b_c.png)\n\n*Figure 1.* A & B, beside Table 1\n\n"
    assert f"{figure}## Then 20 ms\n\n" in text
    assert "*Table 1.* T\n\n| x | both y | both z |\n| :--- | ---: | ---: |\n" in text
    assert "| *first* |  |  |\n| p | 1 | -3 % |\n| a\\|b |  |  |\n\n" in text
    assert text.endswith("[rows](b.csv) only here\n")


PIPED = """
{% call table("t", groups=(("", 1), ("both", 2))) %}
The caption
in two lines.

| x | y | z |
| :--- | ---: | ---: |
| first |
{% for row in rows %}
| {{ row.name|cell }} | {{ row.size|formatted(".1f") }} |
{{ none|formatted(".1f") }} |
{% endfor %}
{% endcall %}
"""


def test_a_table_in_the_template_is_the_table_it_looks_like(layout):
    rows = [["first"], ["a|b", "2.0", "--"]]
    same = Table(("x", "y", "z"), rows, groups=(("", 1), ("both", 2)))
    called = '{% call table("t", it) %} The caption in two lines. {% endcall %}'
    slots = {"rows": [{"name": "a|b", "size": 2}]}
    assert render_text(PIPED, layout, **slots) == render_text(called, layout, it=same)


def test_braces_and_environments_are_balanced():
    text = page("latex")
    assert text.count("{") == text.count("}")
    assert text.count("\\begin{") == text.count("\\end{")


def test_sentences_are_broken_into_lines():
    table = Table(("claim", "met"), [["a long one", "yes"]], sentences=True)
    text = render_text('{% call table("t", it) %} T {% endcall %}', "latex", it=table)
    assert r"\begin{tabular}{p{0.66\linewidth}r}" in text


def test_a_slot_left_empty_is_an_error(layout):
    with pytest.raises(jinja2.UndefinedError, match="share"):
        render_text("{{ share }} %", layout)


def test_a_reference_to_nothing_is_an_error(layout):
    with pytest.raises(KeyError, match="nothing"):
        render_text("See @nothing.", layout)


def test_a_clock_rate_is_no_reference(layout):
    assert "CPU @ 2.20GHz" in render_text("CPU @ 2.20GHz", layout)


@pytest.mark.parametrize(
    ("plain", "typeset"),
    [
        ("2e-14 & -3 %", r"$2\times10^{-14}$ \& $-$3\,\%"),
        ("≤2, <0.1, 5 × 3", r"$\le$2, $<$0.1, 5 $\times$ 3"),
        ("1e+06, l-shape, 2026-11-22", "$10^{6}$, l-shape, 2026-11-22"),
        ("of $a_1 - 2$ and", "of $a_1 - 2$ and"),
        ("$$a_1 - 2$$", r"\[a_1 - 2\]"),
    ],
)
def test_numbers_and_mathematics_in_latex(plain, typeset):
    assert latex_text(plain) == typeset


@pytest.mark.parametrize(
    ("function", "value", "text"),
    [
        (quantities.seconds, 2.345, "2.3 s"),
        (quantities.seconds, 0.9949, "995 ms"),
        (quantities.seconds, 0.00012, "120 us"),
        (quantities.thousands, 42, "42"),
        (quantities.thousands, 1234, "1.2 k"),
        (quantities.thousands, 12_600_000, "13 M"),
        (quantities.megabytes, 99_000, "<0.1"),
        (quantities.megabytes, 1_240_000, "1.2"),
        (quantities.factor, 0.05, "0.05"),
        (quantities.factor, 123.4, "123"),
    ],
)
def test_quantities_have_two_digits(function, value, text):
    assert function(value) == text


def test_the_templates_are_part_of_the_package():
    assert all(
        Path(document.__file__).parents[1].joinpath(p).is_file() for p in document.LAYOUTS.values()
    )
