# make demo           installs into .venv and runs the demo
# make test           installs the requirements of the tests, and runs all tests
# make docs           builds the site: build/site/html/index.html (make docs-serve: at http://localhost:8000)
# make test-models    reads every robot of two large collections and compares with Pinocchio and MuJoCo (2 GB, minutes)
# make test-ros       makes an environment with rclpy in build/ros, and tests the connection to ROS 2
# make test-franka    installs franky-sim into build/franka_venv (.7 GB), and tests the driver of the FR3 with it
# make test-lerobot   installs lerobot into build/lerobot_venv (8 GB), and tests data sets, plugins and environments with it
# make tidy           runs clang-tidy on the library; ARGS="src/kinegraph/komo" takes some rooms
# make nightly        runs tests, Clang, sanitizers, fuzzers and benchmarks, and writes docs/results/VERSION.md (hours);
#                     ARGS=--quick takes a small sample of each
# make release        makes and checks sdist, wheels, the C++ package and checksums in dist/ (docs/releases.md);
#                     ARGS="--python python3.12 --dirty" takes other interpreters, and an untagged commit
# make check-macos    compiles all sources for macOS on ARM, with the compiler of the package ziglang (never run as a whole)
# PYTHON=...          the Python to use (3.11 or newer)

PYTHON ?= python3
VENV := .venv

.PHONY: check-macos demo install test docs docs-serve test-models test-ros test-lerobot test-franka tidy nightly release clean

demo: install
	$(VENV)/bin/kinegraph demo $(ARGS)

install: $(VENV)/bin/python
	PYTHON="$(PYTHON)" bash tools/install.sh $(VENV)

test:
	PYTHON="$(PYTHON)" bash tools/test.sh

docs:
	PYTHON="$(PYTHON)" bash tools/docs.sh

docs-serve: docs
	$(PYTHON) -m http.server --directory build/site/html 8000

test-models:
	PYTHON="$(PYTHON)" bash tools/test_models.sh $(ARGS)

test-ros:
	PYTHON="$(PYTHON)" bash tools/test_ros.sh $(ARGS)

test-lerobot:
	PYTHON="$(PYTHON)" bash tools/test_lerobot.sh $(ARGS)

test-franka:
	PYTHON="$(PYTHON)" bash tools/test_franka.sh $(ARGS)

tidy:
	PYTHON="$(PYTHON)" bash tools/tidy.sh $(ARGS)

nightly:
	PYTHON="$(PYTHON)" bash tools/nightly.sh $(ARGS)

release:
	PYTHON="$(PYTHON)" bash tools/release.sh $(ARGS)

check-macos:
	PYTHON="$(PYTHON)" bash tools/check_macos.sh

$(VENV)/bin/python:
	bash tools/make_venv.sh "$(PYTHON)" $(VENV)

clean:
	rm -rf build $(VENV)
