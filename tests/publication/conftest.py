import pytest
from articles import Project


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A project, the working folder."""
    project = Project(tmp_path / "project")
    monkeypatch.chdir(project.folder)
    return project
