"""Plain facts of the two elements: names, and memory that their solves need.

Nothing here imports NumPy, so that a scene can be checked without it. What the elements do is in
`signorini.fem.elements`.
"""

from dataclasses import dataclass

from signorini.memory import GRID


@dataclass(frozen=True)
class ElementFacts:
    """What is known of an element before anything is computed.

    Parameters
    ----------
    name : str
        As in scenes, result files and messages.
    title : str
        In words.
    abbreviation : str
        In the tables and figures of the paper.
    direct_bytes, multigrid_bytes, petsc_bytes : int
        Memory that a solve by this route needs for each triangle; the least measured on 2**15 to
        2**23 triangles.
    multigrid_stretch : float
        Length over height of cells, beyond which no multigrid levels converge; measured.
    """

    name: str
    title: str
    abbreviation: str
    direct_bytes: int
    multigrid_bytes: int
    petsc_bytes: int
    multigrid_stretch: float

    @property
    def label(self):
        """In the legend of a figure: abbreviation and name.

        Examples
        --------
        >>> CR_FACTS.label
        'NCF (CR)'
        """
        return f"{self.abbreviation} ({self.name})"

    def bytes_by(self, route):
        """Memory that a solve needs for each triangle.

        Parameters
        ----------
        route : {"fourier", "multigrid", "direct", "petsc"}

        Returns
        -------
        int

        Examples
        --------
        >>> P1_FACTS.bytes_by("direct")
        1100
        """
        return {
            "fourier": GRID,
            "multigrid": self.multigrid_bytes,
            "direct": self.direct_bytes,
            "petsc": self.petsc_bytes,
        }[route]


P1_FACTS = ElementFacts(
    "P1",
    "conforming P1",
    "CF",
    direct_bytes=1100,
    multigrid_bytes=130,
    petsc_bytes=500,
    multigrid_stretch=1e6,
)
CR_FACTS = ElementFacts(
    "CR",
    "Crouzeix-Raviart",
    "NCF",
    direct_bytes=1800,
    multigrid_bytes=400,
    petsc_bytes=1200,
    multigrid_stretch=50.0,
)

ELEMENT_FACTS = {facts.name: facts for facts in (P1_FACTS, CR_FACTS)}
ELEMENT_NAMES = tuple(ELEMENT_FACTS)
ABBREVIATIONS = {name: facts.abbreviation for name, facts in ELEMENT_FACTS.items()}
