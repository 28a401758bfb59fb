"""Formulas of the site as MathML, which browsers draw by themselves: no script, no network."""

import re

from docutils import nodes
from docutils.utils.math import pick_math_environment
from docutils.utils.math.latex2mathml import tex2mathml

TAG = re.compile(r"\\tag\{(.*?)\}")  # MathML has none
DOTS = re.compile(r"\\dots\b")  # unknown to docutils, which knows \ldots

SPACE = '<mspace width="0.17em"/>'
OPERAND = r"</m(?:i|n|sub|sup|subsup|row|over)>\s*"
NAME = "<mi>(?:log|sin|cos|cot)</mi>"
RELATION = "<mo>(?:&lt;|&gt;|[=≤≥,])</mo>"
# What TeX does by itself, as replacements in MathML.
FINISH = {
    '<mtable class="ams-align">': '<mtable class="ams-align" displaystyle="true">',
    # bars do not stretch over indices, and have no space around them
    r'<mo(?: stretchy="false"| class="mathopen")?>([|‖/⟨⟩])</mo>': (
        r'<mo stretchy="false" lspace="0" rspace="0">\1</mo>'
    ),
    "<mo>'</mo>": '<mo lspace="0" rspace="0">′</mo>',
    # a sign after a relation is no difference
    rf"({RELATION}\s*)<mo>−</mo>": r'\1<mo form="prefix">−</mo>',
    r"<mo(| movablelimits=\"true\")>(max|min|sup|inf)</mo>": (
        r'<mo\1 lspace="0.1em" rspace="0.17em">\2</mo>'
    ),
    # names of functions are set off from what stands before and, without a power, after
    rf"({OPERAND})((?:<msup>\s*)?{NAME})": rf"\1{SPACE}\2",
    rf"({NAME})(?=\s*<mo>&ApplyFunction;)": rf"\1{SPACE}",
}


def setup(app):
    """Register the renderer `mathml`, which `html_math_renderer` in conf.py names."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def inline(writer, node):
    """A formula within a line; a mark after it stays on that line."""
    writer.body.append(mathml(node.astext()) + "&#8288;")
    raise nodes.SkipNode


def block(writer, node):
    """A formula on lines of its own."""
    text = TAG.sub("", node.astext())
    number = "".join(f"({tag})" for tag in TAG.findall(node.astext()))
    formula = mathml(in_environment(text), as_block=True)
    writer.body.append(f'<div class="formula">{formula}<span>{number}</span></div>\n')
    raise nodes.SkipNode


def in_environment(text):
    """A formula with line breaks, unless it has an environment, becomes an aligned one."""
    name = pick_math_environment(text)
    aligned = name.startswith("align") and "\\begin" not in text
    return f"\\begin{{{name}}}{text}\\end{{{name}}}" if aligned else text


def mathml(text, as_block=False):
    """A formula in LaTeX as MathML."""
    found = tex2mathml(DOTS.sub(r"\\ldots", text), as_block=as_block)
    for pattern, replacement in FINISH.items():
        found = re.sub(pattern, replacement, found)
    return found
