"""What a manuscript asks for: numbers with their lines, and files, its own and the scene's."""

from articles import ARTICLE

from signorini.publication.made import made_files, tables_of, taken_files
from signorini.publication.manuscript import Use, read_manuscript

BODY = r"""An error \result{l2,CR , 4} and \result[digits=2]{h1,
  P1, 2}.
% \result{no, number}
100\% \result{slope, l2, CR} \\% \result{neither}
\begin{verbatim}
\result{in, a, listing}
\end{verbatim}
\resultant{x} \newcommand{\mine}[1]{\result{l2, CR, #1}}"""


def test_uses_are_found_with_their_lines(project):
    _, path = project.article(BODY)
    assert read_manuscript(path).uses == (
        Use(f"{path}:5", "l2, CR, 4"),
        Use(f"{path}:5", "h1, P1, 2", "digits=2"),
        Use(f"{path}:8", "slope, l2, CR"),
        Use(f"{path}:12", "l2, CR, #1"),
    )


def test_braces_within_a_use_and_a_definition_are_closed(project):
    body = "\\renewcommand\\result[2][]{#2} \\result{l2, \\norm{a}, 4}\\result{l2, CR,\n% {\n4}"
    _, path = project.article(body)
    assert [use.key for use in read_manuscript(path).uses] == ["l2, CR, 4"]


def test_a_key_that_a_macro_completes_is_open_up_to_there():
    assert Use("", "l2, CR, #1").stem == "l2, CR"
    assert Use("", r"\norm, CR").stem == ""
    assert not Use("", "l2, CR, 4").is_open


def test_files_of_its_folder_are_its_own_and_are_read_in_turn(project):
    _, path = project.article(
        r"\input{part}\includegraphics[width=1cm]{photo}\bibliography{mine,other}"
        r"\usepackage{ours}\input{table}\includegraphics{figures/l2}\input{\jobname-x}"
    )
    names = ("part.tex", "photo.png", "mine.bib", "ours.sty", "deep.tex")
    for name in names:
        project.write(f"article/{name}", "\n")
    project.write("article/part.tex", "\n\\include{deep} \\result{h, CR, 2}\n")
    found = read_manuscript(path)
    assert {file.name for file in found.files} == {"mine.tex", *names}
    assert found.files[0] == path
    assert [use.place for use in found.uses] == [f"{path.parent / 'part.tex'}:2"]
    others = [entry.name for entry in found.others]
    assert others == ["article", "booktabs", "graphicx", "macros.tex", *others[4:]]
    assert others[4:] == ["other", "table", "figures/l2"]


def test_pictures_are_looked_for_where_graphicspath_says(project):
    scene, path = project.article(
        r"\graphicspath{{figures/}{photos/}}\includegraphics{l2}\input{part}"
    )
    part = project.write("article/part.tex", r"\includegraphics{meadow}")
    (project.folder / "article/photos").mkdir()
    photo = project.write("article/photos/meadow.png", "x")
    assert read_manuscript(path).files == (path, part, photo)
    assert taken_files(scene.document) == ["macros.tex", "figures"]


def test_a_file_above_the_folder_of_the_article_is_not_its_own(project):
    _, path = project.article(r"\input{../secret}\includegraphics{/etc/hostname}")
    project.write("secret.tex", "x")
    found = read_manuscript(path)
    assert found.files == (path,)
    assert {"../secret", "/etc/hostname"} <= {entry.name for entry in found.others}


def test_what_it_takes_in_is_what_is_built_for_it(project):
    scene, _ = project.article(
        r"\input{table}\includegraphics{figures/h1}\includegraphics{figures/l2}"
    )
    assert taken_files(scene.document) == ["macros.tex", "table.tex", "figures"]
    bare, _ = project.article("A word.", ARTICLE.replace("\\input{macros.tex}\n", ""))
    assert taken_files(bare.document) == ["macros.tex"]


def test_the_tables_that_are_read_are_those_of_its_keys(project):
    cases = {
        r"\result{level, finest}": ["scene"],
        r"\result{l2, CR, 4}\result{rate, l2, CR, 4}": ["errors"],
        r"\result{slope, h1, P1, fit}\result{critical, CR, 1}": ["rates", "contact_line"],
        r"\result{effect, load}\result{surface, corner}": ["effects", "surface"],
        r"\newcommand{\x}[1]{\result{slope, #1}}": ["rates"],
        "no number": [],
    }
    for body, tables in cases.items():
        scene, _ = project.article(body)
        assert tables_of(scene.document) == tables, body


def test_without_a_manuscript_errors_slopes_and_the_check_are_macros(project):
    scene, _ = project.published("l2,CR,4,0.02,1")
    assert tables_of(scene.document) == ["scene", "errors", "rates", "check"]


def test_a_scene_makes_its_table_and_figures_under_their_names(project):
    text = "names: {table: table_1, surface: figure_1, l2: figure_2}"
    made = made_files(project.scene(text).document)
    assert {"table_1.tex", "figure_1.pdf", "figure_2.png", "macros.tex"} <= made.keys()
    assert made["figures/contact_line.pdf"] == "figures"
    assert "table.tex" not in made
