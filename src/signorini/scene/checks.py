"""What a schema cannot say of a scene: how its fields must fit together."""

import math
import sys
from itertools import pairwise

from signorini.errors.norms import CONTACT
from signorini.exceptions import SceneError
from signorini.mesh.boundary import SIDES, labels_of
from signorini.mesh.cell_counts import count_cells
from signorini.scene.boundary_check import check_boundary
from signorini.scene.certified import check_certifiable, is_certified
from signorini.scene.quantities import check_quantities
from signorini.scene.shape_checks import check_shapes, refuse_shapes
from signorini.scene.table import check_table
from signorini.wording import shown

_NESTED = ("falling", "rising")


def check_document(document):
    """Check a schema-valid document whose defaults are filled in.

    Parameters
    ----------
    document : dict

    Raises
    ------
    SceneError, FormulaError
        Naming the field, its value and the remedy.

    Examples
    --------
    >>> from copy import deepcopy
    >>> from signorini import load_scene
    >>> document = deepcopy(load_scene("config/scenes/paper.yaml").document)
    >>> check_document(document | {"levels": [4, 2]})
    Traceback (most recent call last):
    signorini.exceptions.SceneError: levels: [4, 2] is not increasing; list each level ...
    """
    _DOMAIN_CHECKS[document["domain"]["kind"]](document["domain"])
    check_shapes(document["domain"], _part_names(document["domain"]))
    check_boundary(document["boundary"], _part_names(document["domain"]))
    if isinstance(document["data"]["coefficient"], dict) and document["domain"]["kind"] != "mesh":
        raise SceneError(
            "data.coefficient: only a mesh file has subdomains; "
            "give a number or a formula in x and y"
        )
    _check_contact(document)
    _check_levels(document["levels"])
    _check_truth(document)
    _check_cells(document)
    _check_outputs(document)
    check_quantities(document)
    _check_norms(document)
    check_table(document)


def check_critical_points(document, exact):
    """Refuse to measure distances from exact critical points that nobody has named.

    Parameters
    ----------
    document : dict
    exact : ExactSolution or None

    Raises
    ------
    SceneError
        Saying where they would be named.
    """
    if "critical_points" not in document["norms"] or exact.critical_points:
        return
    remedy = "drop critical_points from norms"
    family = document["truth"].get("family")
    if family:
        remedy = f"the family {family} has none; {remedy}"
    else:
        remedy = f"list them in truth.critical_points, [[x, y], ...], or {remedy}"
    raise SceneError(f"norms: critical_points needs the exact ones; {remedy}")


def _check_rectangle(domain):
    _check_finite("domain.origin", domain["origin"])
    _check_finite("domain.size", domain["size"])
    for side in domain["size"]:
        if side <= 0:
            raise SceneError(f"domain.size: {shown(side)} is not valid; it must be greater than 0")


def _check_polygon(domain):
    if "corners" not in domain:
        raise SceneError("domain.corners: missing; list the corners of the polygon, [[x, y], ...]")
    for k, corner in enumerate(domain["corners"]):
        _check_finite(f"domain.corners.{k}", corner)
    for k, hole in enumerate(domain["holes"]):
        for corner in hole:
            _check_finite(f"domain.holes.{k}", corner)
    if "sides" in domain and len(domain["sides"]) != len(domain["corners"]):
        raise SceneError(
            f"domain.sides: {len(domain['sides'])} names for {len(domain['corners'])} corners; "
            "name the side that starts at each corner"
        )


def _check_mesh_file(domain):
    if "file" not in domain:
        raise SceneError("domain.file: missing; name the mesh file, relative to the scene's folder")


_DOMAIN_CHECKS = {
    "rectangle": _check_rectangle,
    "polygon": _check_polygon,
    "mesh": _check_mesh_file,
}


def _check_finite(field, values):
    for value in values:
        # The second condition catches whole numbers beyond what a double can hold.
        if not abs(value) < math.inf or abs(value) > sys.float_info.max:
            raise SceneError(f"{field}: {shown(value)} is not valid; it must be finite")


def _part_names(domain):
    """Names of the boundary's parts, or None where only the mesh file knows them."""
    if domain["kind"] == "rectangle":
        return SIDES
    if domain["kind"] == "polygon":
        sides = domain.get("sides") or [f"side-{k}" for k in range(len(domain["corners"]))]
        return (*dict.fromkeys(sides), *(f"hole-{k}" for k in range(len(domain["holes"]))))
    return None


def _check_contact(document):
    """A threshold of the flux, or a bound from above, needs a part of the boundary to act on."""
    if "contact" in labels_of(document["boundary"]):
        return
    remedy = "label a part of the boundary contact, or drop"
    if "contact_flux" in document["data"]:
        value = shown(document["data"]["contact_flux"])
        raise SceneError(
            f"data.contact_flux: {value} acts on no part of the boundary; {remedy} contact_flux"
        )
    if document["constraint"] == "upper":
        raise SceneError(
            f"constraint: upper bounds u on no part of the boundary; {remedy} constraint"
        )


