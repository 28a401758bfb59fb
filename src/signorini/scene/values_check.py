"""The values of a scene's data, looked at where its coarsest level would use them."""

from signorini.exceptions import MeshError
from signorini.fem.problem import discretize
from signorini.mesh.rectangle import Rectangle
from signorini.scene.scene import naming

_MANY = 2**15  # triangles, beyond which a coarser grid is looked at


def check_values(scene):
    """Discretise the coarsest level, so that data without a finite value there are refused.

    Parameters
    ----------
    scene : Scene

    Raises
    ------
    FormulaError, SceneError, MeshError
        Naming the file, the datum, its value, the point and the remedy.

    Examples
    --------
    >>> from signorini import load_scene
    >>> check_values(load_scene("config/scenes/paper.yaml"))
    """
    with naming(scene.source):
        statement = scene.problem_statement
        statement.check()
        n = _coarse_level(statement.triangulations, scene.levels[0])
        for element in scene.elements:
            discretize(statement, element, n)


def _coarse_level(domain, n):
    """The coarsest level; of grids with many triangles, one with fewer."""
    if not (isinstance(domain, Rectangle) and domain.uniform):
        return n
    try:
        while domain.count_triangles(n) > _MANY and domain.count_triangles(n // 2):
            n //= 2
    except MeshError:  # half as many cells would not be whole ones
        pass
    return n
