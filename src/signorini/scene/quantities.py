"""The section ``quantities`` of a scene: what each of its kinds takes, and needs."""

import math

from signorini.exceptions import SceneError
from signorini.mesh.boundary import labels_of
from signorini.wording import shown

# Kind -> the keys that it takes besides factor and unit, with their defaults.
OPTIONS = {
    "contact_length": {},
    "free_length": {},
    "critical_point": {"which": 1, "coordinate": "s"},
    "flux": {"through": "contact"},
    "excess": {},
}
_ALWAYS = ("kind", "factor", "unit")


def check_quantities(document):
    """Check a schema-valid section beyond the schema.

    Parameters
    ----------
    document : dict

    Raises
    ------
    SceneError
        Naming the field, its value and the remedy.
    """
    labels = labels_of(document["boundary"])
    for name, asked in document["quantities"].items():
        _check_keys(f"quantities.{name}", asked)
        label = asked.get("through", "contact")
        if label not in labels:
            raise SceneError(
                f"quantities.{name}: no part of the boundary is {label}; "
                f"label one {label}, or drop {name}"
            )
        if not abs(asked.get("factor", 1.0)) < math.inf:
            raise SceneError(
                f"quantities.{name}.factor: {shown(asked['factor'])} is not valid; "
                "it must be finite"
            )


def _check_keys(field, asked):
    kind = asked["kind"]
    for key in asked:
        if key not in (*_ALWAYS, *OPTIONS[kind]):
            owner = next(other for other, keys in OPTIONS.items() if key in keys)
            raise SceneError(
                f"{field}.{key}: only for kind {owner}, here kind is {kind}; drop one of the two"
            )
