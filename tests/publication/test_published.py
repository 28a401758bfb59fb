"""Tables of published numbers: what is read, and what is refused, with its line."""

from decimal import Decimal

import pytest

from signorini.exceptions import SceneError
from signorini.publication.published import Published, read_published

HEADER = "quantity,element,n,value,tolerance\n"


def written(tmp_path, text):
    path = tmp_path / "table.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_lines_are_counted_and_digits_kept(tmp_path):
    path = written(tmp_path, HEADER + "l2,CR,4,0.0230,1\n\nslope l2,CR,,2.10,0.5\n")
    assert read_published(path) == {
        2: Published("l2", "CR", "4", "0.0230", "1"),
        4: Published("slope l2", "CR", "", "2.10", "0.5"),
    }


@pytest.mark.parametrize(
    ("quantity", "n", "key", "cell"),
    [
        ("h1", "8", "h1, CR, 8", "h1 CR n=8"),
        ("slope h1", "", "slope, h1, CR", "h1 CR slope"),
        ("slope h1", "fit", "slope, h1, CR, fit", "h1 CR slope"),
        ("rate l2", "8", "rate, l2, CR, 8", "rate l2 CR n=8"),
        ("dofs", "8", "dofs, CR, 8", "dofs CR n=8"),
    ],
)
def test_a_number_has_the_key_of_the_computed_one(quantity, n, key, cell):
    number = Published(quantity, "CR", n, "1", "1")
    assert (number.key, number.cell) == (key, cell)


def test_the_unit_follows_the_digits():
    units = {"0.10": "0.01", "3": "1", "1.5e-3": "1e-4", "2.e2": "1e2"}
    for value, unit in units.items():
        assert Published("l2", "CR", "4", value, "1").unit == Decimal(unit)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 1: nothing; the header must be quantity,element,n,value,tolerance"),
        ("a,b\n", "line 1: a,b; the header must be"),
        (HEADER, "no number; add a line, such as l2,CR,64"),
        (HEADER + "l2,CR,4,0.1\n", "line 2: 4 fields instead of 5; write quantity,"),
        (HEADER + "l2,CR,4,0.1x,1\n", "line 2: value: '0.1x' is no number; write one as printed"),
        (HEADER + "l2,CR,4,nan,1\n", "line 2: value: 'nan' is no number"),
        (HEADER + "l2,CR,4,0.1,\n", "line 2: tolerance: '' is no number"),
        (HEADER + "l2,CR,4,0.1,-1\n", "line 2: tolerance: -1 is negative"),
        (HEADER + ",CR,4,0.1,1\n", "line 2: quantity: it is empty; name one"),
        (
            HEADER + "l2,CR,4,0.1,1\nh1,CR,4,0.1,1\nl2,CR,4,0.2,1\n",
            "line 2: l2 CR n=4 stands there 2 times, in lines 2, 4; keep one",
        ),
        ((HEADER + "l2,CR,4,0.1,1 \xb5\n").encode("latin-1"), "not UTF-8 text"),
    ],
)
def test_a_mistake_is_told_with_its_line(tmp_path, text, said):
    path = written(tmp_path, text)
    with pytest.raises(SceneError) as caught:
        read_published(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_table_saved_by_a_spreadsheet_is_read(tmp_path):
    """With a byte order mark and its line ends."""
    path = written(
        tmp_path, b"\xef\xbb\xbf" + (HEADER + "l2,CR,4,0.1,1\n").replace("\n", "\r\n").encode()
    )
    assert read_published(path) == {2: Published("l2", "CR", "4", "0.1", "1")}
