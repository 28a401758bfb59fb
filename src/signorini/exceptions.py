"""Errors a user can mend: each message is one line with the place, the value and the remedy."""


class SignoriniError(Exception):
    """Base of every error this package raises on purpose."""


class FormulaError(SignoriniError):
    """A formula that cannot be read, or whose value is not a finite real number."""


class SceneError(SignoriniError):
    """A scene or configuration file that does not state a well-posed question."""


class MeshError(SignoriniError):
    """A mesh that is not a valid, fully labelled triangulation, or does not nest."""


class SolverError(SignoriniError):
    """A problem that has no unique solution, or a solve that did not reach its tolerance."""


class NotApplicableError(SolverError):
    """A method that does not take such a problem at all."""


class StorageError(SignoriniError):
    """A file that cannot be written, or is truncated, altered or of another kind."""
