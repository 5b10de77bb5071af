"""Kinegraph: robot scenes, differentiable features, inverse kinematics and k-order motion optimization.

    import kinegraph as ry
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    C.view()

The package `robotic` has the same names, for scripts written for the reference: `import robotic as ry`.
Lengths are in m, angles in rad, quaternions (w, x, y, z), poses (x, y, z, qw, qx, qy, qz).
"""

import sys as _sys
from importlib import import_module as _import_module
from typing import TYPE_CHECKING as _TYPE_CHECKING
from typing import Any as _Any

from . import model_paths as _model_paths
from ._core import (
    FS,
    JT,
    KOMO,
    NLP,
    OT,
    ST,
    SY,
    BotOp,
    BSpline,
    CameraCalibration,
    CameraView,
    CameraViewSensor,
    CellState,
    CommandLog,
    Config,
    ConfigurationViewer,
    ControlMode,
    DepthView,
    DiffIk,
    DiffIkStatus,
    Domain,
    Feature,
    Frame,
    FrameView,
    Gamepad,
    GripperCommand,
    GripperInfo,
    GripperState,
    Hit,
    IkOptions,
    IkResult,
    IkResults,
    IkStatus,
    ImageViewer,
    KinematicDriver,
    LGP_TAMP_Abstraction,
    LGP_Tool,
    LgpStatus,
    LogicProblem,
    LoopMode,
    MotionConstraint,
    MotionContact,
    MotionPlan,
    MotionPlans,
    Mpc,
    MpcResult,
    NextView,
    NLP_Factory,
    NLP_Sampler,
    NLP_Solver,
    NLP_SolverOptions,
    OccupancyMap,
    OptMethod,
    PathContact,
    PathReturn,
    PlanSearch,
    PlanSearchStatus,
    PlanStatus,
    RecordedDriver,
    RetimeStatus,
    Roadmap,
    RoadmapPath,
    RobotCommand,
    RobotDriver,
    RobotInfo,
    RobotState,
    RRT_PathFinder,
    SampledTrajectory,
    SceneObserver,
    SeenCamera,
    SeenFrame,
    SeenScene,
    SeenStatus,
    Sensitivity,
    SimulatedDriver,
    Simulation,
    SimulationBatch,
    SimulationEngine,
    SimulationOptions,
    SimulationRecording,
    SimulationState,
    Skeleton,
    SolverReturn,
    SolverReturns,
    SplineMotion,
    SplineTrajectory,
    StepObservation,
    TargetFile,
    TaskBranch,
    TaskEvent,
    TaskEventKind,
    TaskExecution,
    TaskPlan,
    TaskPlans,
    TaskRule,
    TaskRun,
    TaskStatus,
    TaskWaypoints,
    TimedPath,
    ToolPath,
    ToolPathPlan,
    ToolPathStatus,
    Trajectory,
    UnseenPlace,
    ViewerButton,
    ViewerCheck,
    ViewerFolder,
    ViewerSlider,
    ViewerText,
    activeLimits,
    calibrateCamera,
    checkFile,
    checkTaskPlan,
    default_LGP_TAMP_Abstraction,
    defaultDomain,
    depthImage2PointCloud,
    doorStates,
    nextView,
    planMotion,
    planMotions,
    planTask,
    planTasks,
    planToolPath,
    registerScene,
    retime,
    sceneFacts,
    servo,
    shortcut,
    smooth,
    solveAll,
    solveIk,
)
from ._core import __version__ as __version__
from .compatibility import OPT_METHODS as _OPT_METHODS
from .compatibility import addAbsentNames as _addAbsentNames
from .compatibility import addEarlierMethods as _addEarlierMethods
from .compatibility.parameters import (
    clear_params,
    get_params,
    params_add,
    params_clear,
    params_file,
    params_get,
    params_print,
    set_params,
)
from .enums import teach
from .errors import (
    ArgumentError,
    ArgumentTypeError,
    DivergenceError,
    Error,
    FileError,
    FrameDeleted,
    FrameNotFound,
    KinegraphWarning,
    NotFound,
    ParseError,
    RobotFault,
)
from .model_paths import raiPath, setRaiPath
from .seeds import rnd_seed, rnd_seed_random

