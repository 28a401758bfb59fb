"""What in a problem costs digits or slows multigrid: stretched cells, jumps of the coefficient."""

# Cells so many times as long as high need more steps by levels that know only the mesh than by
# algebraic ones; measured.
STRETCHED = 8.0
# Of the coefficient within a triangle of a coarser mesh, which that mesh then cannot follow.
JUMP = 30.0


def has_jumps(coefficient):
    """Whether a coefficient varies so much that coarse meshes, or plain products with A, cannot
    follow it.

    Examples
    --------
    >>> import numpy as np
    >>> has_jumps(np.array([1.0, 2.0])), has_jumps(np.array([1.0, 100.0]))
    (False, True)
    """
    return coefficient is not None and bool(coefficient.max() > JUMP * coefficient.min())


def is_regular(mesh):
    """Whether no cell of a mesh is stretched.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> is_regular(Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels))
    True
    >>> is_regular(Grid(4, 4, (0.0, 0.0), (100.0, 1.0), "falling", labels))
    False
    """
    return mesh.stretch <= STRETCHED


def is_nested(mesh):
    """Whether the meshes that `mesh` was refined from make good levels: there is one, and no cell
    is stretched.

    Examples
    --------
    >>> from signorini.mesh.grid import Grid
    >>> labels = ("contact", "neumann", "dirichlet", "neumann")
    >>> is_nested(Grid(4, 4, (0.0, 0.0), (1.0, 1.0), "falling", labels))
    True
    >>> is_nested(Grid(3, 3, (0.0, 0.0), (1.0, 1.0), "falling", labels))
    False
    """
    return mesh.coarser() is not None and is_regular(mesh)


def accuracy_loss_causes(problem):
    """What in a problem costs digits: cell shapes, the coefficient; and the remedy; a message.

    Examples
    --------
    >>> import signorini
    >>> mesh = signorini.rectangle(4, size=(100, 1), cells="per-side")
    >>> problem = signorini.problem(mesh, f=1, dirichlet=["top"], contact="bottom")
    >>> accuracy_loss_causes(problem)
    'there are cells 1e+02 times as long as high; stretch cells less'
    """
    reasons = []
    if problem.mesh.stretch > STRETCHED:
        reasons.append(
            f"there are cells {problem.mesh.stretch:.2g} times as long as high; stretch cells less"
        )
    if has_jumps(problem.coefficient):
        contrast = problem.coefficient.max() / problem.coefficient.min()
        reasons.append(f"the coefficient varies by {contrast:.1g}; let it vary less")
    return ", and ".join(reasons) or "look for data of very different sizes"
