"""Read a formula into a postfix program.

The text never reaches Python's own parser or compiler. An operator-precedence reader accepts the
language and nothing else; it does not recurse, so deeply nested text exhausts no stack.
"""

import math
import operator
from typing import NamedTuple

from signorini.formula.lexicon import CONSTANTS, FUNCTIONS, KNOWN, VARIABLES, Source, Token, shorten

MAX_LEVELS = 50

COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
LOGIC = ("and", "or", "not")
# How strongly an operator binds, as in Python.
BINARY = {
    "or": 1,
    "and": 2,
    **dict.fromkeys(COMPARISONS, 4),
    "+": 5,
    "-": 5,
    "*": 6,
    "/": 6,
    "**": 8,
}
PREFIX = {"not": ("not", 3), "-": ("negative", 7), "+": ("positive", 7)}

FOLD = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "**": operator.pow,
    "negative": operator.neg,
    "positive": operator.pos,
}


class Step(NamedTuple):
    """One step of a program: takes `arity` values off the stack and puts one back."""

    name: str
    arity: int = 0
    value: float | tuple[str, ...] | None = None  # of a "number"; the signs of a "compare"


MEANING = {
    "x": (Step("x"),),
    "y": (Step("y"),),
    "r": (Step("x"), Step("y"), Step("hypot", 2)),
    "theta": (Step("y"), Step("x"), Step("atan2", 2)),
}


class Pending(NamedTuple):
    """An operator, or an open parenthesis (which binds 0), whose last operand is still to come."""

    name: str
    token: Token
    binds: int
    arity: int
    signs: tuple[str, ...] | None = None


class Operand(NamedTuple):
    """What a value on the stack is: a condition or a number, and which one if plain arithmetic
    tells.
    """

    condition: bool = False
    constant: float | None = None


def read(text, field):
    """Steps of the program for a formula's text; FormulaError if it has no meaning."""
    return Reader(Source(text, field)).program()


class Reader:
    """One pass over the tokens: values and finished operators go to `steps`, unfinished ones wait."""

    def __init__(self, source):
        self.source, self.error = source, source.error
        self.steps, self.operands, self.waiting = [], [], []

    def program(self):
        """Read all tokens."""
        before, expects_value = "", True
        for token in self.source.tokens():
            expects_value = self.value(token) if expects_value else self.after_value(token, before)
            before = token.text
        if self.operands[0].condition:
            raise self.error("condition instead of a number", 1, "write where(condition, 1, 0)")
        return tuple(self.steps)

    def value(self, token):
        """Take a token where a value may start; True while one is still expected."""
        kind, text, column = token
        if kind == "number" or (kind == "name" and text in CONSTANTS):
            number = CONSTANTS[text] if kind == "name" else float(text)
            self.steps.append(Step("number", 0, number))
            self.operands.append(Operand(constant=number))
            return False
        if kind == "name" and text in VARIABLES:
            self.steps += MEANING[text]
            self.operands.append(Operand())
            return False
        if text == "(" or (kind == "call" and text in FUNCTIONS):
            self.open(token)
            return True
        if text in PREFIX:
            name, binds = PREFIX[text]
            self.waiting.append(Pending(name, token, binds, 1))
            return True
        if kind not in ("name", "call"):
            raise self.error(
                f"{text} where a value is expected", column, "write a number, a name or ("
            )
        if text not in KNOWN:
            raise self.source.unknown(token)
        if kind == "call":
            raise self.error(f"{text} is no function", column, f"write {text}*(...)")
        raise self.error(f"function {text} without parentheses", column, f"write {text}(...)")

    def open(self, token):
        """Open a parenthesis, of a group or of a call."""
        if sum(pending.binds == 0 for pending in self.waiting) == MAX_LEVELS:
            raise self.error(
                f"more than {MAX_LEVELS} nested levels", token.column, "simplify the formula"
            )
        self.waiting.append(Pending(token.text, token, 0, 1))

    def after_value(self, token, before):
        """Take a token that follows a value; True when another value must follow."""
        kind, text, column = token
        if text in BINARY:
            self.binary(token)
        elif text == ",":
            call = self.close(token)
            self.waiting.append(call._replace(arity=call.arity + 1))
        elif text == ")":
            self.call(self.close(token))
            return False
        elif kind == "end":
            self.settle(1)
            if self.waiting:
                raise self.error("parenthesis never closed", self.waiting[-1].token.column, "add )")
        elif kind in ("name", "call") and text not in KNOWN:
            raise self.source.unknown(token)
        else:
            remedy = f"write {before[-20:]}*{text[:20]} for a product"
            raise self.error(f"missing operator before {shorten(text, 30)}", column, remedy)
        return True

    def settle(self, binds):
        """Emit the waiting operators that bind at least this strongly."""
        while self.waiting and self.waiting[-1].binds >= binds:
            self.emit(self.waiting.pop())

    def binary(self, token):
        """Let a binary operator wait; ** groups to the right and comparisons join in a chain."""
        name, binds = token.text, BINARY[token.text]
        if name not in COMPARISONS:
            self.settle(binds + (name == "**"))
            self.waiting.append(Pending(name, token, binds, 2))
            return
        self.settle(binds + 1)
        chained = self.waiting and self.waiting[-1].name == "compare"
        signs = (*self.waiting.pop().signs, name) if chained else (name,)
        self.waiting.append(Pending("compare", token, binds, len(signs) + 1, signs))

    def close(self, token):
        """Finish what waits inside the innermost parenthesis, and take that off the list."""
        self.settle(1)
        if token.text == "," and (not self.waiting or self.waiting[-1].name == "("):
            raise self.error("comma outside a function", token.column, "write 0.5 with a point")
        if not self.waiting:
            raise self.error("unmatched )", token.column, "remove it or add (")
        return self.waiting.pop()

    def call(self, pending):
        """Emit the call of a function whose arguments are complete; a mere group leaves no step."""
        if pending.name == "(":
            return
        least, most = FUNCTIONS[pending.name]
        if not least <= pending.arity <= most:
            takes = f"{least} or more" if most > least else least
            problem = f"function {pending.name} with {pending.arity} argument(s)"
            raise self.error(problem, pending.token.column, f"it takes {takes}")
        self.emit(pending)

    def emit(self, pending):
        """Append one step, having checked that its operands are of the right kind."""
        name, token, _, arity, signs = pending
        operands = self.operands[-arity:]
        for place, operand in enumerate(operands):
            wanted = name in LOGIC or (name == "where" and place == 0)
            if wanted and not operand.condition:
                raise self.error(
                    f"{token.text} without a condition", token.column, "write one, as x > 0"
                )
            if operand.condition and not wanted:
                remedy = "write where(condition, 1, 0) for a number"
                raise self.error(
                    f"condition in place of a number for {token.text}", token.column, remedy
                )
        constant = self.fold(name, token, [operand.constant for operand in operands])
        self.operands[-arity:] = [Operand(name in (*LOGIC, "compare"), constant)]
        self.steps.append(Step(name, arity, signs))

    def fold(self, name, token, values):
        """Result of plain arithmetic on constants, else None; a power among them must be real and
        finite.
        """
        if name not in FOLD or None in values:
            return None
        try:
            result = FOLD[name](*values)
        except (OverflowError, ZeroDivisionError):
            result = math.nan
        if name == "**" and (isinstance(result, complex) or not math.isfinite(result)):
            raise self.error(
                "constant power that is not real and finite", token.column, "change its exponent"
            )
        return result
