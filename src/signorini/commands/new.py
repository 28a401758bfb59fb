"""Write a commented scene to start from: config/scenes/NAME.yaml.

It is a valid scene as it stands. Every key that it leaves out is there behind a #, with its
default. With --paper an article comes with it, paper/NAME.tex, which builds as it stands too.

example:
  signorini new mine --paper
"""

import os
from pathlib import Path

from signorini.commands.catalogue import Outcome
from signorini.exceptions import SceneError, StorageError
from signorini.scene.file_names import check_name
from signorini.storage import replacing

_LIBRARY = Path(__file__).parents[1]
_SCENE, _ARTICLE = _LIBRARY / "scene/template.yaml", _LIBRARY / "publication/template.tex"
_SECTION = "# publication:                # an article"
_MANUSCRIPT = "#   manuscript: ../../paper/mine.tex     # example; it becomes paper.pdf"


def add_arguments(parser):
    """Declare the command's arguments."""
    parser.add_argument("name", metavar="NAME", help="letters, digits, '-' and '_'")
    parser.add_argument("--paper", action="store_true", help="with an article, paper/NAME.tex")
    parser.add_argument(
        "--folder",
        type=Path,
        default="config/scenes",
        help="default: %(default)s",
        metavar="FOLDER",
    )


def run(arguments):
    """Write the files; one that is there already is left alone.

    Raises
    ------
    SceneError, StorageError
        If a file is there already, or the scene's folder is not.
    """
    check_name(arguments.name)
    path = Path(arguments.folder, f"{arguments.name}.yaml")
    if not path.parent.is_dir():
        raise StorageError(f"{path.parent}: no such folder; name one with --folder")
    texts = {path: _SCENE.read_text(encoding="utf-8")}
    if arguments.paper:
        texts = _with_article(path, texts[path])
    for file in texts:
        if file.exists():
            raise SceneError(f"{file}: there already; choose another name, or delete it")
    for file, text in texts.items():
        file.parent.mkdir(exist_ok=True)
        with replacing(file, encoding="utf-8", newline="\n") as stream:
            stream.write(text)
    written = " and ".join(map(str, texts))
    return Outcome(f"{written}: written; edit, then: signorini check {path}", {"path": str(path)})


def _with_article(path, scene):
    """The scene with its section `publication`, and the article; path -> text."""
    article = Path(os.path.relpath(path.parent / f"../../paper/{path.stem}.tex"))
    scene = scene.replace(_SECTION, _SECTION.removeprefix("# "))
    scene = scene.replace(_MANUSCRIPT, f"  manuscript: ../../paper/{path.stem}.tex")
    text = _ARTICLE.read_text(encoding="utf-8").replace("NAME", path.stem)
    return {path: scene, article: text}
