"""General solvers of quadratic programs.

Interior point methods also stop on the duality gap, a sum of products gap times force. It is asked
for a thousandth of the tolerance: at the tolerance itself the smaller factor of a product stays far
above it.
"""

import numpy as np

_MAX_STEPS = 100_000
_GAP = 1e-3


def _upper(K):
    from scipy.sparse import csc_matrix, triu

    return csc_matrix(triu(K))


def _selection(qp):
    """The matrix that picks the contact unknowns, shape (nc, n)."""
    from scipy.sparse import csc_matrix

    rows = np.arange(qp.contact.size)
    return csc_matrix((np.ones(rows.size), (rows, qp.contact)), shape=(rows.size, qp.f.size))


def osqp(qp):
    """OSQP: alternating directions, then a polishing step."""
    import osqp

    solver = osqp.OSQP()
    solver.setup(
        _upper(qp.K),
        -qp.f,
        _selection(qp),
        qp.lower,
        np.full(qp.lower.size, np.inf),
        eps_abs=qp.tolerance,
        eps_rel=qp.tolerance,
        max_iter=_MAX_STEPS,
        polishing=True,
        time_limit=qp.seconds_left,
        verbose=False,
    )
    result = solver.solve(raise_error=False)
    return result.x, result.info.status == "solved", result.info.iter


def clarabel(qp):
    """Clarabel: an interior point method."""
    import clarabel

    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.time_limit = qp.seconds_left
    settings.max_threads = 1
    settings.tol_feas = qp.tolerance
    settings.tol_gap_abs = settings.tol_gap_rel = _GAP * qp.tolerance
    cones = [clarabel.NonnegativeConeT(qp.lower.size)]
    solver = clarabel.DefaultSolver(
        _upper(qp.K), -qp.f, -_selection(qp), -qp.lower, cones, settings
    )
    result = solver.solve()
    return np.array(result.x), result.status == clarabel.SolverStatus.Solved, result.iterations


def piqp(qp):
    """PIQP: a proximal interior point method with bounds of its own."""
    import piqp
    from scipy.sparse import csc_matrix

    solver = piqp.SparseSolver()
    solver.settings.eps_abs = solver.settings.eps_rel = qp.tolerance
    solver.settings.eps_duality_gap_abs = solver.settings.eps_duality_gap_rel = _GAP * qp.tolerance
    solver.setup(csc_matrix(qp.K), -qp.f, x_l=qp.bounds, x_u=np.full(qp.f.size, np.inf))
    status = solver.solve()
    return solver.result.x, status == piqp.PIQP_SOLVED, solver.result.info.iter


def proxqp(qp):
    """ProxQP: a proximal augmented Lagrangian method."""
    from proxsuite import proxqp
    from scipy.sparse import csc_matrix

    solver = proxqp.sparse.QP(qp.f.size, 0, qp.lower.size)
    solver.settings.eps_abs = solver.settings.eps_rel = qp.tolerance
    solver.init(
        csc_matrix(qp.K),
        -qp.f,
        None,
        None,
        _selection(qp),
        qp.lower,
        np.full(qp.lower.size, np.inf),
    )
    solver.solve()
    info = solver.results.info
    return solver.results.x, info.status == proxqp.QPSolverOutput.PROXQP_SOLVED, info.iter


def highs(qp):
    """HiGHS: an active set method for quadratic programs, its regularisation switched off."""
    import highspy
    from scipy.sparse import csc_matrix, tril

    size, below = qp.f.size, csc_matrix(tril(qp.K))
    model = highspy.HighsModel()
    model.lp_.num_col_, model.lp_.num_row_ = size, 0
    model.lp_.col_cost_, model.lp_.col_lower_ = -qp.f, qp.bounds
    model.lp_.col_upper_ = np.full(size, highspy.kHighsInf)
    model.lp_.a_matrix_.start_ = np.zeros(size + 1, dtype=np.int32)
    model.hessian_.dim_, model.hessian_.format_ = size, highspy.HessianFormat.kTriangular
    model.hessian_.start_, model.hessian_.index_ = below.indptr, below.indices
    model.hessian_.value_ = below.data
    solver = highspy.Highs()
    options = {
        "output_flag": False,
        "threads": 1,
        "time_limit": qp.seconds_left,
        "qp_regularization_value": 0.0,
        "primal_feasibility_tolerance": max(qp.tolerance, 1e-10),
        "dual_feasibility_tolerance": max(qp.tolerance, 1e-10),
    }
    for name, value in options.items():
        solver.setOptionValue(name, value)
    solver.passModel(model)
    solver.run()
    solved = solver.getModelStatus() == highspy.HighsModelStatus.kOptimal
    return np.array(solver.getSolution().col_value), solved, solver.getInfo().qp_iteration_count
