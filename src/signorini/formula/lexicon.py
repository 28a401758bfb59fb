"""The words of a formula: its text cut into tokens, and what to say of text that has other words.

Neither this module nor `grammar` imports numpy: formulas are already read while a Snakefile is
parsed.
"""

import difflib
import math
import re
import unicodedata
from typing import NamedTuple

from signorini.exceptions import FormulaError

MAX_CHARACTERS = 1000

VARIABLES = ("x", "y", "r", "theta")
CONSTANTS = {"pi": math.pi, "e": math.e}
# Least and greatest number of arguments.
FUNCTIONS = {
    **dict.fromkeys(("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan"), (1, 1)),
    **dict.fromkeys(
        ("sinh", "cosh", "tanh", "abs", "pos", "sign", "step", "floor", "ceil"), (1, 1)
    ),
    **dict.fromkeys(("atan2", "hypot"), (2, 2)),
    **dict.fromkeys(("min", "max"), (2, math.inf)),
    "where": (3, 3),
}
KNOWN = (*VARIABLES, *CONSTANTS, *sorted(FUNCTIONS))

TOKEN = re.compile(
    r"(?P<space>[ \t]+)"
    r"|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(?P<suffix>\w*)"
    r"|(?P<symbol>\*\*|<=|>=|==|!=|[-+*<>(),]|/(?!/)|(?:and|or|not)\b)"
    r"|(?P<call>[A-Za-z_]\w*)[ \t]*\("
    r"|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<stray>//|.)",
    re.ASCII | re.DOTALL,
)

_POWER = "write x**2 for a power"
_TIMES = "write * between factors, as in 2*x"
_WHERE = "write where(condition, a, b)"
_PLAIN = "write functions without a module, as in sin(x)"
REMEDIES = {
    **dict.fromkeys(("^", "²", "pow", "power"), _POWER),
    **dict.fromkeys(("×", "·"), _TIMES),
    **dict.fromkeys(("if", "else", "True", "False"), _WHERE),
    **dict.fromkeys((".", "np", "numpy", "math"), _PLAIN),
    **dict.fromkeys("[]{}", "write round parentheses"),
    **dict.fromkeys("\r\n", "write the formula on one line"),
    **{name: f"write a{name[3:]}(...)" for name in ("arcsin", "arccos", "arctan", "arctan2")},
    "ln": "write log(x)",
    "log10": "write log(x)/log(10)",
    "fabs": "write abs(x)",
    "heaviside": "write step(x)",
    "maximum": "write max(a, b)",
    "minimum": "write min(a, b)",
    "//": "write floor(a/b)",
    "%": "write a - b*floor(a/b)",
    "=": "write == to compare; functions take no named arguments",
    "&": "write and",
    "|": "write or",
    "!": "write not",
    "−": "write an ASCII -",
    "π": "write pi",
    "θ": "write theta",
}


class Token(NamedTuple):
    """A piece of the text; columns count from 1."""

    kind: str
    text: str
    column: int


def shorten(text, width=60):
    """Quote text on one ASCII line, its first `width` characters or so."""
    return ascii(text if len(text) <= width else text[: width - 3] + "...")


def as_text(value, field):
    """Text of a formula that is given as text or as a number; FormulaError for anything else."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise FormulaError(
            f"{field}: a formula is text or a number, not {type(value).__name__}; write 0 or x*y"
        )
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise FormulaError(f"{field}: number {number} out of range; a double holds up to 1.8e308")
    return str(value) if isinstance(value, int) else repr(number)


class Source:
    """Text of one formula, as tokens, with the errors that point into it."""

    def __init__(self, text, field):
        self.text, self.field = text, field

    def error(self, problem, column, remedy):
        """One-line error that names the field, the place and the remedy."""
        return FormulaError(
            f"{self.field}: {problem} at column {column} of {shorten(self.text)}; {remedy}"
        )

    def tokens(self):
        """All tokens and an "end"; the name of a function takes its opening parenthesis along."""
        if len(self.text) > MAX_CHARACTERS:
            problem = f"more than {MAX_CHARACTERS} characters"
            raise self.error(problem, MAX_CHARACTERS + 1, "shorten the formula")
        found = []
        for match in TOKEN.finditer(self.text):
            kind = "number" if match["number"] else match.lastgroup
            token = Token(kind, match[kind], match.start() + 1)
            if kind == "stray":
                raise self.stray(token)
            if kind == "number":
                self.check_number(token, match["suffix"])
            if kind != "space":
                found.append(token)
        return [*found, Token("end", "nothing", len(self.text) + 1)]

    def check_number(self, token, suffix):
        """Refuse what is no decimal number, and what a double cannot hold."""
        _, digits, column = token
        shown, value = shorten(digits + suffix, 30), float(digits)
        if suffix in ("j", "J"):
            raise self.error(f"complex number {shown}", column, "a formula is real")
        if suffix:
            raise self.error(
                f"{shown} is no number", column, f"{_TIMES}, and numbers as 0.5 or 1e-3"
            )
        if re.match(r"0\d", digits):
            raise self.error(f"leading zero in {shown}", column, "write the number without it")
        if value == math.inf or (value == 0 and re.match(r"[0.]*[1-9]", digits)):
            raise self.error(
                f"number {shown} out of range", column, "a double holds 5e-324 to 1.8e308"
            )

    def stray(self, token):
        """Error for a character that no formula has."""
        shown = ascii(token.text)
        if not token.text.isascii():
            shown = f"non-ASCII U+{ord(token.text):04X} {unicodedata.name(token.text, '')}".strip()
        remedy = REMEDIES.get(
            token.text, "use names, numbers and + - * / ** ( ) , < <= > >= == != only"
        )
        return self.error(f"unexpected {shown}", token.column, remedy)

    def unknown(self, token):
        """Error for an unknown name, with the nearest known one."""
        name = token.text
        near = difflib.get_close_matches(name, KNOWN, 1) or difflib.get_close_matches(
            name.lower(), KNOWN, 1
        )
        remedy = f"did you mean {near[0]}?" if near else "mind the spelling"
        if set(name) <= set("xyr"):
            remedy = f"write {'*'.join(name[:20])}"
        remedy = f"{REMEDIES.get(name, remedy)} (known: {', '.join(KNOWN)})"
        return self.error(f"unknown name {shorten(name, 30)}", token.column, remedy)
