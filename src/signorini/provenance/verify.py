"""Hold a folder of results against its record, and its numbers against published ones.

The folder may be anybody's. Nothing in it is executed or unpickled, no link is followed, and all
digests are taken anew.
"""

import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from signorini.exceptions import SignoriniError, StorageError
from signorini.provenance.build import COMPLETE, FORMAT
from signorini.provenance.folder import (
    RECORD,
    check_inside,
    digest_of,
    inside,
    is_result,
    is_sealed,
    parse_json,
    read_small,
    sealed_name,
    walk,
)
from signorini.wording import printable

REFUSED = "refused"
_SHA256 = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True)
class Finding:
    """What is not as it should be.

    Parameters
    ----------
    kind : str
        ``refused``, ``missing``, ``changed``, ``extra``, ``touched``, ``outdated``, ``failed``,
        ``not met`` or ``not checked``.
    path : str
        Below the folder that was checked.
    told : str
        What is wrong with it, in words; may be empty.
    """

    kind: str
    path: str
    told: str = ""

    def __str__(self):
        return printable(": ".join(filter(None, (self.kind, self.path, self.told))))


def read_record(folder, named=None):
    """The record of a folder of results, or of the folders around it.

    Parameters
    ----------
    folder : Path
    named : Path, optional
        The record to hold the folder against, in place of its own. A folder of a scene, with no
        record of its own, is then taken for the scene of its name.

    Returns
    -------
    record : dict
    below : str
        Where the folder is in that of the record; empty where it is the same.

    Raises
    ------
    StorageError
        If there is none, or it is not what `describe_build` makes.
    """
    if not folder.is_dir():
        raise StorageError(f"{folder}: not a folder; name one of results")
    folder = folder.resolve()
    for place in (folder, *folder.parents[:3]):
        if (place / RECORD).is_file():
            below = folder.relative_to(place).as_posix()
            return _parsed(named or place / RECORD), "" if below == "." else f"{below}/"
    if named:
        below = f"{folder.name}/" if (folder / "scene.json").is_file() else ""
        return _parsed(named), below
    raise StorageError(f"{folder}: no {RECORD} there or above; name one by --against")


def _parsed(path):
    record = parse_json(read_small(path), path)
    if not (isinstance(record, dict) and record.get("format") == FORMAT):
        raise StorageError(
            f"{path}: not a record of format {FORMAT}; `signorini provenance` makes one"
        )
    results, products = record.get("results"), record.get("products")
    if not (isinstance(results, str) and isinstance(products, dict)):
        raise StorageError(f"{path}: no products; `signorini provenance` writes them")
    for name, product in products.items():
        check_inside(name, path)
        digest = product.get("sha256") if isinstance(product, dict) else None
        if not (isinstance(digest, str) and _SHA256.fullmatch(digest)):
            raise StorageError(f"{path}: {name}: no SHA-256; `signorini provenance` writes it")
    if not _tells_a_run(record):
        raise StorageError(
            f"{path}: source, failed or jobs are not as `signorini provenance` writes them"
        )
    return record


def _tells_a_run(record):
    """Whether what a record tells of its run has the form of one; anybody may have written it."""
    jobs = record.get("jobs", [])
    return (
        isinstance(record.get("source", {}), dict)
        and _are_names(record.get("failed", []))
        and isinstance(jobs, list)
        and all(isinstance(job, dict) for job in jobs)
        and all(_are_names(job.get(key, [])) for job in jobs for key in ("outdated", "outputs"))
    )


def _are_names(found):
    return isinstance(found, list | dict) and all(isinstance(name, str) for name in found)


def check_files(folder, record, below=""):
    """Hold the files of a folder against the record.

    Parameters
    ----------
    folder : Path
    record : dict
        As `read_record` returns it.
    below : str, optional
        Where the folder is in that of the record, with a slash at its end.

    Returns
    -------
    list of Finding
    """
    start = f"{record['results']}/{below}"
    wanted = {
        path.removeprefix(start): product
        for path, product in record["products"].items()
        if path.startswith(start)
    }
    files, refused = walk(folder)
    found = [Finding(REFUSED, path, "a link, or no file; no number was read") for path in refused]
    there = {path for path in files if is_result(path)}
    found += [Finding("missing", path) for path in sorted(wanted.keys() - there - {*refused})]
    extra = sorted(there - wanted.keys() - _scenes_alone(there))
    found += [Finding("extra", path, "in no record") for path in extra]
    for path in sorted(there & wanted.keys()):
        found += _held(folder, path, wanted[path])
    found += [
        Finding("extra", path, "a digest of no file")
        for path in files
        if (sealed := sealed_name(path)) and sealed not in there and is_result(sealed)
    ]
    return found + _of_run(record, start)


