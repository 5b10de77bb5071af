#!/usr/bin/env bash
# Loads every URDF file of the package example-robot-data and every MJCF file of robosuite, and compares the poses with
# Pinocchio and MuJoCo at random states. Installs all packages into build/models_venv. Arguments are passed to pytest:
# -k panda takes a sample.
set -euo pipefail
cd "$(dirname "$0")/.."
export KINEGRAPH_HEADLESS=1 PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_QUIET=1
venv=$PWD/build/models_venv
mkdir -p build
[ -x "$venv/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$venv"
"$venv/bin/python" -m pip install .
"$venv/bin/python" -m pip install pytest hypothesis pin==4.1.0 example-robot-data==6.0.0 mujoco==3.17.0
"$venv/bin/python" -m pip install --no-deps robosuite==1.5.2
"$venv/bin/python" -m pytest -q -m "robots or models" tests/python/scene/test_urdf.py tests/python/scene/test_mjcf.py "$@"
