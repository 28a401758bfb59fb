"""What a long solve is doing: a line that overwrites itself on a terminal, nothing in a pipe."""

import logging
import sys
from contextlib import contextmanager

_CLEAR = "\r\x1b[K"  # back to the start of the line, and delete it
_WIDTH = 100


class _Line(logging.Handler):
    """Shows the last message on one line of a terminal."""

    def emit(self, record):
        sys.stderr.write(_CLEAR + self.format(record)[:_WIDTH])
        sys.stderr.flush()


@contextmanager
def told_steps(verbose):
    """Tell what the library logs while the block runs.

    Parameters
    ----------
    verbose : bool
        Whether each message gets a line of its own, also where standard error is no terminal.
    """
    terminal = sys.stderr.isatty()
    if not (verbose or terminal):
        yield
        return
    log = logging.getLogger("signorini")
    handler = logging.StreamHandler() if verbose else _Line()
    log.addHandler(handler)
    log.setLevel(logging.INFO)
    try:
        yield
    finally:
        log.removeHandler(handler)
        if not verbose:
            sys.stderr.write(_CLEAR)
