"""Text in PDF figures that can be selected, searched and read aloud.

Computer Modern, as Matplotlib has it, keeps its symbols at places of its own, and a PDF file of
Matplotlib says of every glyph the character whose place it is: for the minus sign an exclamation
mark upside down, for the decimal point a colon. Matplotlib's own tables say which symbol is where.
"""

import inspect
from contextlib import contextmanager
from functools import cache

_KNOWN = ["self", "font", "chars", "glyph"]  # arguments of the method that is replaced


@contextmanager
def readable_text():
    """Let PDF files that are written in the block say the right character of every glyph.

    Where Matplotlib keeps its glyphs in another way than the version that this is written for,
    nothing changes.
    """
    from matplotlib.backends._backend_pdf_ps import CharacterTracker

    original = getattr(CharacterTracker, "track_glyph", None)
    if original is None or list(inspect.signature(original).parameters) != _KNOWN:
        yield
        return

    def track_glyph(self, font, chars, glyph):
        return original(self, font, _meant(font.family_name, chars), glyph)

    CharacterTracker.track_glyph = track_glyph
    try:
        yield
    finally:
        CharacterTracker.track_glyph = original


def _meant(family, chars):
    """The character that a glyph of a font shows, where its place is that of another."""
    code = ord(chars[0]) if isinstance(chars, str) else chars
    return symbols().get((family, code), chars)


@cache
def symbols():
    r"""Font and place of every symbol of Computer Modern -> its character.

    Returns
    -------
    dict of (str, int) to str

    Examples
    --------
    >>> symbols()["cmmi10", ord(":")], symbols()["cmsy10", 0xA1] == "\N{MINUS SIGN}"
    ('.', True)
    """
    from matplotlib._mathtext_data import latex_to_bakoma, tex2uni

    found = {}
    for name, place in latex_to_bakoma.items():
        bare = name.removeprefix("\\")
        if bare in tex2uni:
            found.setdefault(place, chr(tex2uni[bare]))
        elif len(bare) == 1:
            found[place] = bare  # itself: the decimal point, and the minus sign
    return found
