"""Draw the solutions of many scenes on one sheet, to PDF and PNG."""

import json

from stage import options, run

from signorini.figures.gallery import draw_gallery
from signorini.figures.style import save_figure
from signorini.storage import read_npz


@options("--titles", ("--fields", {"nargs": "+"}), ("--outputs", {"nargs": "+"}))
def main(arguments):
    """Names and titles of the scenes, a JSON object, and as many field.npz to a figure in each of
    the formats.
    """
    titles = json.loads(arguments.titles)
    fields = [read_npz(path, kind="field") for path in arguments.fields]
    scenes = zip(titles.items(), fields, strict=True)
    figure = draw_gallery([(name, title, field) for (name, title), field in scenes])
    for path in arguments.outputs:
        save_figure(figure, path)
    return f"figure: gallery of {len(fields)} scenes"


if __name__ == "__main__":
    run(main, __doc__)
