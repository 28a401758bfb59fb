"""What only a program can get wrong of the section ``quantities``."""

import math

import pytest

from signorini.exceptions import SceneError
from signorini.scene.quantities import check_quantities


@pytest.mark.parametrize("factor", [math.inf, -math.inf, math.nan])
def test_a_factor_that_is_not_finite_is_refused(factor):
    document = {
        "boundary": {"bottom": "contact"},
        "quantities": {"force": {"kind": "flux", "factor": factor}},
    }
    with pytest.raises(SceneError, match=r"quantities\.force\.factor: .* it must be finite"):
        check_quantities(document)
