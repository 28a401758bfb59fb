"""Where lines of the site may break: in names in tables, but neither in an option of a command nor
between a formula and the mark after it.
"""

import re

TABLE = re.compile(r"<table.*?</table>", re.S)
NAME = re.compile(r'(?<=<span class="pre">)[^<]+')
JOINT = re.compile(r"(?<=[A-Za-z0-9;])([._/=])(?=[A-Za-z0-9&])")  # entities are &lt; and the like
OPTION = re.compile(r'<span class="pre">(?=--?\w)')
FORMULA = r"<math(?:(?!</math>).)*</math>"
MARKED = re.compile(rf"({FORMULA})(?:&#8288;|\u2060)([.,;:)]+)", re.S)


def broken(body):
    """The HTML of a page, in whose tables long names may break at their joints.

    A file or a function that is wider than its column then goes on after a dot, a slash or an
    underscore. What a reader copies stays the same.
    """
    return TABLE.sub(lambda table: NAME.sub(at_joints, table[0]), body)


def at_joints(name):
    """A name that may break after its joints."""
    return JOINT.sub(r"\1<wbr>", name[0])


def together(body):
    """The HTML of a page, each option on one line, and each formula with the mark after it."""
    options = OPTION.sub('<span class="pre together">', body)
    return MARKED.sub(r'<span class="together">\1\2</span>', options)


def finish(app, page, template, context, tree):
    """Sphinx's hook for a page that is about to be written."""
    if "body" in context:
        context["body"] = together(broken(context["body"]))


def setup(app):
    """Finish every page."""
    app.connect("html-page-context", finish)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
