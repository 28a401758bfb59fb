"""Names of what a sweep tells of each solution: columns of sweep.csv."""

CONTACT = ("resultant", "contact_length", "critical_count", "first_critical", "last_critical")
QUANTITY = "quantity."  # before the name of a quantity of the scene
RATE = "rate_"  # before a norm
FAILED = "failed"
