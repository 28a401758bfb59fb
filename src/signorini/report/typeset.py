"""LaTeX: from a source and the generated files that it inputs to a clean PDF."""

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from signorini.exceptions import SignoriniError
from signorini.storage import replacing

_TROUBLE = re.compile(
    r"^(?:! .*|.*Overfull .*|.*undefined.*|.*multiply defined.*|.*Font shape .* not available.*)$",
    re.M,
)
_PAGES = re.compile(r"Output written on .*?\((\d+) pages?")
_ENVIRONMENT = {
    # A fixed date makes the same input the same PDF.
    "SOURCE_DATE_EPOCH": "1167609600",
    "FORCE_SOURCE_DATE": "1",
    # TeX breaks the lines of its log elsewhere, in the middle of words.
    "max_print_line": "1000",
}
_LATEXMK = ("latexmk", "-norc", "-pdf", "-interaction=nonstopmode", "-halt-on-error", "-silent")


def typeset(source, parts, output):
    """Run latexmk on a source.

    Parameters
    ----------
    source : str or Path
        The main .tex file.
    parts : sequence of str or Path
        Generated files that it inputs by name.
    output : str or Path
        The PDF, replaced only by a clean one.

    Returns
    -------
    int
        Number of pages.

    Raises
    ------
    SignoriniError
        If LaTeX fails, or warns of an undefined reference or an overfull box: with its own first
        words on it.
    """
    with tempfile.TemporaryDirectory(prefix="signorini-") as folder:
        folder = Path(folder)
        for path in (source, *parts):
            shutil.copy(path, folder)
        pdf = folder / f"{Path(source).stem}.pdf"
        result = _latexmk(folder, f"{Path(source).stem}.tex")
        log = _log_of(pdf)
        trouble = _TROUBLE.search(log)
        if result.returncode or trouble or not pdf.is_file():
            raise SignoriniError(_complaint(source, trouble, result))
        with replacing(output, "wb") as stream:
            stream.write(pdf.read_bytes())
        return int(_PAGES.search(log.replace("\n", "")).group(1))


def _latexmk(folder, name):
    return subprocess.run(
        [*_LATEXMK, name],
        cwd=folder,
        env=os.environ | _ENVIRONMENT,
        capture_output=True,
        check=False,
    )


def _log_of(pdf):
    log = pdf.with_suffix(".log")
    return log.read_text(encoding="utf-8", errors="replace") if log.is_file() else ""


def _complaint(source, trouble, result):
    """What LaTeX says, or where it has no words, the end of what latexmk says."""
    last_words = result.stderr.decode(errors="replace").strip()[-300:]
    said = trouble.group(0) if trouble else last_words
    return (
        f"{source}: LaTeX: {said or 'failed without a message'}; "
        "mend the source or install what is missing"
    )
