# make demo    installs into .venv and runs the main job
# make test    installs what the tests need, and runs everything
# make test-models   reads every robot of two large collections and compares with Pinocchio and MuJoCo (2 GB, minutes)
# PYTHON=...   the Python to use (3.11 or newer)

PYTHON ?= python3
VENV := .venv

.PHONY: demo install test test-models clean

demo: install
	$(VENV)/bin/kinegraph demo $(ARGS)

install: $(VENV)/bin/python
	$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check .

test:
	PYTHON="$(PYTHON)" bash tools/test.sh

test-models:
	PYTHON="$(PYTHON)" bash tools/test_models.sh $(ARGS)

$(VENV)/bin/python:
	bash tools/make_venv.sh "$(PYTHON)" $(VENV)

clean:
	rm -rf build $(VENV)
