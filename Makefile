# exactpt: `make demo` and `make test` work on a fresh Debian machine, and set up what they need.
#
# Everything is installed into .venv; the rest (compilers, CGAL) comes from Debian's packages.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/$(if $(filter Windows_NT,$(OS)),Scripts,bin)
PACKAGES := g++ cmake libcgal-dev nlohmann-json3-dev
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
DATE ?= $(shell date -u +%F)
SEED := $(subst -,,$(DATE))
MINUTES ?= 40
TOOLS ?= fuzz benchmarks .ci
LOWEST := $(VENV)/lowest
COMPILED_TESTS := $(wildcard $(addprefix tests/*/,kernel certificates motion planar pseudotriangulation tiling search simulation))
PYODIDE_TESTS := $(wildcard $(addprefix tests/*/,kernel geometry planar motion certificates tiling search arrays query))

# $(call install,BIN,WHAT): what may name dependency groups, which pip has known since 25.1
define install
@$(1)/python -m pip install --quiet --disable-pip-version-check 'pip>=25.1' 2>/dev/null || { echo "$(1)/python -m pip install 'pip>=25.1' failed, and dependency groups need it" >&2; exit 1; }
$(1)/python -m pip install --quiet --disable-pip-version-check $(2)
endef

.DEFAULT_GOAL := help
.PHONY: help demo test test-docs test-tools test-slow test-random test-lowest test-exact turn old-engine compiled-copy night night-tests test-browser browser try-browser test-pyodide compiled plain test-compiled coverage lint quick pictures accept docs package wheels publish lock check-cgal test-sanitized coq clean

help: ## what can be made
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 14

demo: $(VENV)/installed ## set up, run the packaged scene to its first contact, write an animation, check a proof
	@echo 'running the packaged scene'
	@$(BIN)/exactpt demo

test: $(VENV)/developing cgal_check/build/cgal_check lint ## set up (CGAL included), pass the tests of the package
	$(BIN)/python -m pytest -n $(JOBS) -m "not slow and not browser"

test-docs: $(VENV)/developing cgal_check/build/cgal_check ## the examples, commands, links and tables of all pages
	$(BIN)/python -m pytest -n $(JOBS) -m "not slow and not browser" docs

test-tools: $(VENV)/developing cgal_check/build/cgal_check ## the tests of the fuzz kit, the benchmarks and .ci; of some: TOOLS=fuzz
	$(BIN)/python -m pytest -n $(JOBS) -m "not slow and not browser" $(addsuffix /tests,$(TOOLS))

test-random: $(VENV)/developing ## the tests of tests/unit and tests/api on ten times as many random examples
	HYPOTHESIS_PROFILE=night $(BIN)/python -m pytest -n $(JOBS) tests/unit tests/api

turn: $(VENV)/developing cgal_check/build/cgal_check ## laws by the seed of the DATE; with BASE=main only new faults fail
	$(BIN)/python -m fuzz run --seed $(SEED) --seconds 120 $(if $(BASE),--on $(BASE))

test-slow: $(VENV)/developing cgal_check/build/cgal_check ## the same claims on thousands of scenes: an hour
	$(BIN)/python -m pytest -n $(JOBS) --dist loadgroup -m slow tests exactpt docs $(addsuffix /tests,$(TOOLS))

quick: $(VENV)/developing ## the tests that take milliseconds each: a minute on two cores
	$(BIN)/python -m pytest -n 2 --quick tests/unit tests/api tests/laws

test-lowest: $(LOWEST)/installed ## quick tests, examples and a minute of the laws, on the lowest versions that pyproject.toml allows
	$(LOWEST)/bin/python -m pytest -n $(JOBS) --quick --laws minute tests/unit tests/api tests/laws exactpt

test-exact: $(VENV)/developing ## the same tests with the float filters switched off
	$(BIN)/python -m pytest -n $(JOBS) --exact-only

test-browser: $(VENV)/developing ## the animation in a real browser (installs chromium)
	@.ci/apt-install chromium chromium-driver
	$(BIN)/python -m pytest -m browser tests docs

browser: $(VENV)/developing ## the page that runs exactpt in the browser, with its wheel, in dist/browser
	$(BIN)/python docs/make_page.py dist/browser

