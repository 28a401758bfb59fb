"""A file whose ending would say something else than what is in it is not written."""

import pytest

from signorini.commands.program import MISTAKE, main

WORDS = {
    ".html": (["viewer", "s.yaml"], ["gallery-page", "s.yaml", "--results", "r"]),
    ".json": (["check", "s.yaml"],),
    ".npz": (["solve", "s.yaml"], ["mesh", "s.yaml"], ["field", "m.npz", "u.npz"]),
    ".csv": (
        ["errors", "s.yaml"],
        ["rates", "s.yaml", "e.csv"],
        ["contact-line", "m.npz", "u.npz"],
    ),
    ".tex": (["macros", "s.yaml"],),
    ".pdf": (["typeset", "s.yaml", "f"],),
}


@pytest.mark.parametrize(
    ("words", "ending"), [(words, ending) for ending, each in WORDS.items() for words in each]
)
@pytest.mark.parametrize("name", ["v.txt", "x.yaml", "html", "json"])
def test_another_ending_is_refused_before_any_work(words, ending, name, capsys):
    with pytest.raises(SystemExit) as ended:
        main([*words, "-o", name])
    assert ended.value.code == MISTAKE
    told = capsys.readouterr().err
    assert f"argument -o/--output: '{name}': end it in {ending}; " in told
    assert told.count("\n") == 1
