# `make` lists the targets. Each prepares a virtual environment in .venv by itself; nothing else is installed. One that is
# there already, of the same Python, is kept with what else is in it.

PYTHON ?= python3
CORES ?= 2

run := .venv/bin/python -m
# An unpacked artifact installs from its own wheels, without a network.
offline := $(if $(wildcard wheels),--no-index --find-links wheels)

.PHONY: help paper test lint docs petsc readme examples studies artifact requirements clean distclean
.NOTPARALLEL:

help:
	@echo 'make paper         build every table and figure of the paper, check them, and typeset results/paper/paper.pdf'
	@echo 'make test          run all tests'
	@echo 'make lint          check format, style and types of Python, and Snakemake files'
	@echo 'make docs          build the documentation site, build/site/index.html'
	@echo 'make petsc         install what solver.method petsc needs, on Debian or Ubuntu as root; about a minute'
	@echo 'make readme        build all scenes, then bring what README.md and config/README.md show up to date'
	@echo 'make examples      run the examples, draw their pictures and write docs/examples.md'
	@echo 'make studies       run the six studies, up to an hour, and keep what they measured in docs/studies'
	@echo 'make artifact      pack sources, wheels and results of the paper in build/artifact, to build it offline'
	@echo 'make requirements  write requirements.txt anew, with the newest versions (Python 3.11)'
	@echo 'make clean         delete results/'
	@echo 'make distclean     delete all that is not in the repository: results/, .venv/ and caches'
	@echo 'Variables: PYTHON=$(PYTHON) (3.11 or later), CORES=$(CORES)'

paper: .venv/ready
	$(run) snakemake --cores $(CORES)

test: .venv/ready
	PATH="$$PWD/.venv/bin:$$PATH" $(run) pytest --numprocesses $(CORES) --dist loadfile --no-loadscope-reorder

lint: .venv/ready
	$(run) ruff check .
	$(run) ruff format --check .
	$(run) mypy
	$(run) snakefmt --check Snakefile workflow
	.venv/bin/python .ci/lint_workflow.py

docs: .venv/docs
	$(run) sphinx -W --keep-going --quiet --builder html --conf-dir docs . build/site
	@echo 'build/site/index.html'

petsc: .venv/ready
	.ci/install_petsc .venv/bin/python

readme: paper
	$(run) snakemake --cores $(CORES) all_scenes
	.venv/bin/python docs/update_readme.py

examples: .venv/ready
	.venv/bin/python docs/draw_examples.py

studies: .venv/ready
	$(run) snakemake --cores $(CORES) sensitivity theory adaptive guaranteed benchmark stability
	.venv/bin/python docs/keep_studies.py

artifact: paper
	.venv/bin/python .ci/make_artifact.py

requirements:
	"$(PYTHON)" .ci/pin_requirements.py

.venv/ready: requirements.txt
	@command -v "$(PYTHON)" >/dev/null || { echo 'error: $(PYTHON) not found; install Python 3.11 or later, or name one: make PYTHON=/path/to/python3.11' >&2; exit 1; }
	@"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "error: $(PYTHON) is $$("$(PYTHON)" --version 2>&1), too old; Python 3.11 or later is needed: make PYTHON=/path/to/python3.11" >&2; exit 1; }
	@"$(PYTHON)" -c 'import venv, ensurepip' 2>/dev/null || { echo 'error: $(PYTHON) has no venv; on Debian: apt-get install python3-venv' >&2; exit 1; }
	@[ ! -d wheels ] || ls wheels | grep -q -e "-cp$$("$(PYTHON)" -c 'import sys; print("%d%d" % sys.version_info[:2])')-cp" || { echo "error: wheels/ is not of $$("$(PYTHON)" --version 2>&1); name the Python of its files: make PYTHON=/path/to/python, or delete wheels/ to install from the network" >&2; exit 1; }
	@echo 'Installing requirements.txt into .venv, once; this takes about a minute.'
	@[ "$$(.venv/bin/python --version 2>&1)" = "$$("$(PYTHON)" --version 2>&1)" ] || "$(PYTHON)" -m venv --clear .venv
	@$(run) pip install --quiet --disable-pip-version-check --use-pep517 $(offline) --requirement requirements.txt
	@touch .venv/ready

.venv/docs: .venv/ready requirements-docs.txt
	@$(run) pip install --quiet --disable-pip-version-check --requirement requirements-docs.txt
	@touch .venv/docs

clean:
	rm -rf results

distclean: clean
	rm -rf .venv .snakemake .pytest_cache .ruff_cache .hypothesis build src/*.egg-info
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