def _scenes_alone(there):
    """Scenes that were read, not built: Snakemake writes them before any job, in a dry run too."""
    files = Counter(path.partition("/")[0] for path in there)
    return {f"{name}/scene.json" for name, count in files.items() if count == 1}


def _held(folder, path, product):
    """What is wrong with a file; one of another size is not read, however large it is."""
    size, wanted = (folder / path).lstat().st_size, product["sha256"]
    if size != product.get("bytes", size):
        return [Finding("changed", path, f"{size} bytes, not {product['bytes']}")]
    digest = digest_of(folder / path)
    if digest != wanted:
        return [Finding("changed", path, f"its SHA-256 is {digest[:12]}..., not {wanted[:12]}...")]
    if not is_sealed(folder / path, digest):
        return [Finding("changed", path, "the digest beside it is another")]
    told = "declared up to date by snakemake --touch, not made by its job"
    return [Finding("touched", path, told)] if product.get("touched") else []


def _of_run(record, start):
    """How the run ended, and what it left outdated."""
    failed = ", ".join(record.get("failed", [])) or "the run"
    ended_well = record.get("state") == COMPLETE
    found = [] if ended_well else [Finding("failed", failed, "did not end well")]
    for job in record.get("jobs", []):
        if inputs := ", ".join(job.get("outdated", [])):
            found += [
                Finding("outdated", path.removeprefix(start), f"made from another {inputs}")
                for path in job.get("outputs", [])
                if path.startswith(start)
            ]
    return found


def scenes_with_check(folder):
    """The folders of scenes in which published numbers were compared.

    Parameters
    ----------
    folder : Path
        Of a scene, or one that holds some.

    Returns
    -------
    list of Path
    """
    files, _ = walk(folder)
    checked = [Path(folder, path).parent for path in files if Path(path).name == "check.csv"]
    return [place for place in checked if (place / "scene.json").is_file()]


def check_numbers(folder, published=None, root="."):
    """Compare the tables of a scene's folder with published numbers, and with its own comparison.

    Parameters
    ----------
    folder : Path
        With scene.json, check.csv and the tables.
    published : path-like, optional
        A table of published numbers; by default the one that the scene names.
    root : path-like, optional
        Where that one is looked for; by default in this folder.

    Returns
    -------
    findings : list of Finding
    told : str
        What was found, in words.
    """
    try:
        rows, table = _compared(folder, published, root)
    except SignoriniError as error:
        return [Finding("not checked", str(folder), str(error))], ""
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        reason = f"scene.json has not the form of a scene ({type(error).__name__}: {error})"
        return [Finding("not checked", str(folder), reason)], ""
    found = [
        Finding("not met", row["cell"], f"published {row['published']}, computed {row['computed']}")
        for row in rows
        if not row["ok"]
    ]
    kept = [{key: str(value) for key, value in row.items()} for row in rows]
    if _check_of(folder) != kept:
        found.append(Finding("changed", f"{folder}/check.csv", "not what the tables give"))
    met = sum(row["ok"] for row in rows)
    return found, f"{folder}: {met} of {len(rows)} published numbers of {table} met"


def _compared(folder, published, root):
    from signorini.publication.compare import compare
    from signorini.publication.keys import declared_keys, table_of
    from signorini.publication.numbers import read_numbers
    from signorini.publication.published import read_published
    from signorini.scene.validated import read_validated

    read_small(folder / "scene.json")
    scene = read_validated(folder / "scene.json")
    table = published or _own_table(scene.document, root, folder / "scene.json")
    numbers = list(read_published(table).values())
    declared = declared_keys(scene.document)
    tables = dict.fromkeys(filter(None, (table_of(number.key, declared) for number in numbers)))
    _refuse_large(folder)
    return compare(numbers, read_numbers(scene, folder, tables)), table


def _own_table(document, root, source):
    """The table of published numbers that a scene names; a link, or a large one, is refused."""
    table = inside(root, document["publication"]["published"], source)
    read_small(table)
    return table


def _refuse_large(folder):
    """Refuse tables that are links, or too large to be parsed, before they are."""
    for path in sorted(folder.glob("*.csv")):
        read_small(path)


def _check_of(folder):
    from signorini.storage import read_csv

    return read_csv(folder / "check.csv")
