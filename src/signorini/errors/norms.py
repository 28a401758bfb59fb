"""The names of the norms in which errors are measured."""

GRADIENT = ("h1_semi", "h1", "energy")  # that need the gradient
DOMAIN = ("l2", *GRADIENT)
CONTACT = ("trace_l2", "multiplier_l2", "critical_points")  # on the contact part
RATED = (*DOMAIN, *CONTACT)  # those whose slope is taken: all

REFERENCE = "reference"  # in the column floor: the solution is the reference itself
