"""Rivals in a process of their own: one that neither ends nor can be told when to is ended from
outside.
"""

import multiprocessing
import os


class Arena:
    """A process that runs rivals on request, and is started anew when it had to be ended.

    Parameters
    ----------
    work : callable
        Called in the process with what `ask` is given; its result must be picklable.
    patience : float
        Seconds after which a request is given up.
    """

    def __init__(self, work, patience):
        self.work, self.patience = work, patience
        self.process = None

    def ask(self, *request):
        """The result of the work, or None where it took too long or the process died."""
        if self.process is None:
            self._start()
        self.pipe.send(request)
        try:
            if self.pipe.poll(self.patience):
                return self.pipe.recv()
        except (EOFError, ConnectionResetError):
            pass
        self.close()
        return None

    def close(self):
        """End the process, if there is one."""
        if self.process is not None:
            self.process.kill()
            self.process.join()
            self.process = None

    def _start(self):
        context = multiprocessing.get_context("fork")
        self.pipe, other = context.Pipe()
        self.process = context.Process(target=_serve, args=(self.work, other), daemon=True)
        self.process.start()
        other.close()


def _serve(work, pipe):
    quiet = os.open(os.devnull, os.O_WRONLY)
    os.dup2(quiet, 1)
    os.dup2(quiet, 2)
    while True:
        pipe.send(work(*pipe.recv()))
