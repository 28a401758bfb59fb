"""Parse a formula into a postfix program.

The text never reaches Python's own parser or compiler. An operator-precedence (shunting-yard)
parser accepts the language and nothing else. It does not recurse, so deeply nested text cannot
exhaust the stack.
"""

import math
import operator
from typing import NamedTuple

from signorini.formula.lexicon import CONSTANTS, FUNCTIONS, KNOWN, VARIABLES, Source, Token, shorten

_MAX_LEVELS = 50

_COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
_LOGIC = ("and", "or", "not")
# Precedence of operators: the order is Python's. An open parenthesis has none, 0.
_BINARY = {
    "or": 1,
    "and": 2,
    **dict.fromkeys(_COMPARISONS, 4),
    "+": 5,
    "-": 5,
    "*": 6,
    "/": 6,
    "**": 8,
}
_PREFIX = {"not": ("not", 3), "-": ("negative", 7), "+": ("positive", 7)}

_ARITHMETIC = {
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


_VARIABLE_STEPS = {
    "x": (Step("x"),),
    "y": (Step("y"),),
    "r": (Step("x"), Step("y"), Step("hypot", 2)),
    "theta": (Step("y"), Step("x"), Step("atan2", 2)),
}


class _Operator(NamedTuple):
    """An operator, or an open parenthesis, whose last operand is still to come."""

    name: str
    token: Token
    precedence: int
    arity: int
    signs: tuple[str, ...] | None = None


class _Operand(NamedTuple):
    """What is known of a value on the stack."""

    condition: bool = False
    constant: float | None = None  # where plain arithmetic on numbers tells


def read(text, field):
    """Parse the text of a formula.

    Parameters
    ----------
    text : str
    field : str
        Name of the quantity, for error messages.

    Returns
    -------
    tuple of Step
        The program, in postfix order.

    Raises
    ------
    FormulaError
        If the text is not a formula.

    Examples
    --------
    >>> [step.name for step in read("2*x + y", "data.f")]
    ['number', 'x', '*', 'y', '+']
    """
    return _Parser(Source(text, field)).program()


class _Parser:
    """One pass over the tokens.

    Values and operators with all their operands go to `steps`. An operator whose last operand is
    still to come waits on the stack `operators`. `operands` says what is on the program's own stack
    of values after the steps so far.
    """

    def __init__(self, source):
        self.source = source
        self.error = source.error
        self.steps = []
        self.operands = []
        self.operators = []

    def program(self):
        """Parse all tokens."""
        before = ""
        expects_value = True
        for token in self.source.tokens():
            if expects_value:
                expects_value = self.take_value(token)
            else:
                expects_value = self.take_after_value(token, before)
            before = token.text
        if self.operands[0].condition:
            raise self.error("condition instead of a number", 1, "write where(condition, 1, 0)")
        return tuple(self.steps)

    def take_value(self, token):
        """Take a token where a value may start; True while one is still expected."""
        kind, text, _ = token
        if kind == "number" or (kind == "name" and text in CONSTANTS):
            self.push_number(CONSTANTS[text] if kind == "name" else float(text))
            return False
        if kind == "name" and text in VARIABLES:
            self.steps += _VARIABLE_STEPS[text]
            self.operands.append(_Operand())
            return False
        if text == "(" or (kind == "call" and text in FUNCTIONS):
            self.open_parenthesis(token)
        elif text in _PREFIX:
            name, precedence = _PREFIX[text]
            self.operators.append(_Operator(name, token, precedence, 1))
        else:
            raise self.no_value_error(token)
        return True

    def push_number(self, number):
        self.steps.append(Step("number", 0, number))
        self.operands.append(_Operand(constant=number))

    def open_parenthesis(self, token):
        """Open a parenthesis, of a group or of a call."""
        levels = sum(entry.precedence == 0 for entry in self.operators)
        if levels == _MAX_LEVELS:
            problem = f"more than {_MAX_LEVELS} nested levels"
            raise self.error(problem, token.column, "simplify the formula")
        self.operators.append(_Operator(token.text, token, 0, 1))

    def no_value_error(self, token):
        """The error for a token that cannot start a value."""
        kind, text, column = token
        if kind not in ("name", "call"):
            problem = f"{text} where a value is expected"
            return self.error(problem, column, "write a number, a name or (")
        if text not in KNOWN:
            return self.source.unknown_name_error(token)
        if kind == "call":
            return self.error(f"{text} is no function", column, f"write {text}*(...)")
        return self.error(f"function {text} without parentheses", column, f"write {text}(...)")

    def take_after_value(self, token, before):
        """Take a token that follows a value; True when another value must follow."""
        if token.text in _BINARY:
            self.push_binary(token)
        elif token.text == ",":
            call = self.close_parenthesis(token)
            self.operators.append(call._replace(arity=call.arity + 1))
        elif token.text == ")":
            self.emit_call(self.close_parenthesis(token))
            return False
        elif token.kind == "end":
            self.emit_operators(1)
            if self.operators:
                column = self.operators[-1].token.column
                raise self.error("parenthesis never closed", column, "add )")
        else:
            raise self.no_operator_error(token, before)
        return True

    def no_operator_error(self, token, before):
        """The error for a second value right after a first one."""
        kind, text, column = token
        if kind in ("name", "call") and text not in KNOWN:
            return self.source.unknown_name_error(token)
        remedy = f"write {before[-20:]}*{text[:20]} for a product"
        return self.error(f"missing operator before {shorten(text, 30)}", column, remedy)

    def emit_operators(self, precedence):
        """Emit the operators on top of the stack that have at least this precedence."""
        while self.operators and self.operators[-1].precedence >= precedence:
            self.emit(self.operators.pop())

    def push_binary(self, token):
        """Put a binary operator on the stack; ** groups to the right, comparisons form a chain."""
        name = token.text
        precedence = _BINARY[name]
        if name not in _COMPARISONS:
            groups_to_the_right = name == "**"
            self.emit_operators(precedence + groups_to_the_right)
            self.operators.append(_Operator(name, token, precedence, 2))
            return
        self.emit_operators(precedence + 1)
        signs = (name,)
        if self.operators and self.operators[-1].name == "compare":
            signs = (*self.operators.pop().signs, name)
        self.operators.append(_Operator("compare", token, precedence, len(signs) + 1, signs))

    def close_parenthesis(self, token):
        """Emit what is left inside the innermost parenthesis, and take that off the stack."""
        self.emit_operators(1)
        if token.text == "," and (not self.operators or self.operators[-1].name == "("):
            raise self.error("comma outside a function", token.column, "write 0.5 with a point")
        if not self.operators:
            raise self.error("unmatched )", token.column, "remove it or add (")
        return self.operators.pop()

    def emit_call(self, call):
        """Emit the call of a function whose arguments are complete; a mere group emits no step."""
        if call.name == "(":
            return
        least, most = FUNCTIONS[call.name]
        if not least <= call.arity <= most:
            takes = f"{least} or more" if most > least else least
            problem = f"function {call.name} with {call.arity} argument(s)"
            raise self.error(problem, call.token.column, f"it takes {takes}")
        self.emit(call)

    def emit(self, entry):
        """Append one step, having checked that its operands are of the right kind."""
        name, _, _, arity, signs = entry
        operands = self.operands[-arity:]
        for place, operand in enumerate(operands):
            self.check_operand(entry, place, operand)
        constant = self.fold(entry, [operand.constant for operand in operands])
        is_condition = name in (*_LOGIC, "compare")
        self.operands[-arity:] = [_Operand(is_condition, constant)]
        self.steps.append(Step(name, arity, signs))

    def check_operand(self, entry, place, operand):
        """Refuse a number where a condition is needed, and a condition anywhere else."""
        name, token = entry.name, entry.token
        needs_condition = name in _LOGIC or (name == "where" and place == 0)
        if needs_condition and not operand.condition:
            problem = f"{token.text} without a condition"
            raise self.error(problem, token.column, "write one, as x > 0")
        if operand.condition and not needs_condition:
            problem = f"condition in place of a number for {token.text}"
            raise self.error(problem, token.column, "write where(condition, 1, 0) for a number")

    def fold(self, entry, values):
        """Result of plain arithmetic on constants, else None; a power must be real and finite."""
        name, token = entry.name, entry.token
        if name not in _ARITHMETIC or None in values:
            return None
        try:
            result = _ARITHMETIC[name](*values)
        except (OverflowError, ZeroDivisionError):
            result = math.nan
        if name == "**" and (isinstance(result, complex) or not math.isfinite(result)):
            problem = "constant power that is not real and finite"
            raise self.error(problem, token.column, "change its exponent")
        return result
