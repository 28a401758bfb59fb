"""Bring what is generated of README.md, ARTIFACT.md, config/README.md and docs up to date, or check
that it is.

    python docs/update_readme.py [--check]

A block from `<!-- name -->` to `<!-- end of name -->` is generated; the pictures are copies of
built figures. Durations are those that `.ci/run` measured last, where it has run; a check lets them
be off by a factor of two.
"""

import argparse
import csv
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "src"))

import first_page  # noqa: E402 (the path above must come first)
import scene_pages  # noqa: E402
from keys import key_list  # noqa: E402

from signorini.exact import FAMILIES  # noqa: E402
from signorini.provenance.codecheck import codecheck_text  # noqa: E402
from signorini.scene.strict_yaml import load_yaml  # noqa: E402
from signorini.scene.validated import read_validated  # noqa: E402
from signorini.storage import read_csv  # noqa: E402

README, CONFIG_README = ROOT / "README.md", ROOT / "config/README.md"
ARTIFACT, CODECHECK = ROOT / "ARTIFACT.md", ROOT / "codecheck.yml"
PAPER = ROOT / "docs/paper.md"
PICTURES, RESULTS = ROOT / "docs/pictures", ROOT / "results/paper"
FIGURES = (*(RESULTS / f"figure_5_{k}.png" for k in (1, 2, 3)), ROOT / "results/gallery.png")
DURATIONS = ROOT / "results/durations.csv"
TIMED = ("paper", "test", "install")  # in the order of the text
SMALL = "--config quick=true"  # of a study
LEAST = 5  # seconds; shorter is told as this
NOISE = 2.0  # the factor between what README.md says and a measurement that a check lets pass
CHOICES = {
    "diagonal": "the other diagonal",
    "load": "the load integrated exactly",
    "norm": "the seminorm for the full norm",
    "quadrature": "the centroid rule for the norms",
}


def promises():
    """The block of README.md that tells what is special."""
    return {"promises": first_page.promises(verdict())}


def verdict():
    """What the check of the scene `paper` found."""
    return (RESULTS / "check.txt").read_text(encoding="utf-8")


def results():
    """Blocks of docs/paper.md, from the results of the scene `paper`."""
    table = (RESULTS / "table_5_1.md").read_text(encoding="utf-8")
    return {"table 5.1": table, "check": f"> {verdict()}", "choices": choices()}


def codecheck_file():
    """The file from which a codechecker starts, as bytes."""
    document = read_validated(RESULTS / "scene.json").document
    citation = load_yaml(ROOT / "CITATION.cff")
    folder = RESULTS.relative_to(ROOT).as_posix()
    return codecheck_text(document, read_csv(RESULTS / "check.csv"), citation, folder).encode()


def durations(measured):
    """What the commands of README.md take, in seconds by name, as Markdown."""
    paper, test, install = (about(measured[name]) for name in TIMED)
    return (
        f"On two cores, as continuous integration measured: `make paper` {paper}, "
        f"`make test` {test}, and before them\n"
        f"the installation {install}.\n"
    )


def about(seconds):
    """A duration in words: to 5 s below 90 s, else to a minute."""
    return (
        f"about {max(LEAST, 5 * round(seconds / 5))} s"
        if seconds < 90
        else f"about {round(seconds / 60)} min"
    )


def told(text):
    """The durations that a text tells, in seconds, in their order."""
    return [
        int(number) * (60 if unit == "min" else 1)
        for number, unit in re.findall(r"about (\d+) (s|min)\b", text)
    ]


def durations_block(current, check):
    """The block of durations: as it is where nothing was measured, or where a check finds it near
    enough.
    """
    if not DURATIONS.is_file():
        return current
    measured = seconds()
    pairs = list(zip(told(current), (max(LEAST, measured[name]) for name in TIMED), strict=False))
    near = len(pairs) == len(TIMED) and all(max(pair) <= NOISE * min(pair) for pair in pairs)
    return current if check and near else durations(measured)


def seconds():
    """Seconds by command, as `.ci/run` measured them last."""
    with open(DURATIONS, encoding="utf-8", newline="") as stream:
        return {row["command"]: float(row["seconds"]) for row in csv.DictReader(stream)}


def timed_claims(text, check):
    """A page with the durations of its claims as measured, of studies those of the small form; as
    it is where nothing was measured, or on a check: they hold for a machine.
    """
    if check or not DURATIONS.is_file():
        return text
    measured = seconds()
    return "".join(_timed(line, measured) for line in text.splitlines(keepends=True))


