# `make` alone lists the targets. Each one sets up what it needs in .venv first. COURSE_FILE=path
# takes another course than course.toml: make hands it on to every command.

ifeq ($(OS),Windows_NT)
PYTHON ?= python
PY := .venv/Scripts/python.exe
else
PYTHON ?= python3
PY := .venv/bin/python
endif

PIP := $(PY) -m pip --quiet --disable-pip-version-check
CORE := .venv/core-is-installed
DEV := .venv/dev-is-installed
SITE := .venv/site-is-installed
NOTEBOOKS := .venv/notebooks-is-installed
WHERE ?= starter
ENGINE ?= docker
# Of a package with a plugin that pytest finds by itself, it rewrites every file, in each process.
PLUGINS := --disable-plugin-autoload -p xdist.plugin -p grader.checks.pytest_plugin

LOCK := $(PY) -m uv pip compile pyproject.toml --group build --quiet --upgrade --universal \
	--python-version 3.11 --generate-hashes --no-header --no-emit-index-url

define CHECK_PYTHON
import sys
if sys.version_info < (3, 11):
    sys.exit("The kit needs Python 3.11 or newer, but $(PYTHON) is %d.%d. "
             "Name a newer one: make PYTHON=python3.12" % sys.version_info[:2])
try:
    import ensurepip, venv
except ImportError:
    sys.exit("$(PYTHON) cannot make a virtual environment: its venv module is missing. "
             "On Debian and Ubuntu, install the package python3-venv.")
endef
export CHECK_PYTHON

# Debian's and Ubuntu's 3.11.0rc1 is no full version below 3.15 to their pip, but its Python is.
define PLAIN_VERSIONS
import re, sys
from pathlib import Path
for path in map(Path, sys.argv[1:]):
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"python_full_version (<|>=) '(\d+\.\d+)'", r"python_version \1 '\2'", text)
    path.write_text(text, encoding="utf-8", newline="\n")
endef
export PLAIN_VERSIONS

# A word of the call that no target knows would be passed over in silence.
KNOWN := PYTHON ENGINE WHERE COURSE COURSE_FILE SUBMISSION SUBMISSIONS RESULTS CLASS SEED FRESH QUICK CFFI
$(foreach each,$(.VARIABLES),$(if $(filter command,$(firstword $(origin $(each)))),\
	$(if $(filter $(each),$(KNOWN)),,$(error make knows no $(each)=; it knows $(KNOWN)))))
ifneq ($(and $(SUBMISSION),$(SUBMISSIONS)),)
$(error SUBMISSION is one and SUBMISSIONS a class of them: name one of the two)
endif
ifneq ($(and $(CLASS),$(SUBMISSION)$(SUBMISSIONS)),)
$(error CLASS remembers its submissions: name CLASS alone)
endif
NEEDED_BY_contained := SUBMISSIONS
NEEDED_BY_course := COURSE
NEEDED_BY_dashboard := RESULTS
$(foreach goal,$(MAKECMDGOALS),$(foreach each,$(NEEDED_BY_$(goal)),\
	$(if $($(each)),,$(error make $(goal) needs $(each)=folder))))
# Exit status 1 says of a grade that points are missing, and of a check what it found: no error of make.
FOUND := || test $$? -eq 1

.PHONY: help setup grade contained run dials accuracy effects cases compiled wheels films handouts \
	release tab dashboard gradescope course course-check notebooks verify mutants sync test soak lint format bench lock clean venv

help:
	@awk 'BEGIN { FS = ":.*## " } \
		/^##@ / { printf "\n%s\n", substr($$0, 5) } \
		/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' Makefile

##@ Grading

setup: $(CORE) ## Set up .venv for grading

grade: $(CORE) ## Grade SUBMISSION=path, SUBMISSIONS=folder or CLASS=folder of a class; alone, a demonstration
	@$(PY) -m grader $(if $(CLASS),class grade "$(CLASS)",grade) \
		$(if $(SUBMISSIONS),--class "$(SUBMISSIONS)",$(if $(SUBMISSION),"$(SUBMISSION)")) $(FOUND)

