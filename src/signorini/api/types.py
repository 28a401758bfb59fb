"""Types of what a program may give."""

from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Integers: TypeAlias = NDArray[np.integer[Any]]
Booleans: TypeAlias = NDArray[np.bool_]

# A number, a formula in x and y, or a function of the arrays x and y.
Datum: TypeAlias = float | str | Callable[..., Any]
# For all parts of the boundary, or name of a part -> datum.
PartwiseDatum: TypeAlias = Datum | Mapping[str, Datum]
# One part of the boundary, or several.
Names: TypeAlias = str | Collection[str]
