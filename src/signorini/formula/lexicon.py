"""The lexer of formulas: text cut into tokens, and error messages for text that has no token.

Neither this module nor `grammar` imports numpy: formulas are already read while a Snakefile is
parsed.
"""

import difflib
import math
import re
import unicodedata
from typing import NamedTuple

from signorini.exceptions import FormulaError

_MAX_CHARACTERS = 1000

VARIABLES = ("x", "y", "r", "theta")
CONSTANTS = {"pi": math.pi, "e": math.e}
# Function -> its least and greatest number of arguments.
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

_TOKEN = re.compile(
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
_REMEDIES = {
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
    """Quote text on one ASCII line, cut if it is long.

    Parameters
    ----------
    text : str
    width : int
        Characters of the text that are shown; an escaped one takes more room than one.

    Returns
    -------
    str

    Examples
    --------
    >>> shorten("x + y + r", 6)
    "'x +...'"
    """
    return ascii(text if len(text) <= width else text[: width - 3] + "...")


def as_text(value, field):
    """The text of a formula that is given as text or as a number.

    Parameters
    ----------
    value : str, int or float
    field : str
        Name of the quantity, for error messages.

    Returns
    -------
    str

    Raises
    ------
    FormulaError
        If the value is of another type, or a number that no double holds.

    Examples
    --------
    >>> as_text(0.5, "data.f")
    '0.5'
    """
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
    """Text of one formula, as tokens, with the errors that point into it.

    Parameters
    ----------
    text : str
    field : str
        Name of the quantity, for error messages.
    """

    def __init__(self, text, field):
        self.text = text
        self.field = field

    def error(self, problem, column, remedy):
        """One-line error that names the field, the place and the remedy.

        Parameters
        ----------
        problem : str
        column : int
            Where it is, counted from 1.
        remedy : str

        Returns
        -------
        FormulaError
        """
        return FormulaError(
            f"{self.field}: {problem} at column {column} of {shorten(self.text)}; {remedy}"
        )

    def tokens(self):
        """All tokens and an "end"; the name of a function takes its opening parenthesis along.

        Returns
        -------
        list of Token

        Raises
        ------
        FormulaError
            If the text is too long, or has a character or number that no formula has.

        Examples
        --------
        >>> [token.text for token in Source("2*x + 1", "data.f").tokens()]
        ['2', '*', 'x', '+', '1', 'nothing']
        """
        if len(self.text) > _MAX_CHARACTERS:
            problem = f"more than {_MAX_CHARACTERS} characters"
            raise self.error(problem, _MAX_CHARACTERS + 1, "shorten the formula")
        tokens = []
        for match in _TOKEN.finditer(self.text):
            # A number is followed by its suffix, the group that matched last.
            kind = "number" if match["number"] else match.lastgroup
            token = Token(kind, match[kind], match.start() + 1)
            if kind == "stray":
                raise self._stray_character_error(token)
            if kind == "number":
                self._check_number(token, match["suffix"])
            if kind != "space":
                tokens.append(token)
        return [*tokens, Token("end", "nothing", len(self.text) + 1)]

    def _check_number(self, token, suffix):
        """Refuse what is no decimal number, and what a double cannot hold."""
        digits, column = token.text, token.column
        shown = shorten(digits + suffix, 30)
        if suffix in ("j", "J"):
            raise self.error(f"complex number {shown}", column, "a formula is real")
        if suffix:
            remedy = f"{_TIMES}, and numbers as 0.5 or 1e-3"
            raise self.error(f"{shown} is no number", column, remedy)
        if re.match(r"0\d", digits):
            raise self.error(f"leading zero in {shown}", column, "write the number without it")
        value = float(digits)
        underflows = value == 0 and re.match(r"[0.]*[1-9]", digits)
        if value == math.inf or underflows:
            remedy = "a double holds 5e-324 to 1.8e308"
            raise self.error(f"number {shown} out of range", column, remedy)

    def _stray_character_error(self, token):
        """The error for a character that no formula has."""
        shown = ascii(token.text)
        if not token.text.isascii():
            name = unicodedata.name(token.text, "")
            shown = f"non-ASCII U+{ord(token.text):04X} {name}".strip()
        plain = "use names, numbers and + - * / ** ( ) , < <= > >= == != only"
        remedy = _REMEDIES.get(token.text, plain)
        return self.error(f"unexpected {shown}", token.column, remedy)

    def unknown_name_error(self, token):
        """The error for an unknown name, with the nearest known one.

        Parameters
        ----------
        token : Token

        Returns
        -------
        FormulaError
        """
        name = token.text
        remedy = _REMEDIES.get(name) or _product(name) or _nearest_name(name)
        remedy = f"{remedy} (known: {', '.join(KNOWN)})"
        return self.error(f"unknown name {shorten(name, 30)}", token.column, remedy)


def _product(name):
    """Remedy for a name such as xy, which is meant as a product; None for others."""
    return f"write {'*'.join(name[:20])}" if set(name) <= set("xyr") else None


def _nearest_name(name):
    """Remedy that names the nearest known name, if there is one."""
    for spelling in (name, name.lower()):
        near = difflib.get_close_matches(spelling, KNOWN, 1)
        if near:
            return f"did you mean {near[0]}?"
    return "mind the spelling"