contained: ## Grade SUBMISSIONS=folder in a container, by ENGINE=docker or podman (SEED=number)
	@test -d "$(SUBMISSIONS)" || { echo 'SUBMISSIONS="$(SUBMISSIONS)" is no folder of submissions.'; exit 2; }
	@$(ENGINE) build --tag physics-grader --file Containerfile .
	@submissions=$$(cd "$(SUBMISSIONS)" && pwd) && results="$(or $(RESULTS),$$submissions-results)" && \
	mkdir -p "$$(dirname "$$results")" && beside=$$(cd "$$(dirname "$$results")" && pwd) && \
	$(ENGINE) run --rm --network none --read-only --tmpfs /tmp:size=1g --pids-limit 1024 \
		--volume "$$submissions:/instructor/submissions:ro" \
		--volume "$$beside:/instructor/beside" \
		$(if $(COURSE_FILE),--volume "$$(realpath "$(COURSE_FILE)"):/instructor/kit/course.toml:ro") \
		physics-grader --out "/instructor/beside/$$(basename "$$results")" $(if $(SEED),--seed $(SEED))

dashboard: $(CORE) ## Make a page of a graded class: RESULTS=folder
	@$(PY) -m grader dashboard "$(RESULTS)"

gradescope: $(CORE) ## Make build/gradescope/autograder.zip
	@$(PY) -m grader gradescope

run: $(CORE) ## Open the mini engine's window; the complete one with WHERE=solution
	@cd $(WHERE) && ../$(PY) -m mini_engine

##@ The engines, measured

dials: $(CORE) ## Open the window with dials: any scene in every engine
	@cd $(WHERE) && PYTHONPATH=../solution ../$(PY) -m experiments.dials

accuracy: $(DEV) ## What accuracy costs in time: tables and figures (some minutes; QUICK=1 for less)
	@cd solution && ../$(PY) accuracy.py --out ../build/accuracy $(if $(QUICK),--quick)

effects: $(DEV) ## What each effect costs, and what B1 and B3 save (QUICK=1 for less)
	@cd solution && ../$(PY) -m experiments.effects --out ../build/effects $(if $(QUICK),--quick)

cases: $(CORE) ## The leaderboard: every engine on every row (QUICK=1 for less)
	@cd solution && ../$(PY) -m experiments.leaderboard $(if $(QUICK),--quick)

compiled: $(DEV) ## Compile the stable engine: the same bits, several times faster
	@cd solution && ../$(PY) -m experiments.compiled --out ../build/compiled

