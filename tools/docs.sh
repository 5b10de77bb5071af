#!/usr/bin/env bash
# Builds the site into build/site/html, and checks its links, sizes, names and spelling. Takes the wheel in build/wheel if
# there is one, else compiles the package.
set -euo pipefail
cd "$(dirname "$0")/.."
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_QUIET=1 KINEGRAPH_HEADLESS=1
bash tools/apt_install.sh doxygen libegl1 libgl1-mesa-dri
environment=$PWD/build/docs_venv
[ -x "$environment/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$environment"
wheels=(build/wheel/*.whl)
[ -f "${wheels[0]}" ] || wheels=(.)
"$environment/bin/python" -m pip install --no-compile -r site/requirements.txt pyarrow "av==18.1.0"
"$environment/bin/python" -m pip install --force-reinstall --no-deps "${wheels[0]}"
"$environment/bin/python" -m pip install kinegraph
"$environment/bin/python" site/build.py build/site
"$environment/bin/python" site/checks.py build/site/html
"$environment/bin/codespell" README.md CHANGELOG.md CONTRIBUTING.md docs site examples/*.py
