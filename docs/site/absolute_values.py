"""In docstrings |b| is the absolute value of b; to reStructuredText it would be a name."""

import re

BAR = re.compile(r"(?<!\\)\|")
LITERAL = re.compile(r"(``.*?``)")


def escaped(line):
    """A line with its bars escaped, but not in an example, nor between double backquotes."""
    if ">>>" in line:
        return line
    parts = LITERAL.split(line)
    parts[::2] = [BAR.sub(r"\\|", part) for part in parts[::2]]
    return "".join(parts)


def escape(app, what, name, thing, options, lines):
    """Sphinx's hook for a docstring."""
    lines[:] = map(escaped, lines)


def setup(app):
    """Do it after numpydoc has read the docstring."""
    app.connect("autodoc-process-docstring", escape, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
