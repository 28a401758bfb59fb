"""In docstrings |b| is the absolute value of b; to reStructuredText it would be a name."""

import re

BARS = re.compile(r"(?<!\\)\|")


def escape(app, what, name, thing, options, lines):
    """Escape the bars of a docstring, but not in its examples."""
    lines[:] = [line if ">>>" in line or "``" in line else BARS.sub(r"\\|", line) for line in lines]


def setup(app):
    """Do it after numpydoc has read the docstring."""
    app.connect("autodoc-process-docstring", escape, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
