"""The elements P1 and CR: everything in which they differ is a method or an attribute of theirs.

Functions take an element by name or as an object; `find_element` accepts both.
"""

import difflib

from signorini.exceptions import SceneError
from signorini.fem.elements.cr import CR
from signorini.fem.elements.element import Element
from signorini.fem.elements.p1 import P1

ELEMENTS = {element.name: element for element in (P1, CR)}


def find_element(element):
    """Look an element up by name.

    Parameters
    ----------
    element : {"P1", "CR"} or Element
        An element is returned as it is.

    Returns
    -------
    Element

    Raises
    ------
    SceneError
        If there is none of that name.

    Examples
    --------
    >>> find_element("CR").title
    'Crouzeix-Raviart'
    """
    if isinstance(element, Element):
        return element
    if not isinstance(element, str) or element not in ELEMENTS:
        near = difflib.get_close_matches(str(element).upper(), ELEMENTS, n=1, cutoff=0.3)
        hint = f"; did you mean {near[0]}?" if near else ""
        known = ", ".join(ELEMENTS)
        raise SceneError(f"element: unknown element {element!r}; known: {known}{hint}")
    return ELEMENTS[element]
