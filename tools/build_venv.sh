#!/usr/bin/env bash
# Creates or updates build/tools_venv, in which the package is built without isolation: a second build finds the same
# folders, and compiles only what has changed. PYTHON is the interpreter.
set -euo pipefail
cd "$(dirname "$0")/.."
tools=build/tools_venv
[ -x "$tools/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$tools"
"$tools/bin/python" tools/build_requirements.py >build/requirements.txt
"$tools/bin/python" -m pip install --quiet --disable-pip-version-check -r build/requirements.txt \
  "cmake>=3.25,<4.4" "ninja>=1.11"
