"""The judge: solutions in extended precision (80 bits), by which those in double are judged.

The judge knows problems and meshes, and shares no arithmetic with the solvers. It never forms the
matrix: what acts on a degree of freedom is a sum of couplings times differences, and its
elimination keeps couplings too, so that neither stiff parts nor graded cells cost digits.

- `couplings`: the Dirichlet form as a network of couplings.
- `elimination`: elimination of nodes of such a network.
- `contact_set`: what loads do with a contact set, and the exchange of wrong signs.
- `refinement`: the refinement of u, to the last digit.
- `dense`: small problems in double precision, by other means than the solvers'.
- `entries`, `pairs`: the solution of the rounded matrix itself, as pairs of doubles.
- `judgement`: what was found, and how solutions compare with it.
"""

from signorini.judge.judgement import DOUBLE, EPS, Judgement
from signorini.judge.refinement import judge

__all__ = ["DOUBLE", "EPS", "Judgement", "judge"]
