"""A process apart: foreign code may crash, or never end, and is then ended from outside."""

import multiprocessing
import os


class Worker:
    """A process that calls one function on request; it is started anew after it had to be ended.

    Parameters
    ----------
    function : callable
        Called in a fork of this process; what it returns must be picklable.
    time_limit : float
        Seconds after which a request is given up.
    quiet : bool, optional
        Whether what the process prints is dropped.

    Attributes
    ----------
    trouble : str or None
        Why the last request had no answer.
    """

    def __init__(self, function, time_limit, quiet=False):
        self.function, self.time_limit, self.quiet = function, time_limit, quiet
        self.process = self.trouble = None

    def ask(self, *arguments):
        """What the function returns, or None where it took too long or the process died.

        Examples
        --------
        >>> worker = Worker(pow, time_limit=10.0)
        >>> worker.ask(2, 10)
        1024
        >>> worker.close()
        """
        if self.process is None:
            self._start()
        self.trouble = None
        self.pipe.send(arguments)
        try:
            if self.pipe.poll(self.time_limit):
                return self.pipe.recv()
            self.trouble = f"no answer within {self.time_limit:g} s"
        except (EOFError, ConnectionResetError):
            self.process.join()
            self.trouble = f"the process ended with exit code {self.process.exitcode}"
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
        self.process = context.Process(target=self._serve, args=(other,), daemon=True)
        self.process.start()
        other.close()

    def _serve(self, pipe):
        if self.quiet:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, 1)
            os.dup2(nowhere, 2)
        while True:
            pipe.send(self.function(*pipe.recv()))
