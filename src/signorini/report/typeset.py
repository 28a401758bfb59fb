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
        name = Path(source).stem
        # A fixed date makes the same input the same PDF.
        environment = os.environ | {
            "SOURCE_DATE_EPOCH": "1167609600",
            "FORCE_SOURCE_DATE": "1",
            "max_print_line": "1000",
        }
        command = [
            "latexmk",
            "-norc",
            "-pdf",
            "-interaction=nonstopmode",
            "-halt-on-error",
            "-silent",
            f"{name}.tex",
        ]
        result = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, check=False
        )
        log = folder / f"{name}.log"
        text = log.read_text(encoding="utf-8", errors="replace") if log.is_file() else ""
        trouble = _TROUBLE.search(text)
        if result.returncode or trouble or not (folder / f"{name}.pdf").is_file():
            said = (
                trouble.group(0)
                if trouble
                else result.stderr.decode(errors="replace").strip()[-300:]
            )
            raise SignoriniError(
                f"{source}: LaTeX: {said or 'failed without a message'}; mend the source or install what is missing"
            )
        with replacing(output, "wb") as stream:
            stream.write((folder / f"{name}.pdf").read_bytes())
        return int(_PAGES.search(text.replace("\n", "")).group(1))