wheels: $(DEV) ## Make a wheel of it for this system, and try it; the workflow of that name makes all
	@cd solution && ../$(PY) -m experiments.compiled --project ../build/wheels/sources
	@$(PY) -m pip wheel --quiet --no-deps --no-build-isolation -w build/wheels build/wheels/sources
	@$(PYTHON) -m venv --clear build/wheels/trial
	@build/wheels/trial/$(notdir $(patsubst %/,%,$(dir $(PY))))/python -m pip install --quiet \
		--disable-pip-version-check --only-binary :all: build/wheels/stable_compiled-*.whl
	@build/wheels/trial/$(notdir $(patsubst %/,%,$(dir $(PY))))/python \
		build/wheels/sources/trial/falls.py
	@ls build/wheels/*.whl

##@ Handing out

release: $(CORE) ## Make what students get, in build/release
	@$(PY) -m grader release $(if $(FRESH),--fresh) $(if $(CFFI),--cffi "$(CFFI)")

tab: $(CORE) ## Make the lab as a page for a browser tab, in build/tab (CFFI=wheel for pymunk)
	@$(PY) -m grader tab $(if $(CFFI),--cffi "$(CFFI)")

films: $(CORE) ## Record the films of the handouts anew, once an engine has changed
	@$(PY) handouts/make_films.py

handouts: $(SITE) ## Make the handouts as web pages in build/handouts
	@$(PY) handouts/make_hints.py
	@$(PY) handouts/make_systems.py
	@$(PY) handouts/make_site.py

course-check: $(CORE) ## Check the course file, COURSE_FILE=path, and try its release
	@$(PY) -m grader course-check $(FOUND)

course: $(NOTEBOOKS) ## Make an nbgrader course in COURSE=folder
	@$(PY) -m grader nbgrader course "$(COURSE)"

notebooks: $(NOTEBOOKS) ## Renew the starter's notebooks with nbgrader
	@$(PY) -m grader nbgrader release

##@ Looking after the kit

verify: $(CORE) ## Prove all marks of the bank, those already proven only with FRESH=1
	@$(PY) -m grader verify $(if $(FRESH),--fresh)

mutants: $(CORE) ## Change the solution in small ways, and see whether the checks notice
	@$(PY) -m grader mutants

sync: $(CORE) ## Carry the solution's given code over into the starter
	@$(PY) -m grader sync

test: $(DEV) ## Run the test suite, with some of the bank; verify and soak have the rest
	@$(PY) -m pytest tests $(PLUGINS) -n 2 --dist loadfile -rs

soak: $(SITE) $(NOTEBOOKS) compiled ## Run the long tests that `make test` leaves out
	@$(PY) -m pytest tests/stable_engine -m "soak and compiled" $(PLUGINS) -p compiled_engine -n 2 -q
	@$(PY) -m pytest tests -m "soak and not compiled" $(PLUGINS) -n 2 --dist loadfile -rs

lint: $(DEV) ## Check style and types
	$(PY) -m ruff check
	$(PY) -m ruff format --check
	$(PY) -m mypy

format: $(DEV) ## Mend what ruff can mend
	$(PY) -m ruff check --fix
	$(PY) -m ruff format

bench: $(CORE) ## Measure how fast the grader is
	@$(PY) -m grader bench

lock: $(DEV) ## Renew the locked requirement files from pyproject.toml
	$(LOCK) -o requirements.txt
	$(LOCK) -o requirements-archives.txt --extra archives -c requirements.txt
	$(LOCK) -o requirements-canvas.txt --extra canvas -c requirements.txt
	$(LOCK) -o requirements-notebooks.txt --extra notebooks -c requirements.txt
	$(LOCK) -o requirements-site.txt --extra site -c requirements.txt
	$(LOCK) -o requirements-dev.txt --extra dev --extra plots --extra cluster --extra canvas -c requirements.txt
	@$(PY) -c "$$PLAIN_VERSIONS" requirements*.txt

clean: ## Remove .venv and everything else that can be made again
	rm -rf .venv build solution/build starter/build dist *.egg-info .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -prune -exec rm -rf {} +

# ---------------------------------------------------------------- setting up

# A .venv that was not finished, or whose Python is gone, is made anew.
$(CORE): $(shell test -x $(PY) && test -e $(CORE) || echo venv)

venv:
	@command -v $(firstword $(PYTHON)) >/dev/null || { \
		echo "There is no $(PYTHON) here. Install Python 3.11 or newer, or name yours:" \
			"make PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c "$$CHECK_PYTHON"
	@echo "Making .venv with $(PYTHON) ..."
	@$(PYTHON) -m venv --clear .venv

$(CORE): requirements-archives.txt pyproject.toml
	@echo "Installing what grading needs into .venv (less than a minute) ..."
	@$(PIP) install --no-compile --require-hashes -r requirements-archives.txt
	@$(PIP) install --no-deps --no-build-isolation --editable .
	@$(PY) -m compileall -qq -j 0 .venv grader || true # on all cores, where pip would take one
	@touch $@

$(DEV): $(CORE) requirements-dev.txt
	@echo "Installing what tests and style checks need into .venv (less than a minute) ..."
	@$(PIP) install --no-compile --require-hashes -r requirements-dev.txt
	@touch $@

$(SITE): $(CORE) requirements-site.txt
	@echo "Installing what web pages need into .venv (less than a minute) ..."
	@$(PIP) install --require-hashes -r requirements-site.txt
	@touch $@

$(NOTEBOOKS): $(CORE) requirements-notebooks.txt
	@echo "Installing what notebooks need into .venv (a minute or two) ..."
	@$(PIP) install --require-hashes -r requirements-notebooks.txt
	@touch $@
