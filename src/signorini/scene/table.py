"""The section ``table`` of a scene: it shows what the scene has."""

from signorini.errors.norms import RATED
from signorini.exceptions import SceneError
from signorini.wording import listed, nearest, shown


def check_table(document):
    """Refuse a table of what is not computed.

    Parameters
    ----------
    document : dict
        Valid but for this, defaults filled in.

    Raises
    ------
    SceneError
        Naming the field, its value and the remedy.
    """
    section = document["table"]
    known = {
        "norms": computed_norms(document),
        "elements": document["elements"],
        "levels": document["levels"],
    }
    for key, names in known.items():
        for name in section.get(key, []):
            if name not in names:
                raise SceneError(
                    f"table.{key}: {name} is not among {key} of the scene; add it there, or drop "
                    f"it; {nearest(name, map(str, names))}"
                )
    if "columns" in section and not {"n", "h"} & set(section["columns"]):
        raise SceneError(
            f"table.columns: {shown(section['columns'])} names no level; add n or h to "
            f"{listed(section['columns'])}"
        )


def computed_norms(document):
    """The norms in the tables: those asked for, and the two that the full norm is made of.

    Examples
    --------
    >>> computed_norms({"norms": ["h1", "energy"]})
    ['l2', 'h1_semi', 'h1', 'energy']
    """
    asked = document["norms"]
    parts = {"l2", "h1_semi"} if "h1" in asked else set()
    return [norm for norm in RATED if norm in asked or norm in parts]
