"""The module kinegraph.test under the name that the reference gives it."""

import sys

import kinegraph.test

sys.modules[__name__] = kinegraph.test
