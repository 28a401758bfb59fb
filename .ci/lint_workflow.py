"""Run `snakemake --lint` and fail on what it finds, but for its wish that every rule has a conda
environment.

This project has no environment manager: requirements.txt says what every rule needs.
"""

import argparse
import subprocess
import sys

NOT_HERE = "Specify a conda environment or container for each rule."


def findings(text):
    """What Snakemake's report says, a line each: place and title."""
    place = ""
    for line in text.splitlines():
        if line.startswith("Lints for "):
            place = line.removeprefix("Lints for ")
        elif line.startswith("    * ") and NOT_HERE not in line:
            yield f"{place} {line.removeprefix('    * ').removesuffix(':')}"


def main():
    """Print the findings."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    result = subprocess.run(
        [sys.executable, "-m", "snakemake", "--lint"], capture_output=True, text=True
    )
    text = result.stdout + result.stderr
    if result.returncode and NOT_HERE not in text:
        sys.exit(text)
    found = list(findings(text))
    if found:
        sys.exit("\n".join(["snakemake --lint:", *found]))
    print("snakemake --lint: nothing found")


if __name__ == "__main__":
    main()
