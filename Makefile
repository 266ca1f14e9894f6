# Everything runs in .venv, made on first use with Python 3.11, 3.12 or 3.13: the first that is there, or the one that
# make install PYTHON=python3.13 names.
SHELL := /bin/bash
VENV  := .venv
BIN   := $(VENV)/bin
STAMP := $(VENV)/.installed
ARGS  ?=

.PHONY: demo serve test test-parts test-whole test-long pictures benchmark check install clean lock

demo: $(STAMP)   ## explore a simulated house, carry out one request while a person interferes, report
	$(BIN)/majordomo demo $(ARGS)

serve: $(STAMP)  ## start the service on the simulated flat and print the page's address
	$(BIN)/majordomo serve $(ARGS)

test: test-parts test-whole  ## all tests but the long ones

test-parts: $(STAMP)  ## each part by itself; COVERAGE=1 measures branch coverage, for a third more time
	$(BIN)/python -m pytest --numprocesses 3 --dist worksteal $(if $(COVERAGE),--cov --cov-report=term) tests/unit tests/property $(ARGS)

test-whole: $(STAMP)  ## parts together, in physics and from outside
	$(BIN)/python -m pytest --numprocesses 3 --dist worksteal tests/integration tests/acceptance $(ARGS)

test-long: $(STAMP)  ## the long drives and further variants that make test leaves out
	$(BIN)/python -m pytest --numprocesses 2 --dist worksteal -m long $(ARGS)

pictures: $(STAMP)   ## the pictures of the page in docs, of a run in a simulated house; needs chromium
	$(BIN)/python -m pytest -m long tests/acceptance/page/test_tour.py --pictures docs $(ARGS)

benchmark: $(STAMP)  ## measurements of speed, for a machine that does nothing else meanwhile
	$(BIN)/python -m pytest -m benchmark -s tests/benchmarks tests/unit/planner $(ARGS)

check: $(STAMP)  ## lint, format, types, import contracts
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

install: $(STAMP)

$(STAMP): constraints.txt pyproject.toml
	@scripts/make_venv $(VENV)
	$(BIN)/python -m pip install --quiet --require-hashes --no-deps --requirement constraints.txt
	$(BIN)/python -m pip install --quiet --no-build-isolation --no-deps --editable .
	@touch $@

lock:            ## renew constraints.txt from pyproject.toml, for all three Pythons and every system at once
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --extra dev --generate-hashes --no-header \
		--output-file constraints.txt pyproject.toml

clean:
	rm -rf $(VENV) build .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
