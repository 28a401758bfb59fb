"""Discretisation: the elements P1 and CR, quadrature, load, stiffness and its stencil;
`problem.Problem` holds them.
"""