try-browser: $(VENV)/developing ## that page in a real browser (fetches Pyodide into .pyodide, 30 MB; needs npm)
	@.ci/apt-install chromium chromium-driver
	$(BIN)/python .ci/fetch_pyodide.py
	$(BIN)/python -m pytest -m browser docs/tests/test_page_in_chromium.py

test-pyodide: $(VENV)/developing ## the tests in Pyodide, in Node.js (fetches as try-browser does): 10 minutes
	$(BIN)/python .ci/fetch_pyodide.py
	for room in $(PYODIDE_TESTS); do node .ci/test_in_pyodide.mjs $$room || exit 1; done

compiled: $(VENV)/developing ## compile the hot rooms of this checkout (setup.py)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check 'setuptools>=77.0.3'
	$(BIN)/python setup.py --quiet build_ext --inplace
	test -s exactpt/compiled.txt  # not where the C compiler failed

plain: ## remove what `make compiled` made
	find exactpt -name '*.so' -delete
	rm -rf exactpt/compiled.txt build

test-compiled: compiled ## the quick tests of what is compiled, and a minute of the laws
	cd / && '$(CURDIR)/$(BIN)/exactpt' --version && '$(CURDIR)/$(BIN)/python' '$(CURDIR)/.ci/is_compiled.py'
	$(BIN)/python -m pytest -n $(JOBS) --quick --laws minute $(COMPILED_TESTS) tests/laws; status=$$?; $(MAKE) plain; exit $$status

old-engine: .old-engine/commit.txt ## the engine of version 0.2, a witness of the fuzzer, in .old-engine

.old-engine/commit.txt: $(VENV)/developing fuzz/old_engine/build.py
	$(BIN)/python -m pip install --quiet --disable-pip-version-check 'setuptools>=77.0.3'
	$(BIN)/python -m fuzz.old_engine

compiled-copy: $(VENV)/developing ## a compiled copy of this checkout in .compiled, for the law compiled/plain
	$(BIN)/python -m pip install --quiet --disable-pip-version-check 'setuptools>=77.0.3'
	$(BIN)/python -m fuzz.compiled_copy

night: $(VENV)/developing cgal_check/build/cgal_check old-engine compiled-copy ## what runs each night, by the seed of the DATE: the laws (half of the time for a seventh of them, that of the weekday), the fuzzer with all witnesses, the small scope, planted mistakes
	status=0; \
	$(BIN)/python -m fuzz run --seed $(SEED) --seconds $$((120 * $(MINUTES))) --weekday $$(date -d $(DATE) +%u) || status=1; \
	for what in '' '--witness old' 'small-scope --today'; do \
	    $(BIN)/python -m fuzz $$what --seed $(SEED) --minutes $(MINUTES) --jobs $(JOBS) || status=1; \
	done; \
	$(BIN)/python -m fuzz power || status=1; \
	exit $$status

night-tests: $(VENV)/developing cgal_check/build/cgal_check ## the other tests of each night: test-docs, test-tools, test-slow and test-random
	status=0; \
	for tests in test-docs test-tools test-slow test-random; do $(MAKE) $$tests || status=1; done; \
	exit $$status

coverage: $(VENV)/developing cgal_check/build/cgal_check ## branches covered by the tests
	$(BIN)/python -m pytest -n $(JOBS) -m "not slow and not browser" --cov=exactpt --cov-report=term:skip-covered

