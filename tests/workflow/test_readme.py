"""The scenes that config/README.md writes from scratch are built as they stand, but for their
finest levels.
"""

import re

from project import ROOT, Project


def coarsened(text):
    """The same scene on its two coarsest levels, a reference four times as fine."""
    levels = [int(n) for n in re.search(r"^levels: \[(.*)\]", text, re.M)[1].split(",")][:2]
    text = re.sub(r"^levels: .*", f"levels: {levels}", text, flags=re.M)
    return re.sub(r"kind: reference, n: \d+", f"kind: reference, n: {4 * levels[-1]}", text)


def test_the_scenes_of_the_readme_are_built(tmp_path):
    blocks = re.findall(
        r"```yaml\n(.*?)```", (ROOT / "config/README.md").read_text(encoding="utf-8"), re.S
    )
    texts = [text for text in blocks if "levels" in text]
    names = [f"mine-{k}" for k, _ in enumerate(texts)]
    project = Project.fresh(tmp_path / "project", scenes=names)
    for name, text in zip(names, texts, strict=True):
        project.write(f"config/scenes/{name}.yaml", coarsened(text))
    project.build()
    built = project.results()
    assert len(names) >= 3
    for name, text in zip(names, texts, strict=True):
        assert (f"{name}/table.md" in built) == ("truth" in text)
        assert (f"{name}/figures/solution.pdf" in built) == ("truth" in text)
