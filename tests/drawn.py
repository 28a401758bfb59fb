"""Numbers to draw, figures drawn from them, and how they look."""

from types import SimpleNamespace

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from printed_table import PRINTED
from signorini.fem.contact_line import contact_rows
from signorini.fem.elements import find_element
from signorini.figures.contact_line import draw_contact_line
from signorini.figures.convergence import draw_convergence
from signorini.figures.field import draw_field
from signorini.figures.gallery import draw_gallery
from signorini.figures.style import STYLE
from signorini.figures.surface import draw_surface
from signorini.mesh.grid import Grid
from signorini.report.field import field_of


def published_errors():
    return [
        {
            "element": element,
            "n": row["n"],
            "h": 1 / int(row["n"]),
            "l2": row[f"l2_{tag}"],
            "h1": row[f"h1_{tag}"],
            "h1_semi": row[f"h1_{tag}"],
        }
        for element, tag in (("P1", "cf"), ("CR", "ncf"))
        for row in PRINTED
    ]


def sloping_surface(critical_points=((0.7, 0.0),)):
    x = np.linspace(0, 1, 9)
    contact_x = np.linspace(0, 1, 65)
    return {
        "x": x,
        "y": x,
        "u": np.maximum(0.7 - x, 0) * (1 - x[:, None]),
        "contact_x": contact_x,
        "contact_u": np.maximum(0.7 - contact_x, 0),
        "critical_points": np.reshape(critical_points, (-1, 2)),
    }


# The sides of Section 5: bottom, right, top, left.
PAPER = ("contact", "neumann", "dirichlet", "neumann")


def sloping(
    element="P1", n=8, size=(1.0, 1.0), origin=(0.0, 0.0), height=1.0, labels=PAPER, turn=0.7
):
    """A grid, and a solution on it: max(turn - x, 0) (1 - y) of the unit square's x and y.

    It binds from `turn` on.
    """
    mesh, kind = Grid(n, n, origin, size, "falling", labels), find_element(element)
    x, y = ((kind.nodes(mesh, np.arange(kind.size(mesh))).T - origin) / size).T
    contact = np.setdiff1d(
        kind.boundary_dofs(mesh, "contact"), kind.boundary_dofs(mesh, "dirichlet")
    )
    found = {
        "element": element,
        "n": n,
        "u": height * np.maximum(turn - x, 0) * (1 - y),
        "contact": contact,
    }
    state = {
        "active": x[contact] >= turn,
        "force": np.maximum(x[contact] - turn, 0) * height / n,
        "threshold": None,
    }
    return mesh, SimpleNamespace(**found, **state, lower=np.zeros(contact.size), h=1 / n)


def sloping_field(*arguments, **options):
    return field_of(*sloping(*arguments, **options))


def sloping_rows(**options):
    return [row for element in ("P1", "CR") for row in contact_rows(*sloping(element, **options))]


FIGURES = {
    "surface": lambda: draw_surface(sloping_surface()),
    "convergence": lambda: draw_convergence(
        published_errors(), "l2", {"P1": 1.8955, "CR": "2.0979"}
    ),
    "field": lambda: draw_field(sloping_field("CR"), "a title"),
    "contact line": lambda: draw_contact_line(sloping_rows()),
    "gallery": lambda: draw_gallery(
        [("P1", "conforming", sloping_field()), ("CR", "not", sloping_field("CR"))]
    ),
}


def legend(figure):
    box = [*figure.legends, *(axes.get_legend() for axes in figure.axes)]
    return [text.get_text() for legend in box if legend for text in legend.get_texts()]


def line(figure, label):
    return next(line for line in figure.axes[0].lines if line.get_label() == label)


def pixels(figure):
    """The figure as it looks on the screen, shape (rows, columns, 3)."""
    canvas = FigureCanvasAgg(figure)
    with matplotlib.rc_context(STYLE):
        canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3]


def inside(figure):
    """The pixels of the first axes, without a rim."""
    image, box = pixels(figure), figure.axes[0].get_window_extent()
    rows = slice(len(image) - int(box.y1) + 8, len(image) - int(box.y0) - 8)
    return image[rows, int(box.x0) + 8 : int(box.x1) - 8]


def lightness(rgb):
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return 116 * np.cbrt(linear @ [0.2126, 0.7152, 0.0722]) - 16  # CIE L*
