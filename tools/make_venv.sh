#!/usr/bin/env bash
# Creates a virtual environment: make_venv.sh PYTHON FOLDER. Debian has venv and the headers of Python in separate
# packages, which are installed if they are missing.
set -euo pipefail
python=$1 folder=$2
here=$(dirname "$0")

"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Python 3.11 or newer is needed; $python is older." >&2; exit 1; }
"$python" -c 'import ensurepip, venv' 2>/dev/null || bash "$here/apt_install.sh" python3-venv
"$python" -c 'import os, sys, sysconfig; sys.exit(not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")))' ||
  bash "$here/apt_install.sh" python3-dev
"$python" -m venv "$folder"
