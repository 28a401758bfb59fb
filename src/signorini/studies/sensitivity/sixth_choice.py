"""What the section on a sixth choice tells: digits by hypothesis, and digits by chance."""

from dataclasses import dataclass
from functools import cached_property

from signorini.studies.sensitivity.digits import ALL, REFERENCE
from signorini.studies.sensitivity.hypotheses import MODE, NONE, SINGLE, SOR


@dataclass(frozen=True)
class SixthChoice:
    """The rows of `digits.digits` and `chance.chance`, and what they were made with.

    Parameters
    ----------
    digits, chance : list of dict
    reference_n : int
        1/h of the reference.
    solves : int
        How many solutions the table takes.
    """

    digits: list
    chance: list
    reference_n: int
    solves: int

    @cached_property
    def rows(self):
        """A row for each hypothesis: what was found of the reference, and of all or None."""
        found = {}
        for row in self.digits:
            found.setdefault(row["hypothesis"], {})[row["of"]] = row
        return [{"name": name, ALL: None} | by_of for name, by_of in found.items()]

    @property
    def errors(self):
        """How many errors are compared."""
        return int(self.digits[0]["errors"])

    @property
    def before(self):
        """Without a sixth choice."""
        return self._of(NONE, ALL)

    @property
    def single(self):
        """With the load in single precision throughout."""
        return self._of(SINGLE, ALL)

    @property
    def relaxed(self):
        """With a solver that stops early, or None."""
        return self._of(SOR, ALL)

    @property
    def lowered(self):
        """With a reference that is too low in its slowest mode, or None."""
        return self._of(MODE, REFERENCE)

    @property
    def complete(self):
        """The rows in which all digits are met."""
        return [row for row in self.digits if row["digits"] == self.errors]

    @property
    def draws(self):
        """How many loads were rounded at random."""
        return int(sum(row["draws"] for row in self.chance))

    def share(self, least):
        """The share of these draws that meets so many digits."""
        met = sum(row["draws"] for row in self.chance if row["digits"] >= least)
        return met / self.draws

    def _of(self, start, of):
        rows = [row for row in self.digits if row["hypothesis"].startswith(start)]
        return next((row for row in rows if row["of"] == of), None)
