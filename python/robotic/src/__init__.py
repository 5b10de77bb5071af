"""Helper modules under their names of 0.3.x; the same as in robotic.tools."""

from .. import tools as _tools

__path__ = _tools.__path__  # `from robotic.src.h5_helper import H5Reader` finds robotic/tools/h5_helper.py
