"""Runs the command `kinegraph` as `python -m kinegraph`."""

import sys

from .cli import main

sys.exit(main())