# Loaded on first use: at once, the import would take three times as long.
if _TYPE_CHECKING:
    from . import test as test
    from .aruco import getArucoImage
    from .compatibility.skeleton_problems import (
        ArgWord,
        OptBench_Skeleton_Handover,
        OptBench_Skeleton_Pick,
        OptBench_Skeleton_StackAndBalance,
        OptBenchmark_InvKin_Endeff,
        _left,
        _path,
        _right,
        _sequence,
    )
    from .film import saveFilm
    from .fleets import imap, readResults
    from .fleets import map as map  # not in __all__: a star import keeps Python's own
    from .interactive import interactiveIk
    from .lerobot import LeRobotWriter, Randomization, checkDataset, demonstrate, mergeShards
    from .manipulation import KOMO_ManipulationHelper, ManipulationModelling
    from .problems import get_NLP_Problem_names, make_NLP_Problem
    from .quaternion import Quaternion
    from .reachable import reachability
    from .recording import Recording, readRecording, saveRecording, serveFoxglove
    from .robot_files import robotNames, robotPath

_SKELETON_PROBLEMS = (
    "ArgWord", "OptBench_Skeleton_Handover", "OptBench_Skeleton_Pick", "OptBench_Skeleton_StackAndBalance",
    "OptBenchmark_InvKin_Endeff", "_left", "_path", "_right", "_sequence",
)  # fmt: skip
_LAZY = {  # module: names
    "aruco": ("getArucoImage",),
    "compatibility.skeleton_problems": _SKELETON_PROBLEMS,
    "film": ("saveFilm",),
    "fleets": ("imap", "readResults", "map"),
    "interactive": ("interactiveIk",),
    "lerobot": ("LeRobotWriter", "Randomization", "checkDataset", "demonstrate", "mergeShards"),
    "manipulation": ("KOMO_ManipulationHelper", "ManipulationModelling"),
    "problems": ("get_NLP_Problem_names", "make_NLP_Problem"),
    "quaternion": ("Quaternion",),
    "reachable": ("reachability",),
    "recording": ("Recording", "readRecording", "saveRecording", "serveFoxglove"),
    "robot_files": ("robotNames", "robotPath"),
}
_MODULE_OF = {name: module for module, names in _LAZY.items() for name in names}


def __getattr__(name: str) -> _Any:
    if name in _LAZY or name == "test":
        return _import_module("." + name, __name__)
    if name not in _MODULE_OF:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'", name=name, obj=_sys.modules[__name__])
    value = globals()[name] = getattr(_import_module("." + _MODULE_OF[name], __name__), name)
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_MODULE_OF, "test"})


_model_paths.announce()


def version() -> str:
    """Returns the version of this package."""
    return str(__version__)


def compiled() -> str:
    """Returns one line about the build."""
    return f"kinegraph {__version__}"


teach(FS, JT, OT, ST, SY, ControlMode, SimulationEngine)
teach(OptMethod, earlier=_OPT_METHODS)
_addEarlierMethods()
_addAbsentNames()
NLP_SolverID = OptMethod  # name in scripts of earlier years
PathFinder = RRT_PathFinder  # name in older scripts