def _timed(line, measured):
    found = re.match(r"\| [^|]+ \| `([^`]+)` \|.*\| (about \d+ \w+|-) \|$", line)
    command = found and next((c for c in (found[1], f"{found[1]} {SMALL}") if c in measured), None)
    if command is None:
        return line
    return f"{line[: found.start(2)]}{about(measured[command])}{line[found.end(2) :]}"


def choices():
    """What changing one choice does to the table, as Markdown."""
    with open(RESULTS / "effects.csv", encoding="utf-8", newline="") as stream:
        change = {row["choice"]: float(row["change"]) for row in csv.DictReader(stream)}
    rows = "".join(f"| {text} | {100 * change[name]:.2g} % |\n" for name, text in CHOICES.items())
    return "| Instead | an entry of the table moves by up to |\n| :--- | ---: |\n" + rows


def keys():
    """Blocks of config/README.md, from the schemas and the scenes."""
    paths = sorted(
        (ROOT / "config/scenes").glob("*.yaml"), key=lambda path: (path.stem != "paper", path.stem)
    )
    scenes = {path.stem: load_yaml(path) for path in paths}
    rows = "".join(
        f"| `{name}` | {document.get('title', '')} |\n" for name, document in scenes.items()
    )
    schema, config = (
        load_yaml(ROOT / "workflow/schemas/config.schema.yaml"),
        load_yaml(ROOT / "config/config.yaml"),
    )
    return {
        "scenes": "| scene | what it is |\n| :--- | :--- |\n" + rows,
        "families": families(),
        "keys of config.yaml": key_list(schema, [config]),
        "keys of a scene": key_list(
            load_yaml(ROOT / "src/signorini/scene/schema.yaml"), scenes.values()
        ),
    }


def families():
    """The named exact solutions and their parameters, as Markdown."""
    rows = []
    for name, found in FAMILIES.items():
        parameters = ", ".join(
            f"`{key}` ({part.meaning}; {part.default:g})" for key, part in found.parameters.items()
        )
        rows.append(f"| `{name}` | {found.title} | {parameters} |\n")
    return (
        "| family | solution | parameters (meaning; default) |\n| :--- | :--- | :--- |\n"
        + "".join(rows)
    )


def block(path, name):
    """The text of a block as it is; ValueError unless it is there."""
    found = re.search(
        rf"<!-- {re.escape(name)} -->\n(.*?)<!-- end of", path.read_text(encoding="utf-8"), re.S
    )
    if not found:
        raise ValueError(f"{path.name}: no block '<!-- {name} -->'")
    return found[1]


def filled(path, texts):
    """A file with every block replaced, as bytes; ValueError unless each is there exactly once."""
    text = path.read_text(encoding="utf-8")
    for name, block in texts.items():
        pattern = rf"(<!-- {re.escape(name)} -->\n).*?(<!-- end of {re.escape(name)} -->\n)"
        text, count = re.subn(
            pattern, lambda found, block=block: found[1] + block + found[2], text, flags=re.S
        )
        if count != 1:
            raise ValueError(f"{path.name}: {count} blocks '<!-- {name} -->', expected 1")
    return text.encode()


def main():
    """Update the files, or name those that would change and fail."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--check", action="store_true", help="change nothing; fail if anything would change"
    )
    check = parser.parse_args().check
    try:
        measured = {"durations": durations_block(block(README, "durations"), check)}
        wanted = {
            README: filled(README, promises() | measured),
            ARTIFACT: timed_claims(filled(ARTIFACT, measured).decode(), check).encode(),
            CODECHECK: codecheck_file(),
            PAPER: filled(PAPER, results()),
            CONFIG_README: filled(CONFIG_README, keys()),
        }
        wanted |= {page: filled(page, texts) for page, texts in scene_pages.blocks().items()}
        wanted |= {PICTURES / figure.name: figure.read_bytes() for figure in FIGURES}
        wanted |= {
            PICTURES / name: figure.read_bytes() for name, figure in scene_pages.PICTURES.items()
        }
    except FileNotFoundError as error:
        sys.exit(f"error: {error.filename} is missing; run `make readme`")
    stale = [
        path
        for path, content in wanted.items()
        if not path.is_file() or path.read_bytes() != content
    ]
    names = ", ".join(str(path.relative_to(ROOT)) for path in stale)
    if check and stale:
        sys.exit(f"error: not as the build and the schemas make them: {names}; run `make readme`")
    PICTURES.mkdir(exist_ok=True)
    for path in stale:
        path.write_bytes(wanted[path])
    print(f"updated: {names}" if stale else "README.md, config/README.md and docs: up to date")


if __name__ == "__main__":
    main()
