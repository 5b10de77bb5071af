"""The name under which the tutorials import the package: `from robotic import ry` or `import robotic as ry`."""

import sys as _sys

import kinegraph
from kinegraph import *  # noqa: F403
from kinegraph import __version__ as __version__
from kinegraph import test as test

ry = kinegraph

_sys.modules[__name__ + ".ry"] = ry
_sys.modules[__name__ + ".test"] = test