# Written out, so that type checkers know the exported names.
__all__ = [
    "FS",
    "JT",
    "KOMO",
    "NLP",
    "OT",
    "ST",
    "SY",
    "ArgWord",
    "ArgumentError",
    "ArgumentTypeError",
    "BSpline",
    "BotOp",
    "CameraCalibration",
    "CameraView",
    "CameraViewSensor",
    "CellState",
    "CommandLog",
    "Config",
    "ConfigurationViewer",
    "ControlMode",
    "DepthView",
    "DiffIk",
    "DiffIkStatus",
    "DivergenceError",
    "Domain",
    "Error",
    "Feature",
    "FileError",
    "Frame",
    "FrameDeleted",
    "FrameNotFound",
    "FrameView",
    "Gamepad",
    "GripperCommand",
    "GripperInfo",
    "GripperState",
    "Hit",
    "IkOptions",
    "IkResult",
    "IkResults",
    "IkStatus",
    "ImageViewer",
    "KOMO_ManipulationHelper",
    "KinegraphWarning",
    "KinematicDriver",
    "LGP_TAMP_Abstraction",
    "LGP_Tool",
    "LeRobotWriter",
    "LgpStatus",
    "LogicProblem",
    "LoopMode",
    "ManipulationModelling",
    "MotionConstraint",
    "MotionContact",
    "MotionPlan",
    "MotionPlans",
    "Mpc",
    "MpcResult",
    "NLP_Factory",
    "NLP_Sampler",
    "NLP_Solver",
    "NLP_SolverID",
    "NLP_SolverOptions",
    "NextView",
    "NotFound",
    "OccupancyMap",
    "OptBench_Skeleton_Handover",
    "OptBench_Skeleton_Pick",
    "OptBench_Skeleton_StackAndBalance",
    "OptBenchmark_InvKin_Endeff",
    "OptMethod",
    "ParseError",
    "PathContact",
    "PathFinder",
    "PathReturn",
    "PlanSearch",
    "PlanSearchStatus",
    "PlanStatus",
    "Quaternion",
    "RRT_PathFinder",
    "Randomization",
    "RecordedDriver",
    "Recording",
    "RetimeStatus",
    "Roadmap",
    "RoadmapPath",
    "RobotCommand",
    "RobotDriver",
    "RobotFault",
    "RobotInfo",
    "RobotState",
    "SampledTrajectory",
    "SceneObserver",
    "SeenCamera",
    "SeenFrame",
    "SeenScene",
    "SeenStatus",
    "Sensitivity",
    "SimulatedDriver",
    "Simulation",
    "SimulationBatch",
    "SimulationEngine",
    "SimulationOptions",
    "SimulationRecording",
    "SimulationState",
    "Skeleton",
    "SolverReturn",
    "SolverReturns",
    "SplineMotion",
    "SplineTrajectory",
    "StepObservation",
    "TargetFile",
    "TaskBranch",
    "TaskEvent",
    "TaskEventKind",
    "TaskExecution",
    "TaskPlan",
    "TaskPlans",
    "TaskRule",
    "TaskRun",
    "TaskStatus",
    "TaskWaypoints",
    "TimedPath",
    "ToolPath",
    "ToolPathPlan",
    "ToolPathStatus",
    "Trajectory",
    "UnseenPlace",
    "ViewerButton",
    "ViewerCheck",
    "ViewerFolder",
    "ViewerSlider",
    "ViewerText",
    "_left",
    "_path",
    "_right",
    "_sequence",
    "activeLimits",
    "calibrateCamera",
    "checkDataset",
    "checkFile",
    "checkTaskPlan",
    "clear_params",
    "compiled",
    "defaultDomain",
    "default_LGP_TAMP_Abstraction",
    "demonstrate",
    "depthImage2PointCloud",
    "doorStates",
    "getArucoImage",
    "get_NLP_Problem_names",
    "get_params",
    "imap",
    "interactiveIk",
    "make_NLP_Problem",
    "mergeShards",
    "nextView",
    "params_add",
    "params_clear",
    "params_file",
    "params_get",
    "params_print",
    "planMotion",
    "planMotions",
    "planTask",
    "planTasks",
    "planToolPath",
    "raiPath",
    "reachability",
    "readRecording",
    "readResults",
    "registerScene",
    "retime",
    "rnd_seed",
    "rnd_seed_random",
    "robotNames",
    "robotPath",
    "saveFilm",
    "saveRecording",
    "sceneFacts",
    "serveFoxglove",
    "servo",
    "setRaiPath",
    "set_params",
    "shortcut",
    "smooth",
    "solveAll",
    "solveIk",
    "test",
    "version",
]
