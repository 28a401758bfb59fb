"""Mistakes in a publication: one line with the place, the value and the remedy, before any work."""

import shutil

import pytest
from articles import ARTICLE, SCENE

from signorini.exceptions import SignoriniError
from signorini.publication.check import check_publication

KPSEWHICH = pytest.mark.skipif(not shutil.which("kpsewhich"), reason="kpsewhich is not installed")


def refusal(function, *arguments, **keywords):
    """What is said; it must be one line."""
    with pytest.raises(SignoriniError) as caught:
        function(*arguments, **keywords)
    assert "\n" not in str(caught.value)
    return str(caught.value)


# Body of the article -> line of the mistake, and what is said.
BODIES = {
    r"\result{l2, RC, 4}": (5, r"\result{l2, RC, 4}: the scene mine has no such number; did you "),
    r"\result{l2, CR, 8}": (5, "did you mean {l2, CR, 4}?"),
    r"\result{energy, CR, 4}": (5, "`signorini macros SCENE` lists all"),
    "\n\n" r"\result{slope, l3, CR}": (7, "did you mean {slope, l2, CR}?"),
    r"\result{rate, l2, CR, 2}": (5, "has no such number"),  # there is no level before
    r"\result{check, total}": (5, "has no such number"),
    r"\result{contact, u, CR, 0}": (5, "has no such number"),
    r"\result{contact, u, CR, one}": (5, "has no such number"),
    r"\newcommand{\x}[1]{\result{lll, #1}}": (5, "has no such number"),
    r"\result[digts=3]{l2, CR, 4}": (5, r"\result[digts=3]: digts is no option; did you mean dig"),
    r"\result[notation=si]{l2, CR, 4}": (5, "notation=si is not valid; known: auto, fixed"),
}


@pytest.mark.parametrize("body", BODIES)
def test_a_wrong_use_is_told_with_its_line(project, body):
    scene, path = project.article(body)
    line, said = BODIES[body]
    told = refusal(check_publication, scene)
    assert told.startswith(f"{path}:{line}: ")
    assert said in told


@pytest.mark.parametrize("count", [2, 5, 7])
def test_all_wrong_uses_are_told_or_the_first_of_many(project, count):
    scene, path = project.article("\n".join(rf"\result{{l{k}, RC, 4}}" for k in range(count)))
    first, *others = refusal(check_publication, scene).split("; also ")
    told = [first, *others][: min(count, 5)]
    for k, complaint in enumerate(told):
        assert complaint.startswith(rf"{path}:{5 + k}: \result{{l{k}, RC, 4}}: ")
    assert others[4:] == (["2 more"] if count == 7 else [])


@pytest.mark.parametrize(
    "body",
    [
        "It is \\result{l2, CR, 4 and small.\n\nMore.",
        "\\result[digits=2]{l2, CR, 4 \\}",
        "\\result{l2, CR, 4 and \\result{h1, CR, 4}",
    ],
)
def test_a_use_that_is_not_closed_is_told_with_its_line(project, body):
    with pytest.raises(SignoriniError, match=r"is not closed; add a brace$") as caught:
        check_publication(project.article(f"\n{body}")[0])
    assert str(caught.value).startswith("article/mine.tex:6: \\result")


def test_right_uses_pass(project):
    scene, _ = project.article(
        r"\result{l2, CR, 4} \result[decimals=2]{slope, h1_semi, P1, fit} "
        r"\result{contact, u, CR, 9} \result{critical, P1, 1} \result{effect, load} "
        r"\result{reference, n} \result{h,P1,2}"
    )
    check_publication(scene)


@KPSEWHICH
@pytest.mark.parametrize(
    ("body", "said"),
    [
        (r"\includegraphics{figures/l3}", "figures/l3: no such file beside the manuscript"),
        (r"\includegraphics{figures/l3}", "did you mean figures/l2.p"),
        (r"\input{tabel}", "did you mean table.tex? it makes macros.tex, table.tex, "),
        (r"\bibliography{mine}", "mine: no such file beside the manuscript"),
    ],
)
def test_a_file_that_is_nowhere_is_told_with_its_line(project, body, said):
    scene, path = project.article(f"\n{body}")
    told = refusal(check_publication, scene)
    assert told.startswith(f"{path}:6: ")
    assert said in told


