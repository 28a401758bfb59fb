"""Keys: every number of a scene's results has one, such as ``l2, CR, 64``.

`declared_keys` tells from the scene alone which there will be, so that a wrong one is found before
any work; `numbers` finds their values. A star stands for what only the results show: how many
contact unknowns there are.
"""

import difflib

from signorini.errors.rates import KINDS
from signorini.mesh.boundary import labels_of
from signorini.publication.swept import SWEEP, swept_words
from signorini.scene.certified import is_certified
from signorini.scene.table import computed_norms
from signorini.wording import cut

SLOPE, RATE, PUBLISHED, DEVIATION, EFFECT = "slope", "rate", "published", "deviation", "effect"
QUANTITY = "quantity"
STAR = "*"
COARSEST, FINEST = ENDS = ("coarsest", "finest")  # levels by another name
# Columns of errors.csv that are numbers, besides the norms.
FACTS = ("h", "dofs", "residual", "accuracy", "multiplier_accuracy", "undecided", "iterations")
LINE = ("component", "s", "x", "y", "u", "obstacle", "flux", "binding")  # of contact_line.csv
THRESHOLD = "threshold"  # a column where data.contact_flux is not 0
CERTIFICATE = "certificate"
# Columns of certificates.csv.
BOUNDS = (
    *("upper", "lower", "l2", "oscillation", "contact", "gap", "primal", "dual", "steps", "radius"),
    *("error", "effectivity", "lower_ratio"),
)
SUMMARY = ("total", "matched", "exact", "largest")  # of check.csv
# Options of the discretisation; see `open_choices.effects`.
CHOICES = ("diagonal", "load", "norm", "quadrature")
SURFACE = ("cells", "corner", "contact_cells", "last_free")  # of surface.npz

# Name of a table, as here -> its file in the folder of the scene's results.
FILES = {
    "scene": "scene.json",
    "errors": "errors.csv",
    "rates": "rates.csv",
    "outputs": "outputs.csv",
    "check": "check.csv",
    "effects": "effects.csv",
    "certificates": "certificates.csv",
    "surface": "surface.npz",
    "sweep": "sweep.csv",
    "contact_line": "contact_line.csv",  # last, for it is long
}


def key_of(*words):
    """A key from its words.

    Examples
    --------
    >>> key_of("l2", "CR", 64)
    'l2, CR, 64'
    """
    return ", ".join(map(str, words))


def tidy(key):
    """A key as somebody typed it, with one space after each comma.

    Examples
    --------
    >>> tidy("l2,CR ,64")
    'l2, CR, 64'
    """
    return key_of(*(" ".join(word.split()) for word in key.split(",")))


def declared_keys(document, published=()):
    """The keys of the numbers that a scene computes.

    Parameters
    ----------
    document : dict
        A validated scene.
    published : iterable of Published, optional
        Those that it is checked against.

    Returns
    -------
    dict
        Key -> name of its table, one of `FILES`. Words that are a star stand for whole numbers.

    Examples
    --------
    >>> from signorini import load_scene
    >>> keys = declared_keys(load_scene("config/scenes/paper.yaml").document)
    >>> keys["l2, CR, 64"], keys["rate, h1, P1, 64"]
    ('errors', 'errors')
    """
    found = dict.fromkeys(_scene_keys(document), "scene")
    if document["truth"]["kind"] != "none":
        found |= dict.fromkeys(_error_keys(document), "errors")
        found |= dict.fromkeys(_rate_keys(document), "rates")
    found |= dict.fromkeys(_quantity_keys(document), "outputs")
    if is_certified(document):
        found |= dict.fromkeys(_certificate_keys(document), "certificates")
    if "contact" in labels_of(document["boundary"]):
        found |= dict.fromkeys(_line_keys(document), "contact_line")
    if SWEEP in document:
        found |= dict.fromkeys(_sweep_keys(document), SWEEP)
    if published:
        found |= dict.fromkeys(_check_keys(published), "check")
    if is_sampled(document):
        found |= dict.fromkeys(_surface_keys(), "surface")
    if has_effects(document):
        found |= dict.fromkeys((key_of(EFFECT, choice) for choice in CHOICES), "effects")
    return found


def is_sampled(document):
    """Whether the reference can be sampled for a surface plot.

    Examples
    --------
    >>> from signorini import load_scene
    >>> is_sampled(load_scene("config/scenes/paper.yaml").document)
    True
    """
    truth, domain = document["truth"], document["domain"]
    return (domain["kind"], truth["kind"], truth.get("element")) == ("rectangle", "reference", "P1")


