"""The viewer of a scene: one HTML page that asks the network for nothing."""

import json

from signorini.exceptions import SignoriniError
from signorini.report.document import environment

_TEMPLATE = "report/viewer.html.j2"


def viewer_page(data):
    """Render the viewer of a scene.

    Parameters
    ----------
    data : dict
        What `signorini.report.viewer.viewer_data` returns.

    Returns
    -------
    str
        HTML with its style, its scripts and all that it shows.

    Raises
    ------
    SignoriniError
        If plotly is not installed, whose script the page holds.
    """
    content = json.dumps(data, separators=(",", ":"), allow_nan=False)
    # A text must not end the element that holds it.
    content = content.replace("<", "\\u003c")
    return (
        environment()
        .get_template(_TEMPLATE)
        .render(title=data["title"], name=data["name"], plotly=plotly_script(), content=content)
    )


def plotly_script():
    """The script of Plotly that draws in a browser, a text of 4.8 MB.

    Raises
    ------
    SignoriniError
        If Plotly is not installed.
    """
    try:
        from plotly.offline import get_plotlyjs
    except ImportError:
        raise SignoriniError(
            "the viewer needs plotly, which is not installed: pip install 'signorini[viewer]'"
        ) from None
    return get_plotlyjs()