@KPSEWHICH
def test_a_file_of_the_distribution_is_no_mistake(project):
    scene, _ = project.article(r"\input{article.cls}")
    check_publication(scene)


def test_macros_that_are_not_taken_in(project):
    text = ARTICLE.replace("\\input{macros.tex}\n", "")
    scene, path = project.article(r"\result{l2, CR, 4}", text)
    assert refusal(check_publication, scene) == (
        f"{path}:4: \\result is not defined; add \\input{{macros.tex}} to the preamble"
    )


def test_a_file_of_the_article_that_hides_one_of_the_scene(project):
    project.write("article/table.tex", "old")
    scene, path = project.article(r"\input{table}")
    told = refusal(check_publication, scene)
    assert told.startswith(f"{path.parent / 'table.tex'}: the scene makes a file of that name; ")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("l2,P2,4,0.1,1", "computes no {l2, P2, 4}; did you mean {l2, P1, 4}?"),
        ("l2,CR,64,0.1,1", "computes no {l2, CR, 64}"),
        ("lll,CR,4,0.1,1", "computes no {lll, CR, 4}"),
        ("slope h1,CR,4,0.1,1", "computes no {slope, h1, CR, 4}"),
        ("effect load,,,0.1,1", "computes no {effect, load}"),  # which is none of its results
        ("l2,CR,4,0.1.2,1", "value: '0.1.2' is no number"),
    ],
)
def test_a_published_number_that_the_scene_does_not_compute(project, line, said):
    scene, path = project.published("h1,P1,2,0.7,1", line)
    told = refusal(check_publication, scene)
    assert told.startswith(f"{path}: line 3: ")
    assert said in told


def test_published_numbers_of_every_kind_pass(project):
    scene, _ = project.published(
        "l2,CR,4,0.02,1", "slope l2,P1,,2.1,1", "rate h1,CR,4,1.0,1", "dofs,P1,2,6,0"
    )
    check_publication(scene)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("manuscript: ../../article/none.tex", "is no file, relative to "),
        ("manuscript: ../../articles/mine.tex", "there is no such folder; mend the path"),
        ("manuscript: ../../article/mine.pdf", "is not valid; name a file .tex"),
        ("manuscript: ../../../other.tex", "leads out of the project, "),
        ("manuscript: /etc/mine.tex", "leads out of the project, "),
        ("published: ../../article/none.csv", "is no file, relative to "),
        ("names: {l2: macros}", "names.l2: macros is the name of another file; choose another"),
        ("names: {l2: table}", "names.l2: table is the name of another file"),
        ("names: {l2: one, h1: one}", "names.l2: one is also the name of h1; every file needs its"),
        ("names: {energy: one}", "names.energy: the norm is not computed; add it to norms"),
        ("names: {l2: a b}", 'names.l2: "a b" is not valid; use 1 to 64 letters'),
        ("names: {l3: one}", "names.l3: not a valid key; did you mean l2?"),
        ("manuscripts: x.tex", "manuscripts: unknown key; did you mean manuscript?"),
    ],
)
def test_a_section_that_is_not_valid(project, line, said):
    told = refusal(project.scene, line)
    assert "config/scenes/mine.yaml: publication." in told
    assert said in told


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("{kind: reference, n: 16}", "{kind: exact, u: 1 - y}", "names: {surface: a}"),
        (
            "{kind: reference, n: 16}",
            "{kind: reference, n: 16, element: CR}",
            "names: {surface: a}",
        ),
        ("{kind: reference, n: 16}", "{kind: none}", "names: {l2: a}"),
        ("[2, 4]", "[2]", "names: {table: a}"),
    ],
)
def test_names_of_what_the_scene_cannot_have(project, old, new, line):
    text = SCENE.replace(old, new) + "" * bool(new)
    if "[2]" in text or "none" in text:
        text = text.replace("norms:", "outputs: []\nnorms:")
    told = refusal(project.scene, line, text=text)
    assert "publication.names." in told
    assert "drop it" in told


def test_the_near_file_is_named(project):
    project.write("article/paper.tex", "x")
    told = refusal(project.scene, "manuscript: ../../article/papr.tex")
    assert "did you mean paper.tex?" in told
