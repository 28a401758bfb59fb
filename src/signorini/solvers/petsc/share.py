"""One process's share of a problem: its rows of A, and its part of every vector.

Processes own ranges of dofs that follow one another. What a process needs of the dofs of others,
its ghosts, is brought by PETSc.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from signorini.fem.residual import contact_fluxes_of, residual, residual_and_fluxes, row_sums
from signorini.solvers.extremes import largest, span


@dataclass(frozen=True, eq=False)
class Share:
    """Some rows of a problem whose constraint is from below.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
        The processes that share the problem.
    A : scipy.sparse.csr_array, shape (m, m + k)
        The rows of the m dofs that this process owns; its columns are these dofs, then the ghosts.
    ghosts : ndarray of int, shape (k,)
        Their numbers among all dofs.
    b : ndarray, shape (m,)
    fixed : ndarray of int, shape (d,)
        Own dofs on the Dirichlet part, by their place here.
    fixed_values : ndarray, shape (d,)
    contact : ndarray of int, shape (c,)
        Own dofs under the constraint, by their place here.
    lower : ndarray, shape (c,)
        The obstacle at them.
    places : ndarray of int, shape (c,)
        Where they stand among all contact dofs.
    count : int
        Of all contact dofs, nc.
    """

    comm: object
    A: object
    ghosts: np.ndarray
    b: np.ndarray
    fixed: np.ndarray
    fixed_values: np.ndarray
    contact: np.ndarray
    lower: np.ndarray
    places: np.ndarray
    count: int

    grid = None  # of a share no stencil is the whole matrix; see `Problem.grid`

    # Reductions: numbers that are the same on every process.

    def largest(self, values):
        """Greatest absolute value."""
        return self.maxima([largest(values)])[0]

    def span(self, values):
        """Least and greatest value; infinite and the wrong way round where there are none."""
        return span(values, maxima=self.maxima)

    def maxima(self, numbers):
        """The greatest over all processes of each of some numbers."""
        from mpi4py import MPI

        numbers = np.array(numbers, dtype=float)
        self.comm.Allreduce(MPI.IN_PLACE, numbers, MPI.MAX)
        return numbers.tolist()

    def total(self, numbers):
        """The sum over all processes of an array, shape unchanged."""
        from mpi4py import MPI

        numbers = np.array(numbers, dtype=float)
        self.comm.Allreduce(MPI.IN_PLACE, numbers, MPI.SUM)
        return numbers

    def on_contact(self, values):
        """Values at all contact dofs, shape (nc,), from those at the own ones, shape (c,)."""
        whole = np.zeros(self.count)
        whole[self.places] = values
        return self.total(whole)

    @cached_property
    def held_somewhere(self):
        """Whether any process has a dof on the Dirichlet part."""
        return bool(self.total([self.fixed.size])[0])

    # Vectors and the matrix.

    @cached_property
    def first(self):
        """The number of the first own dof among all."""
        return int(self.comm.exscan(self.b.size) or 0)

    def vector(self, values):
        """A PETSc vector of which this process holds `values`, not copied."""
        from petsc4py import PETSc

        return PETSc.Vec().createWithArray(values, comm=self.comm)

    @cached_property
    def _scatter(self):
        from petsc4py import PETSc

        target = PETSc.Vec().createSeq(self.ghosts.size)
        numbers = PETSc.IS().createGeneral(self.ghosts, comm=PETSc.COMM_SELF)
        scatter = PETSc.Scatter().create(self.vector(np.zeros_like(self.b)), numbers, target, None)
        return scatter, target

    def with_ghosts(self, u):
        """The values of u at the columns of `A`, shape (m + k,)."""
        if self.comm.size == 1:
            return u
        scatter, target = self._scatter
        scatter.scatter(self.vector(u), target)
        return np.concatenate([u, target.getArray()])

    @cached_property
    def _sums(self):
        return row_sums(self.A) if self.b.size else np.zeros(0)

    def residual_and_fluxes(self, u):
        """b - A u by differences, and the sums of the sizes of its fluxes, both (m,)."""
        if not self.b.size:
            self.with_ghosts(u)
            return np.zeros((2, 0))
        return residual_and_fluxes(self.A, self.b, self.with_ghosts(u), sums=self._sums)

    @cached_property
    def _contact_rows(self):
        return self.A[self.contact]

    def forces(self, u, load):
        """A u - load at all contact dofs, shape (nc,).

        Parameters
        ----------
        u, load : ndarray, shape (m,)
            At the own dofs of this process.

        Returns
        -------
        ndarray, shape (nc,)
        """
        return self.on_contact(self._contact_rows @ self.with_ghosts(u) - load[self.contact])

    def apply(self, u):
        """A u, (m,), by differences."""
        everywhere = self.with_ghosts(u)
        if not self.b.size:
            return np.zeros(0)
        return -residual(self.A, np.zeros_like(self.b), everywhere, self._sums)

    def diagonal(self):
        """The diagonal of the own rows, (m,)."""
        return self.A.diagonal()

    def contact_fluxes(self, u):
        """What flows into the own contact dofs, (c,) each; see `Problem.contact_fluxes`."""
        return contact_fluxes_of(self._contact_rows, self.contact, self.with_ghosts(u))

    def constrained(self, active):
        """Mask (m,) of the own dofs that do not move with the contact set `active` (nc,) held."""
        mask = np.zeros(self.b.size, dtype=bool)
        mask[self.fixed] = True
        mask[self.contact[active[self.places]]] = True
        return mask

    def matrix(self):
        """A as a PETSc matrix of its own."""
        from petsc4py import PETSc

        m, own = self.b.size, np.arange(self.first, self.first + self.b.size, dtype=np.int32)
        columns = np.concatenate([own, self.ghosts]).astype(PETSc.IntType)
        entries = self.A.indptr.astype(PETSc.IntType), columns[self.A.indices], self.A.data
        sizes = ((m, None), (m, None))
        matrix = PETSc.Mat().createAIJ(sizes, csr=entries, comm=self.comm)
        matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        return matrix

    def rows_of(self, mask):
        """The numbers among all dofs of own dofs in a mask, as PETSc takes them."""
        from petsc4py import PETSc

        return (self.first + np.flatnonzero(mask)).astype(PETSc.IntType)

    def scaled(self, exponent):
        """The share whose data are 2**exponent times these."""
        names = ("b", "lower", "fixed_values")
        return self.with_data(**{name: np.ldexp(getattr(self, name), exponent) for name in names})

    def shifted(self, constant):
        """The share whose solution is less by a constant; this one where that is 0."""
        if not constant:
            return self
        lower, fixed_values = self.lower - constant, self.fixed_values - constant
        return self.with_data(lower=lower, fixed_values=fixed_values)

    def with_data(self, **data):
        """The same rows with other data; what is known of A is kept."""
        changed = replace(self, **data)
        for name in ("first", "_scatter", "_sums", "_contact_rows", "held_somewhere"):
            if name in vars(self):
                vars(changed)[name] = vars(self)[name]
        return changed


def whole(problem, comm):
    """A whole problem as the share of one process.

    Parameters
    ----------
    problem : Problem
        Whose constraint is from below.
    comm : mpi4py.MPI.Comm
        Of one process.

    Returns
    -------
    Share
    """
    return Share(
        comm=comm,
        A=problem.A,
        ghosts=np.zeros(0, dtype=np.int32),
        b=problem.b,
        fixed=problem.fixed,
        fixed_values=problem.fixed_values,
        contact=problem.contact,
        lower=problem.lower,
        places=np.arange(problem.contact.size),
        count=problem.contact.size,
    )
