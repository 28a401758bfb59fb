import shutil
from importlib.util import find_spec

import pytest
from project import Project

if not (find_spec("snakemake") and shutil.which("bash")):
    collect_ignore_glob = ["test_*.py"]


@pytest.fixture(scope="session")
def spied(tmp_path_factory):
    """Where the builds below say what their jobs imported."""
    return tmp_path_factory.mktemp("spied")


@pytest.fixture(scope="session")
def built_small(tmp_path_factory, spied):
    """The small scene, built; do not change it: `small` is a copy."""
    project = Project.fresh(tmp_path_factory.mktemp("small") / "project")
    project.write("config/scenes/broken.yaml", "{")  # a scene that is not asked for does no harm
    project.spied_build(spied / "small", PYTHONHASHSEED="0", LC_ALL="C.UTF-8", OMP_NUM_THREADS="2")
    return project


@pytest.fixture(scope="session")
def built_paper(tmp_path_factory, spied):
    """The paper's scene, built; do not change it: `paper` is a copy."""
    project = Project.fresh(tmp_path_factory.mktemp("paper") / "project", scenes=("paper",))
    project.spied_build(spied / "paper")
    return project


@pytest.fixture(scope="session")
def all_jobs(built_small, built_paper):
    """Scene -> a dry run of all its jobs, with what each reads and writes."""
    arguments = ["--dry-run", "--forceall", "--quiet", "host"]
    return {"small": built_small.build(*arguments), "paper": built_paper.build(*arguments)}


@pytest.fixture
def fresh(tmp_path):
    return Project.fresh(tmp_path / "project")


@pytest.fixture
def small(built_small, tmp_path):
    return built_small.copy(tmp_path / "project")


@pytest.fixture
def paper(built_paper, tmp_path):
    return built_paper.copy(tmp_path / "project")