lint: $(VENV)/developing ## formatting, rules, types, imports, spelling, workflows
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/codespell
	$(BIN)/zizmor --offline --quiet .github/workflows
	$(BIN)/check-jsonschema --quiet --builtin-schema vendor.github-workflows $(wildcard .github/workflows/*.yml)

lock: $(VENV)/developing ## the versions that pip chooses today for development, in .ci/locked.txt
	$(BIN)/python -m pip install --quiet --dry-run --ignore-installed --report $(VENV)/report.json --editable . --group dev
	$(BIN)/python .ci/lock.py <$(VENV)/report.json >.ci/locked.txt

pictures: $(VENV)/developing ## draw the pictures of the README, the gallery and the examples anew
	$(BIN)/exactpt draw exactpt/data/demo.json --at contact -o docs/first-contact.svg
	$(BIN)/python docs/draw_demo.py
	$(BIN)/python docs/draw_proof.py
	$(BIN)/python docs/draw_gallery.py
	$(BIN)/python docs/draw_examples.py

accept: $(VENV)/developing ## write what is derived anew (tables, pictures, digests, event logs), show the difference
	$(BIN)/python docs/make_tables.py
	$(BIN)/python -m fuzz costs
	PYTHONPATH=. $(BIN)/python tests/system/testing/test_digests.py
	PYTHONPATH=. $(BIN)/python tests/api/simulation/test_golden.py
	$(MAKE) --no-print-directory pictures
	git diff --stat

docs: $(VENV)/developing ## the site, with tutorial, gallery, evidence and API, in site
	NO_MKDOCS_2_WARNING=1 PYTHONPATH=. $(BIN)/python -m mkdocs build --quiet

package: $(VENV)/developing ## build the wheel and the sdist in dist, and try them in an empty environment
	$(BIN)/python -m build
	$(BIN)/python -m pytest -m slow tests/campaign/packaging

wheels: $(VENV)/developing ## manylinux wheels and the sdist in dist, by cibuildwheel (needs Docker; on macOS and Windows theirs)
	$(call install,$(BIN),--editable . --group release)
	$(BIN)/python -m cibuildwheel --output-dir dist
	$(BIN)/python -m build --sdist

publish: $(BIN)/python ## upload dist with attestations; only where the package index trusts (.github/workflows/wheels.yml)
	$(call install,$(BIN),--group publish)
	$(BIN)/pypi-attestations sign dist/*
	$(BIN)/uv publish --trusted-publishing always dist/*

check-cgal: cgal_check/build/cgal_check ## build the independent witness

cgal_check/build/cgal_check: $(wildcard cgal_check/*.cpp cgal_check/*.hpp cgal_check/proof/*.cpp cgal_check/proof/*.hpp) cgal_check/CMakeLists.txt
	@.ci/apt-install $(PACKAGES)
	cmake -S cgal_check -B cgal_check/build -DCMAKE_BUILD_TYPE=Release $(CMAKEFLAGS)
	cmake --build cgal_check/build --parallel $(JOBS)

test-sanitized: $(VENV)/developing ## cgal_check with AddressSanitizer and UBSan: all documents of proofs, 10,000 damaged ones
	@.ci/apt-install $(PACKAGES)
	cmake -S cgal_check -B cgal_check/build/sanitized -DCMAKE_BUILD_TYPE=Release -DSANITIZE=ON
	cmake --build cgal_check/build/sanitized --parallel $(JOBS)
	EXACTPT_CGAL_CHECK='$(CURDIR)/cgal_check/build/sanitized/cgal_check' $(BIN)/python -m pytest -m cgal tests/unit/proof/test_conformance.py
	EXACTPT_CGAL_CHECK='$(CURDIR)/cgal_check/build/sanitized/cgal_check' $(BIN)/python -m fuzz proof-both --cases 10000

coq: ## check the theorem on certificates by Coq; print its axioms
	@.ci/apt-install coq libcoq-mathcomp-algebra-tactics
	mkdir -p build/coq && cp proofs/apart.v build/coq && cd build/coq && coqc -q -w none apart.v

$(BIN)/python:
	@.ci/apt-install --if-no-venv python3-venv
	@echo 'making an environment for Python in $(VENV)'
	@$(PYTHON) -m venv $(VENV)

$(VENV)/installed: $(BIN)/python pyproject.toml
	@echo 'installing exactpt and what it needs (gmpy2, numpy, click) into $(VENV)'
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

$(VENV)/developing: $(BIN)/python pyproject.toml
	$(call install,$(BIN),--editable . --group dev)
	@touch $@ $(VENV)/installed

$(LOWEST)/installed: $(VENV)/developing .ci/lowest.py
	rm -rf $(LOWEST)
	$(PYTHON) -m venv $(LOWEST)
	$(BIN)/python .ci/lowest.py >$(LOWEST)/constraints.txt
	$(call install,$(LOWEST)/bin,--constraint $(LOWEST)/constraints.txt --editable '.[bench]' --group test --group docs)
	@touch $@

clean: ## remove what was built (not .venv)
	rm -rf build dist .pyodide .old-engine .compiled cgal_check/build *.egg-info .mypy_cache .ruff_cache .pytest_cache .hypothesis
