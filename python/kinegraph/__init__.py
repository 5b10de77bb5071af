"""Kinegraph: robot scenes, differentiable features, inverse kinematics and k-order motion optimisation.

    import kinegraph as ry
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.view()

The package `robotic` hands on the same names: `from robotic import ry` and `import robotic as ry` work as well.
Lengths are in m, angles in rad, quaternions (w, x, y, z), poses (x, y, z, qw, qx, qy, qz).
"""

from . import model_paths as _model_paths
from . import test
from ._core import (
    FS,
    JT,
    KOMO,
    NLP,
    OT,
    ST,
    SY,
    CameraView,
    CameraViewSensor,
    Config,
    ConfigurationViewer,
    Feature,
    Frame,
    NLP_Factory,
    NLP_Solver,
    NLP_SolverOptions,
    OptMethod,
    SolverReturn,
    __version__,
    checkFile,
    depthImage2PointCloud,
)
from .errors import (
    ArgumentError,
    Error,
    FileError,
    FrameDeleted,
    FrameNotFound,
    KinegraphWarning,
    NotFound,
    ParseError,
)
from .model_paths import raiPath, setRaiPath
from .parameters import (
    clear_params,
    get_params,
    params_add,
    params_clear,
    params_file,
    params_get,
    params_print,
    rnd_seed,
    rnd_seed_random,
    set_params,
)

_model_paths.announce()


def version() -> str:
    """The version of this package."""
    return __version__


def compiled() -> str:
    """One line about the build."""
    return f"kinegraph {__version__}"


__all__ = [name for name in dir() if not name.startswith("_") and name not in ("model_paths", "errors", "parameters")]
