"""Which part of a scene the sensitivity study looks at."""

_QUICK_LEVEL, _QUICK_REFERENCE = 16, 4


def add_quick(parser):
    """Add the option ``--quick``."""
    parser.add_argument("--quick", action="store_true", help="coarse levels alone")


def levels_of(scene, quick):
    """The levels of the scene's table, or the coarse ones of them."""
    return [n for n in scene.levels if n <= _QUICK_LEVEL or not quick]


def reference_of(scene, quick):
    """The level of the reference."""
    return scene.truth["n"] // (_QUICK_REFERENCE if quick else 1)
