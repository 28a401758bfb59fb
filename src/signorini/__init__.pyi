from signorini.api.certificate import certify as certify
from signorini.api.convergence import convergence as convergence
from signorini.api.convergence import rates as rates
from signorini.api.domains import polygon as polygon
from signorini.api.domains import rectangle as rectangle
from signorini.api.domains import triangulation as triangulation
from signorini.api.exact import exact_solution as exact_solution
from signorini.api.meshes import Mesh as Mesh
from signorini.api.problem import problem as problem
from signorini.api.reporting import latex_table as latex_table
from signorini.api.reporting import plot_errors as plot_errors
from signorini.api.solution import Solution as Solution
from signorini.api.solve import solve as solve
from signorini.exceptions import SignoriniError as SignoriniError
from signorini.fem.discrete_problem import Problem as Problem
from signorini.fem.problem import discretize as discretize
from signorini.scene.read import load_scene as load_scene
from signorini.scene.scene import Scene as Scene
from signorini.solvers import kkt_residual as kkt_residual

__version__: str
__all__: list[str]
