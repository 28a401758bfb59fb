"""Run the examples, draw their pictures, and write the page that shows them.

    python docs/draw_examples.py [--page]

With --page the pictures stay as they are.
"""

import argparse
import ast
import runpy
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = sorted((ROOT / "examples").glob("ex*.py"))
PAGE, PICTURES = ROOT / "docs/examples.md", ROOT / "docs/pictures/examples"
COLOURS = 48  # of a picture
HEAD = """# Examples

Each is a script that teaches one thing, from the mathematics to what one sees. Read it, and run it:

```
python examples/ex01_first_solve.py
```

It prints what it found and draws its picture into the folder that you are in.
[From Python](python.md) explains what they use. This page is written by `make examples`, the
pictures are what the scripts draw, and tests run them all.
"""


def lesson(path):
    """Title and text of the docstring of an example, and what its picture shows."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    title, _, rest = ast.get_docstring(tree).partition("\n\n")
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    shown = ast.get_docstring(functions["visualize"])
    return title.rstrip("."), rest, shown.rstrip(".")


def section(path):
    """What the page shows of an example, as Markdown."""
    title, text, shown = lesson(path)
    return f"""
## {title}

{text}

[examples/{path.name}](../examples/{path.name})

![{shown}](pictures/examples/{path.stem}.png)
"""


def page():
    """The whole page, as Markdown."""
    return HEAD + "".join(map(section, EXAMPLES))


def draw(path):
    """Run an example and write its picture."""
    from signorini.figures.style import save_figure

    figure = runpy.run_path(str(path))["visualize"]()
    target = PICTURES / f"{path.stem}.png"
    save_figure(figure, target, colours=COLOURS, sealed=False)


def main():
    """Draw, unless told not to, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--page", action="store_true", help="write the page alone")
    if not parser.parse_args().page:
        PICTURES.mkdir(parents=True, exist_ok=True)
        for path in EXAMPLES:
            draw(path)
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
