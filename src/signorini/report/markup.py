r"""A line of a page, in the light markup of pages, as LaTeX and as Markdown.

Mathematics ``$...$``, code, and references ``@name`` to figures and tables are taken as they are;
the words between them are translated.
"""

import re

from signorini.report.table_writer import ESCAPES

_SYMBOLS = {"≤": r"$\le$", "×": r"$\times$", "<": "$<$", ">": "$>$", r" \%": r"\,\%"}
_STOP = re.compile(r"[.:;]\s")
_VERBATIM = re.compile(r"(\$\$[^$]*\$\$|\$[^$]*\$|`[^`]*`|(?<!\w)@[a-z][\w-]*)")


def latex_text(text, known=None):
    """Return a text in the markup of pages as LaTeX.

    Parameters
    ----------
    text : str
    known : dict, optional
        Name of a figure or table that the text may refer to -> its `Block`.

    Returns
    -------
    str

    Raises
    ------
    KeyError
        If the text refers to a name that is not known.

    Examples
    --------
    >>> print(latex_text("1e-9 of *all*, `a_b`"))
    $10^{-9}$ of \\emph{all}, \\texttt{a\\_b}
    """
    parts = _VERBATIM.split(text)
    parts[::2] = map(_latex_words, parts[::2])
    for k, part in enumerate(parts[1::2]):
        if part.startswith("`"):
            parts[2 * k + 1] = rf"\texttt{{{part[1:-1].translate(str.maketrans(ESCAPES))}}}"
        elif part.startswith("$$"):
            parts[2 * k + 1] = rf"\[{part[2:-2]}\]"
        elif part.startswith("@"):
            parts[2 * k + 1] = rf"\autoref{{{known[part[1:]].kind}:{part[1:]}}}"
    return "".join(parts)


def _latex_words(text):
    """Without mathematics: minus signs, powers of ten, and thin spaces before the percent sign."""
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    text = text.translate(str.maketrans(ESCAPES))
    for sign, symbol in _SYMBOLS.items():
        text = text.replace(sign, symbol)
    text = re.sub(r"\*([^*]+)\*", r"\\emph{\1}", text)
    text = re.sub(r"\b(\d[\d.]*)e([+-])0*(\d+)", _power_of_ten, text)
    return re.sub(r"(?<![\w{}])-(?=\d)", "$-$", text)


def _power_of_ten(match):
    mantissa, sign, exponent = match.groups()
    times = "" if mantissa == "1" else rf"{mantissa}\times"
    return rf"${times}10^{{{sign.strip('+')}{exponent}}}$"


def markdown_text(text, known=None):
    """Return a text in the markup of pages as Markdown, where only references are changed.

    Parameters
    ----------
    text, known
        As for `latex_text`.

    Returns
    -------
    str

    Raises
    ------
    KeyError
        If the text refers to a name that is not known.

    Examples
    --------
    >>> from signorini.report.document import Block
    >>> markdown_text("see @error", {"error": Block("figure", "The caption.", "error", number=1)})
    'see Figure 1'
    """
    parts = _VERBATIM.split(text)
    for k, part in enumerate(parts):
        if k % 2 and part.startswith("@"):
            block = known[part[1:]]
            parts[k] = f"{block.kind.capitalize()} {block.number}"
    return "".join(parts)


def alternative(caption):
    """Return what stands for a picture where it cannot be seen: its caption up to the first stop.

    Parameters
    ----------
    caption : str
        Markdown.

    Returns
    -------
    str
        Without marks.

    Examples
    --------
    >>> alternative("The $L^2$ error, by *route*, see [data](a.csv). Below 1, NCF is better.")
    'The L^2 error, by route, see data'
    """
    words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", _STOP.split(caption)[0])
    return re.sub(r"[$*`\\\[\]]", "", words).rstrip(".")
