"""Options that the commands of the benchmark share."""

from pathlib import Path

from signorini.commands.inputs import scene_of
from signorini.studies.benchmark.settings import read_settings


def add_settings(parser):
    """Add the options ``--settings`` and ``--quick``."""
    parser.add_argument(
        "--settings",
        metavar="FILE",
        default="config/benchmark.yaml",
        help="what is measured; default: %(default)s",
    )
    parser.add_argument("--quick", action="store_true", help="use the part `quick` of the settings")


def add_scenes(parser):
    """Add the option ``--scenes``."""
    parser.add_argument(
        "--scenes", nargs="+", type=Path, required=True, metavar="SCENE", help="all scenes measured"
    )


def settings_of(arguments):
    """The settings that the options name, a dict."""
    return read_settings(arguments.settings, arguments.quick)


def scenes_of(arguments):
    """The scenes that the option ``--scenes`` names, a list."""
    return [scene_of(path) for path in arguments.scenes]