def has_effects(document):
    """Whether other options can be tried: other diagonals, and errors against a reference.

    Examples
    --------
    >>> from signorini import load_scene
    >>> names = ("paper", "punch")
    >>> [has_effects(load_scene(f"config/scenes/{name}.yaml").document) for name in names]
    [True, False]
    """
    truth, domain = document["truth"], document["domain"]
    is_comparable = set(document["norms"]) <= {"l2", "h1_semi", "h1"}
    return is_comparable and (domain["kind"], truth["kind"]) == ("rectangle", "reference")


def _scene_keys(document):
    yield from (key_of("level", word) for word in ("coarsest", "finest", "count"))
    if document["truth"]["kind"] == "reference":
        yield key_of("reference", "n")
    if SWEEP in document:
        yield key_of(SWEEP, "count")


def _error_keys(document):
    norms = computed_norms(document)
    for element in document["elements"]:
        for n in (*document["levels"], *ENDS):
            yield from (key_of(name, element, n) for name in (*norms, *FACTS))
        if len(document["levels"]) < 2:
            continue
        for n in (*document["levels"][1:], FINEST):
            yield from (key_of(RATE, norm, element, n) for norm in norms)


def _rate_keys(document):
    if len(document["levels"]) < 2:
        return
    for element in document["elements"]:
        for norm in computed_norms(document):
            yield key_of(SLOPE, norm, element)
            yield from (key_of(SLOPE, norm, element, kind) for kind in KINDS)


def _quantity_keys(document):
    solutions = [(e, n) for e in document["elements"] for n in (*document["levels"], *ENDS)]
    truth = document["truth"]
    if truth["kind"] == "reference":
        solutions.append((truth["element"], truth["n"]))
    for name in document["quantities"]:
        yield from (key_of(QUANTITY, name, *solution) for solution in solutions)


def _certificate_keys(document):
    known = document["truth"]["kind"] == "exact"
    names = BOUNDS if known else BOUNDS[: BOUNDS.index("error")]
    for element in document["elements"]:
        for n in (*document["levels"], *ENDS):
            yield from (key_of(CERTIFICATE, name, element, n) for name in names)


def _line_keys(document):
    has_threshold = document["data"].get("contact_flux", 0) != 0
    for element in document["elements"]:
        yield key_of("critical", element, "count")
        yield key_of("critical", element, STAR)
        names = (*LINE, THRESHOLD) if has_threshold else LINE
        yield from (key_of("contact", name, element, STAR) for name in names)


def _sweep_keys(document):
    yield from (key_of(SWEEP, *words) for words in swept_words(document, STAR))


def _check_keys(published):
    yield from (key_of("check", word) for word in SUMMARY)
    for number in published:
        yield key_of(PUBLISHED, number.key)
        yield key_of(DEVIATION, number.key)


def _surface_keys():
    yield from (key_of("surface", word) for word in SURFACE)
    yield from (key_of("surface", f"critical_{axis}", STAR) for axis in "xy")


def table_of(key, declared):
    """The table that holds the number of a key.

    Parameters
    ----------
    key : str
        As `tidy` returns it.
    declared : dict
        As `declared_keys` returns it.

    Returns
    -------
    str or None
        None where there is no such number.

    Examples
    --------
    >>> table_of("l2, CR, 64", {"l2, CR, 64": "errors"})
    'errors'
    """
    return declared.get(key) or declared.get(_starred(key))


def _starred(key):
    """A key whose last word is a whole number, with a star in its place."""
    *words, last = key.split(", ")
    return key_of(*words, STAR) if last.isdecimal() and int(last) > 0 else None


def nearest_key(key, known):
    """A hint at the nearest of the known keys, and where all of them are told.

    Parameters
    ----------
    key : str
        That is not known.
    known : iterable of str

    Returns
    -------
    str

    Examples
    --------
    >>> nearest_key("L2, CR, 64", ["l2, CR, 64", "l2, CR, 32"])
    'did you mean {l2, CR, 64}? `signorini macros SCENE` lists all'
    """
    near = difflib.get_close_matches(cut(key, 100), list(known), n=1, cutoff=0.5)
    hint = f"did you mean {{{near[0]}}}? " if near else ""
    return f"{hint}`signorini macros SCENE` lists all"
