"""Table 5.1 as the paper prints it."""

import csv
from pathlib import Path

_FILE = Path(__file__).parent / "data/table_5_1.csv"
PRINTED = list(csv.DictReader(_FILE.read_text().splitlines()))
COLUMNS = {  # of the file: norm and element
    "l2_cf": ("l2", "P1"),
    "l2_ncf": ("l2", "CR"),
    "h1_cf": ("h1", "P1"),
    "h1_ncf": ("h1", "CR"),
}
