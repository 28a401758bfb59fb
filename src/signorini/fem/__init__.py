"""Discretisation: the elements P1 and CR, quadrature, load, and stiffness.

`problem.discretize` makes a `problem.Problem` of them.
"""
