"""The stability suite: generated problems, a judge in extended precision, extremes, and where
round-off begins.
"""