def _check_levels(levels):
    if any(b <= a for a, b in pairwise(levels)):
        raise SceneError(
            f"levels: {shown(levels)} is not increasing; list each level once, coarsest first"
        )


def _check_truth(document):
    truth, domain, levels = document["truth"], document["domain"], document["levels"]
    if truth["kind"] != "exact" and "f" not in document["data"]:
        raise SceneError("data.f: missing; give the volume force, a number or a formula in x and y")
    if truth["kind"] == "exact" and ("u" in truth) == ("family" in truth):
        raise SceneError("truth: an exact truth needs either u, a formula, or family, a name")
    if "family" in truth and "multiplier" in truth:
        raise SceneError(
            "truth.multiplier: a family has its own; drop it, or give u in place of family"
        )
    if truth["kind"] == "reference":
        _check_reference(levels, truth)
        refuse_shapes(domain)
        if domain["kind"] == "rectangle":
            _check_nesting(domain)
    if domain["kind"] != "rectangle":
        for n in levels:
            complaint = f"levels: {n} is no uniform refinement of the coarsest, {levels[0]}"
            _check_power(n, levels[0], complaint)


def _check_nesting(rectangle):
    """Refuse patterns whose levels do not nest in a reference."""
    if rectangle["diagonal"] not in _NESTED:
        raise SceneError(
            f"domain.diagonal: levels of {rectangle['diagonal']} diagonals do not nest in a "
            "reference; use falling or rising, or an exact truth"
        )
    for key in ("grade", "perturb"):
        if key in rectangle:
            raise SceneError(
                f"domain.{key}: the levels do not nest in a reference; "
                "drop it, or use an exact truth"
            )


def _check_reference(levels, truth):
    if "n" not in truth:
        raise SceneError("truth.n: missing; give the level of the reference, for instance 512")
    if truth["n"] < levels[-1]:
        raise SceneError(
            f"levels: {levels[-1]} is finer than the reference, truth.n = {truth['n']}; "
            "raise truth.n"
        )
    for n in levels:
        complaint = f"levels: {n} does not nest in the reference, truth.n = {truth['n']}"
        _check_power(truth["n"], n, complaint)


def _check_power(fine, coarse, complaint):
    """Refuse a level that is not a coarser one times a power of two."""
    ratio, rest = divmod(fine, coarse)
    is_power_of_two = ratio & (ratio - 1) == 0  # it has one bit
    if rest or not is_power_of_two:
        near = coarse * 2 ** max(0, round(math.log2(fine / coarse)))
        raise SceneError(
            f"{complaint}; the finer one must be {coarse} times a power of two, for instance {near}"
        )


def _check_cells(document):
    """Every level and the reference must cut the sides of a rectangle into whole cells."""
    domain, truth, levels = document["domain"], document["truth"], document["levels"]
    if domain["kind"] != "rectangle":
        return
    if truth["kind"] == "reference":
        levels = [*levels, truth["n"]]
    for n in levels:
        count_cells(domain["size"], domain["cells"], n)


def _check_outputs(document):
    kind, outputs = document["truth"]["kind"], document["outputs"]
    _check_certified(document)
    without = {"none": ("errors", "rates", "table"), "certificate": ("errors", "rates")}
    for output in without.get(kind, ()):
        if output in outputs:
            raise SceneError(
                f"outputs: {output} needs a truth to compare with; set truth.kind, or drop {output}"
            )
    for output in ("rates", "table"):
        if output in outputs and len(document["levels"]) < 2 and kind != "certificate":
            raise SceneError(
                f"outputs: {output} needs two levels for a slope; add a level, or drop {output}"
            )


def _check_certified(document):
    """Refuse what has no guaranteed bounds, and what only a truth has."""
    if not is_certified(document):
        return
    field = "truth.kind" if document["truth"]["kind"] == "certificate" else "certificate"
    check_certifiable(document, field)
    if field == "truth.kind" and "expect" in document:
        raise SceneError(
            "expect: needs errors, which truth.kind certificate does not compute; drop it"
        )


def _check_norms(document):
    kind, norms = document["truth"]["kind"], document["norms"]
    contact_norms = [norm for norm in norms if norm in CONTACT]
    if contact_norms and kind != "exact":
        raise SceneError(
            f"norms: {contact_norms[0]} needs an exact truth; drop it, or set truth.kind to exact"
        )
    for norm in document.get("expect", {}).get("slopes", {}):
        if norm not in norms:
            raise SceneError(f"expect.slopes.{norm}: the norm is not computed; add it to norms")
