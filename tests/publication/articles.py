"""Scenes with articles, each in a folder of its own, as a user would have them."""

from pathlib import Path

from signorini.scene.read import read_scene

SCENE = """\
domain: {kind: rectangle}
boundary: {top: dirichlet, bottom: contact, left: neumann, right: neumann}
data: {f: 2*pi*sin(2*pi*x)}
levels: [2, 4]
truth: {kind: reference, n: 16}
norms: [l2, h1]
publication:
"""
HEADER = "quantity,element,n,value,tolerance\n"
ARTICLE = r"""\documentclass{article}
\usepackage{booktabs,graphicx}
\input{macros.tex}
\begin{document}
%s
\end{document}
"""


class Project:
    """A folder with config/scenes/mine.yaml, a manuscript and published numbers."""

    def __init__(self, folder):
        self.folder = Path(folder)
        for name in ("config/scenes", "article"):
            (self.folder / name).mkdir(parents=True)

    def write(self, path, text):
        """Write a file of the project, and return its path within."""
        (self.folder / path).write_text(text, encoding="utf-8")
        return Path(path)

    def scene(self, *lines, text=SCENE):
        """The scene whose section has these lines, read."""
        section = "".join(f"  {line}\n" for line in lines)
        return read_scene(self.write("config/scenes/mine.yaml", text + section))

    def article(self, body, text=ARTICLE):
        """The scene with an article of this body, and the article's path."""
        path = self.write("article/mine.tex", text % body)
        return self.scene("manuscript: ../../article/mine.tex"), path

    def published(self, *lines):
        """The scene with a table of these lines, and the table's path."""
        path = self.write("article/table.csv", HEADER + "".join(f"{line}\n" for line in lines))
        return self.scene("published: ../../article/table.csv"), path
