"""`python -m kinegraph` is the command `kinegraph`."""

import sys

from .cli import main

sys.exit(main())
