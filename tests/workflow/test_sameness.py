"""The same question has the same answer, to the byte, wherever and however it is asked."""

from project import Project


def test_two_clean_builds_agree(built_small, tmp_path):
    """Another folder, with a space; other hashes, locale, time zone, cores and threads."""
    other = Project.fresh(tmp_path / "a folder")
    other.build(
        "--cores", "1", PYTHONHASHSEED="1", LC_ALL="C", TZ="Asia/Kathmandu", OMP_NUM_THREADS="1"
    )
    first, second = built_small.results(), other.results()
    assert first.keys() == second.keys()
    assert {name.rpartition(".")[2] for name in first} == {
        *("npz", "csv", "json", "tex", "md", "pdf", "png")
    }
    assert [name for name in first if first[name] != second[name]] == []
