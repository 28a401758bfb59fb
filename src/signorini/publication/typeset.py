"""LaTeX: from a source and the generated files that it inputs to a clean PDF."""

import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from signorini.exceptions import SignoriniError
from signorini.storage import replacing
from signorini.wording import cut

_ERROR = re.compile(r"^(?:\./)?([^\s:]+\.\w+):(\d+): (.*)$", re.M)  # of -file-line-error
_FATAL = re.compile(r"^! (.*)$", re.M)
_WARNING = re.compile(
    r"^(?:.*undefined.*|.*multiply defined.*|.*Font shape .* not available.*)$", re.M
)
_OVERFULL = re.compile(r"^.*Overfull .*$", re.M)
_LINE = re.compile(r"(?:on input line|at lines?) (\d+)(?:--\d+)?\.?")
_NAME = re.compile(r"^(?:LaTeX(?: Font)?|Package \w+|Class \w+) (?:Error|Warning): ")
_MISSING = re.compile(r"not (?:found|available|loadable)|can't find file")
_PAGES = re.compile(r"Output written on .*?\((\d+) pages?")
_ENVIRONMENT = {
    # A fixed date makes the same input the same PDF.
    "SOURCE_DATE_EPOCH": "1167609600",
    "FORCE_SOURCE_DATE": "1",
    # TeX breaks the lines of its log elsewhere, in the middle of words.
    "max_print_line": "1000",
    # A manuscript of someone else's reads and writes in its folder alone, and starts no program.
    "openin_any": "p",
    "openout_any": "p",
    "shell_escape": "f",
}
_OPTIONS = (
    "-norc",
    "-pdf",
    "-interaction=nonstopmode",
    "-halt-on-error",
    "-file-line-error",
    "-no-shell-escape",
)
# Of processor time, for each run of LaTeX; one of an article takes seconds.
SECONDS = 300
_LATEXMK = ("latexmk", *_OPTIONS, "-silent")


@dataclass(frozen=True)
class Typeset:
    """A document that was made.

    Parameters
    ----------
    pages : int
    too_wide : tuple of str
        Boxes that stick out: place, LaTeX's words, and the remedy.
    """

    pages: int
    too_wide: tuple = ()


def typeset(source, parts, output, own=(), strict=True):
    """Run latexmk on a source.

    Parameters
    ----------
    source : str or Path
        The main .tex file.
    parts : sequence of str or Path
        Generated files, and folders of such files, that it takes in by name.
    output : str or Path
        The PDF, replaced only by a clean one.
    own : sequence of Path, optional
        Other files from the folder of the source, which keep their place relative to it.
    strict : bool, optional
        Whether an overfull box is an error.

    Returns
    -------
    Typeset

    Raises
    ------
    SignoriniError
        If LaTeX fails, or warns of an undefined reference or, where it is strict, an overfull box:
        with its own first words on it, and the line of the manuscript.
    """
    source = Path(source)
    with tempfile.TemporaryDirectory(prefix="signorini-") as folder:
        folder = Path(folder)
        _gather(folder, source, own, parts)
        pdf = folder / f"{source.stem}.pdf"
        result = _latexmk(folder, source.name)
        log = _log_of(pdf)
        too_wide = [_of_line(found, source) for found in _OVERFULL.finditer(log)]
        complaint = _complaint(log, source) or (too_wide[0] if strict and too_wide else None)
        if result.returncode or complaint or not pdf.is_file():
            raise SignoriniError(complaint or _last_words(result, source))
        with replacing(output, "wb") as stream:
            stream.write(pdf.read_bytes())
        pages = int(_PAGES.search(log.replace("\n", "")).group(1))
        return Typeset(pages, tuple(too_wide))


def _gather(folder, source, own, parts):
    """Copy everything that LaTeX reads into one folder."""
    shutil.copy(source, folder)
    for path in own:
        place = folder / path.relative_to(source.parent)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, place)
    for path in map(Path, parts):
        if path.is_dir():
            shutil.copytree(path, folder / path.name, ignore=shutil.ignore_patterns(".*"))
        else:
            shutil.copy(path, folder)


def _latexmk(folder, name):
    return subprocess.run(
        [*_LATEXMK, name],
        cwd=folder,
        env=os.environ | _ENVIRONMENT,
        capture_output=True,
        check=False,
        preexec_fn=_limit_time,
    )


def _limit_time():
    """Let no program that is started next, nor those that it starts, loop for ever."""
    try:
        import resource
    except ImportError:  # Windows
        return
    _, most = resource.getrlimit(resource.RLIMIT_CPU)
    limit = SECONDS if most == resource.RLIM_INFINITY else min(SECONDS, most)
    resource.setrlimit(resource.RLIMIT_CPU, (limit, most))


def _log_of(pdf):
    log = pdf.with_suffix(".log")
    return log.read_text(encoding="utf-8", errors="replace") if log.is_file() else ""


def _complaint(log, source):
    """The first thing that LaTeX says is wrong, in one line with its place; None if nothing is."""
    error, fatal = _ERROR.search(log), _FATAL.search(log)
    if error:
        file, line, said = error.groups()
        earlier = fatal and fatal.start() < error.start()  # which has no line of its own
        said = fatal[1] if earlier else f"{said}{_culprit(log, error.end(), said)}"
        return _message(source.parent / file, line, said)
    if fatal:
        return _message(source, None, fatal[1])
    warning = _WARNING.search(log)
    return _of_line(warning, source) if warning else None


def _of_line(warning, source):
    """A warning that tells its line itself."""
    line = _LINE.search(warning[0])
    return _message(source, line and line[1], warning[0].strip())


def _culprit(log, start, said):
    """The command that is undefined, which stands at the end of the line that TeX shows next."""
    if not said.startswith("Undefined control sequence"):
        return ""
    shown = re.search(r"^l\.\d+ .*?(\\[A-Za-z@]+|\\.)\s*$", log[start : start + 1000], re.M)
    return f" {shown[1]}" if shown else ""


def _message(path, line, said):
    place = f"{path}:{line}" if line else f"{path}"
    said = _NAME.sub("", said).rstrip(" .")
    return f"{place}: LaTeX: {cut(said, 200)}; {_remedy(said)}"


def _remedy(said):
    if said.startswith("Overfull"):
        return "shorten the line or the table there, or allow it with \\hfuzz"
    return "mend it there" + (", or install what is missing" if _MISSING.search(said) else "")


def _last_words(result, source):
    """Where LaTeX has no words, the end of what latexmk says."""
    said = result.stderr.decode(errors="replace").strip()[-300:] or "failed without a message"
    return _message(source, None, said)
