"""What every element can do; `p1` and `cr` fill it in."""

from abc import ABC, abstractmethod

import numpy as np


class Element(ABC):
    """A piecewise affine element; its degrees of freedom are its values at the nodes.

    Attributes
    ----------
    facts : ElementFacts
        Names, and memory that a solve needs.
    basis : ndarray, shape (3, 3)
        ``basis[i]`` holds the values of local shape function i at the three vertices of a triangle.
    coupled : tuple of three pairs of int
        The two local degrees of freedom that each facet (01, 12, 02) of a triangle couples.
    coupling_factor : float
        Their coupling over k_ij, see `stiffness`.
    continuous : bool
        Whether discrete functions are continuous.
    stencil : GridStencil
        The stiffness matrix on a uniform grid, applied without a matrix.
    """

    facts = None
    basis = None
    coupled = None
    coupling_factor = None
    continuous = None
    stencil = None

    def __repr__(self):
        return f"<Element {self.name}>"

    @property
    def name(self):
        """As in scenes and result files."""
        return self.facts.name

    @property
    def title(self):
        """In words."""
        return self.facts.title

    @property
    def nodes_of_triangle(self):
        """Barycentric coordinates of the local nodes, one in each column, shape (3, 3).

        Examples
        --------
        Midpoints of the facets, in each column:

        >>> from signorini.fem.elements import find_element
        >>> find_element("CR").nodes_of_triangle
        array([[0.5, 0. , 0.5],
               [0.5, 0.5, 0. ],
               [0. , 0.5, 0.5]])
        """
        return np.linalg.inv(self.basis)

    def shape(self, barycentric):
        """Values of the local shape functions at points of barycentric coordinates, both (3, q).

        Examples
        --------
        All three shape functions are 1/3 at the centroid:

        >>> from signorini.fem.elements import find_element
        >>> find_element("CR").shape(np.full((3, 1), 1 / 3)).round(12).ravel()
        array([0.33333333, 0.33333333, 0.33333333])
        """
        return self.basis @ barycentric

    # Degrees of freedom on a mesh.

    @abstractmethod
    def size(self, mesh):
        """Number of degrees of freedom.

        Examples
        --------
        >>> from signorini.fem.elements import ELEMENTS
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> [element.size(mesh) for element in ELEMENTS.values()]
        [9, 16]
        """

    @abstractmethod
    def triangle_dofs(self, mesh):
        """Global numbers of the local degrees of freedom, shape (3, nt)."""

    @abstractmethod
    def vertex_values(self, mesh, u):
        """Values of a discrete function at the vertices of each triangle.

        Parameters
        ----------
        mesh : Grid or Triangulation
        u : ndarray, shape (ndof,)

        Returns
        -------
        ndarray, shape (3, nt)
            Unit of u.

        Examples
        --------
        >>> from signorini.fem.elements import find_element
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> find_element("P1").vertex_values(mesh, mesh.p[0])[:, 0]
        array([0. , 0.5, 0. ])
        """

    @abstractmethod
    def nodes(self, mesh, dofs):
        """Coordinates of degrees of freedom.

        Parameters
        ----------
        mesh : Grid or Triangulation
        dofs : ndarray of int, shape (k,)

        Returns
        -------
        ndarray, shape (2, k)
            Unit of length.
        """

    @abstractmethod
    def vertex_means(self, mesh):
        """The two vertices between whose values each degree of freedom lies midway.

        Returns
        -------
        ndarray of int, shape (2, ndof), or None
            None where the degrees of freedom are the values at the vertices.
        """

    # On the boundary.

    @abstractmethod
    def boundary_dofs(self, mesh, label):
        """Degrees of freedom on a closed part of the boundary.

        Parameters
        ----------
        mesh : Grid or Triangulation
        label : {"dirichlet", "contact", "neumann"}

        Returns
        -------
        ndarray of int, shape (k,)
            Increasing.

        Examples
        --------
        >>> from signorini.fem.elements import find_element
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> find_element("CR").nodes(mesh, find_element("CR").boundary_dofs(mesh, "contact"))
        array([[0.25, 0.75],
               [0.  , 0.  ]])
        """

    @abstractmethod
    def boundary_lengths(self, mesh, label):
        """The length of a part of the boundary that each degree of freedom stands for.

        Parameters
        ----------
        mesh : Grid or Triangulation
        label : {"dirichlet", "contact", "neumann"}

        Returns
        -------
        ndarray, shape (ndof,)
            Unit of length; 0 for dofs off that part.

        Examples
        --------
        >>> from signorini.fem.elements import find_element
        >>> from signorini.mesh.grid import Grid
        >>> labels = ("contact", "neumann", "dirichlet", "neumann")
        >>> mesh = Grid(2, 2, (0.0, 0.0), (1.0, 1.0), "falling", labels)
        >>> find_element("P1").boundary_lengths(mesh, "contact")[:3]
        array([0.25, 0.5 , 0.25])
        """

    @abstractmethod
    def path_dofs(self, path):
        """Degrees of freedom along a `Path` of the boundary, and which marks they sit on.

        Returns
        -------
        dofs : ndarray of int, shape (k,)
        first : int
            They sit on every second one of ``path.marks``, from this one on.
        """

    @abstractmethod
    def half_facet_dofs(self, path):
        """For each facet of a `Path`, the dof that holds on its first and on its second half."""

    @abstractmethod
    def inherited(self, mesh, marks, dofs):
        """Marks of dofs as boundary dofs of the refined mesh inherit them.

        Parameters
        ----------
        mesh : Grid or Triangulation
            The finer mesh, which knows the one it was refined from.
        marks : ndarray of bool
            Of all dofs on the coarser mesh.
        dofs : ndarray of int, shape (k,)
            On the boundary of the finer one.

        Returns
        -------
        ndarray of bool, shape (k,)
        """

    @abstractmethod
    def multiplier_cells(self, trace, dofs):
        """The segments on which a multiplier is a constant density.

        Parameters
        ----------
        trace : BoundaryTrace
            Of the contact part.
        dofs : ndarray of int, shape (nc,)
            Contact dofs, increasing.

        Returns
        -------
        ends : ndarray, shape (2, 2, m)
            Coordinates of the segments: axis, end, segment; unit of length.
        place : ndarray of int, shape (m,)
            Position in `dofs` of the dof that each belongs to.
        normal : ndarray, shape (2, m)
            Outward unit normal.
        """

    # Assembly.

    @abstractmethod
    def stiffness_matrix(self, mesh, couplings):
        """Put the couplings of all triangles together.

        Parameters
        ----------
        mesh : Grid or Triangulation
        couplings : ndarray, shape (3, nt)
            k_ij of each facet in each triangle, see `stiffness.facet_couplings`.

        Returns
        -------
        scipy.sparse.csr_array, shape (ndof, ndof)
            Rows sum to zero. Zeros may be stored.
        """

    @abstractmethod
    def add_cell_loads(self, b, grid, first, parts):
        """Add to a vector of a grid, in place, what a block of rows of cells gives to its dofs.

        Parameters
        ----------
        b : ndarray, shape (ndof,)
        grid : Grid
        first : int
            The first row of the block.
        parts : list of two ndarray, shape (3, m, nx)
            For each of the two halves of the cells, in the order of ``grid.corners``: the values
            for its three local dofs in the m rows.
        """

    @abstractmethod
    def skfem(self):
        """The element as scikit-fem knows it."""
