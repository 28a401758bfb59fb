"""The benchmark: run time against error, and rivals on the same matrices."""
