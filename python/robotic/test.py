"""The module kinegraph.test under the reference's name."""

import sys

import kinegraph.test

sys.modules[__name__] = kinegraph.test
