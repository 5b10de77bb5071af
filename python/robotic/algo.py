"""Functions on grids of values."""

from .pending import pending

_SHAPES = "Frame.setImplicitSurface converts a grid of values to a mesh"
box_filter = pending("algo.box_filter", "scipy.ndimage.uniform_filter does the same")
marching_cubes = pending("algo.marching_cubes", _SHAPES)
trilinear_interpolate = pending("algo.trilinear_interpolate", "scipy.interpolate.interpn does the same")
