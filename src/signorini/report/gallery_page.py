"""The gallery of scenes: one HTML page that asks the network for nothing."""

import base64
import os
from pathlib import PurePath
from urllib.parse import quote

from signorini.errors.norms import NORMS
from signorini.fem.element_facts import ELEMENT_FACTS
from signorini.report.document import environment
from signorini.report.slopes import slopes_of

_TEMPLATE = "report/gallery.html.j2"
# What a card links to -> where it is in the folder of a scene.
PLACES = {
    "viewer": ("viewer.html",),
    "tables": ("*.md", "*.csv"),
    "figures": ("*.png", "figures/*.png", "details/*.png"),
    "paper": ("paper.pdf",),
}
ALWAYS = ("viewer", "tables", "figures")  # named as not built where there is none


def card_of(scene, folder, home, rates=(), picture=None):
    """What the gallery tells of a scene.

    Parameters
    ----------
    scene : Scene
    folder : Path
        Where it was built; it need not exist.
    home : Path
        Where the page will be; links are relative to it.
    rates : sequence of mapping, optional
        Rows of rates.csv.
    picture : bytes, optional
        PNG.

    Returns
    -------
    dict
        ``name``, ``title``, ``elements``, ``levels``, ``slopes`` (norm -> label and slope of each
        element), ``links`` (heading -> pairs of text and address), ``missing`` (headings) and
        ``picture``, base64 or None.
    """
    links = {heading: _links(folder, home, patterns) for heading, patterns in PLACES.items()}
    return {
        "name": scene.name,
        "title": scene.document["title"] or scene.name,
        "elements": [ELEMENT_FACTS[element].label for element in scene.elements],
        "levels": scene.levels,
        "slopes": _slopes(scene, rates),
        "links": {heading: found for heading, found in links.items() if found},
        "missing": [heading for heading in ALWAYS if not links[heading]],
        "picture": base64.b64encode(picture).decode() if picture else None,
    }


def _links(folder, home, patterns):
    """Text and address of each file that is there."""
    files = [file for pattern in patterns for file in sorted(folder.glob(pattern))]
    return [(_text(file), _address(file, home)) for file in files]


def _text(file):
    """A figure goes by what it shows, a table by its file."""
    if file.suffix != ".png":
        return file.name
    return NORMS[file.stem].text if file.stem in NORMS else file.stem.replace("_", " ")


def _address(file, home):
    return quote(PurePath(os.path.relpath(file, home)).as_posix())


def _slopes(scene, rates):
    """Norm -> its label, and the slopes of the elements that have one."""
    found = {}
    for norm in scene.document["norms"]:
        slopes = slopes_of(rates, norm, scene.document["slope"])
        if slopes:
            shown = {element: f"{float(slope):.2f}" for element, slope in slopes.items()}
            found[NORMS[norm].text] = [shown.get(element, "–") for element in scene.elements]
    return found


def gallery_page(cards):
    """Render the gallery.

    Parameters
    ----------
    cards : sequence of dict
        What `card_of` returns, in the order in which they are shown.

    Returns
    -------
    str
        HTML with its style and its pictures.
    """
    return environment().get_template(_TEMPLATE).render(cards=cards)
