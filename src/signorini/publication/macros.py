r"""The macro ``\result`` with the numbers that a manuscript asks for."""

from signorini.exceptions import SceneError
from signorini.publication.keys import PUBLISHED, nearest_key
from signorini.publication.notation import Form, in_latex, read_form

# The key, without spaces, is looked up among the numbers below; it is expandable, so that \result
# may stand in a caption, a heading or an \ifdim.
_HEAD = r"""% Written by `signorini macros`; \result{key} and \result[digits=3]{key} print a number.
\makeatletter
\newcommand*{\signorini@name}[1]{%
  signorini/\expandafter\zap@space\detokenize\expandafter{\expanded{#1}} \@empty}
\NewExpandableDocumentCommand{\result}{O{}m}{%
  \ifcsname\signorini@name{#1|#2}\endcsname
    \csname\signorini@name{#1|#2}\expandafter\endcsname
  \else
    \signorini@unknown{#1}{#2}%
  \fi}
\newcommand*{\signorini@unknown}[2]{\PackageError{signorini}{%
    \string\result[#1]{#2}: no such number here}{%
    `signorini macros SCENE' lists all keys. Options must stand in the manuscript
    as they are, also where a macro puts the key together.}}
\newcommand*{\signorini@set}[2]{\expandafter\def\csname signorini/\detokenize{#1}\endcsname{#2}}
"""
_FOOT = "\\makeatother\n"


def macros(uses, numbers):
    r"""``\result`` and every number that is asked for.

    Parameters
    ----------
    uses : sequence of Use
        Of a manuscript.
    numbers : dict
        Key -> text, as `read_numbers` returns it.

    Returns
    -------
    str
        LaTeX, to be taken in by the preamble.

    Raises
    ------
    SceneError
        Naming the line of a manuscript that asks for a number that is not there.
    """
    found = {}
    for use in uses:
        found |= _asked(use, numbers)
    lines = [rf"\signorini@set{{{name}}}{{{value}}}" for name, value in sorted(found.items())]
    return _HEAD + "".join(f"{line}\n" for line in lines) + _FOOT


def all_macros(numbers):
    r"""``\result`` and all numbers, in the form that it has without options.

    Parameters
    ----------
    numbers : dict
        As for `macros`.

    Returns
    -------
    str

    Examples
    --------
    >>> all_macros({"l2, CR, 64": "0.5"}).count("set{")
    1
    """
    lines = [rf"\signorini@set{{{_name('', key)}}}{{{value}}}" for key, value in shown(numbers)]
    return _HEAD + "".join(f"{line}\n" for line in lines) + _FOOT


def shown(numbers):
    """Pairs of a key and its number in LaTeX, as it is without options.

    Examples
    --------
    >>> shown({"l2, CR, 64": "0.00012"})
    [('l2, CR, 64', '0.000120')]
    """
    return [(key, printed(key, text, Form())) for key, text in numbers.items()]


def printed(key, text, form):
    """A number in LaTeX; a published one as it was printed, where nothing is said of its form.

    Parameters
    ----------
    key, text : str
        Of the number, and its value.
    form : Form

    Returns
    -------
    str

    Examples
    --------
    >>> from signorini.publication.notation import Form
    >>> printed("l2, CR, 64", "0.00012", Form())
    '0.000120'
    """
    is_published = key.startswith(f"{PUBLISHED}, ")
    return text if is_published and form == Form() else in_latex(text, form)


def _asked(use, numbers):
    """Name -> number in LaTeX, of one use; of an open key all that it can be."""
    form = read_form(use.options)
    if use.is_open:
        keys = [key for key in numbers if key.startswith(use.stem)]
    elif use.key in numbers:
        keys = [use.key]
    else:
        raise SceneError(
            f"{use.place}: \\result{{{use.key}}}: there is no such number, or it has no value; "
            f"{nearest_key(use.key, numbers)}"
        )
    return {_name(use.options, key): printed(key, numbers[key], form) for key in keys}


def _name(options, key):
    return "".join(f"{options}|{key}".split())
