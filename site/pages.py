"""The structure of the site: which page is in which section, and which names are on which page of the reference."""

TUTORIALS = ["own_robot", "first_pick_and_place"]  # the examples follow

# Scenes of these pages: the code that shows them after that of the page, and the line before which they are.
SCENES = {
    "own_robot": ("C.view()\ntask.view(C)\n", "If there is no plan, `task.message` has the reason."),
    "first_pick_and_place": ("C.view()\nplan.view(C)\n", "The last lines that it prints"),
}

# Texts of docs/ that become links on the site.
SITE_LINKS = {
    "scenes": {"The site's reference (`make docs`)": "[The reference](reference/scene_attributes.md)"},
    "faq": {"the reference of the site": "the [reference](reference/index.md)"},
}

EXAMPLES = [  # captions, and the numbers of the examples below
    ("Scenes, features and inverse kinematics", "01 02 03 04 05 06 07 08 09"),
    ("Collision-free motions, timed and followed", "11 13 28 29"),
    ("Tools along paths", "34 35 36 37"),
    ("Control loops", "12 14 39"),
    ("Simulation with contact", "15 16 20"),
    ("Tasks", "17 18 21 19 23 24 25 30 31"),
    ("A camera in the loop", "33 38"),
    ("Calibration by gradients", "27"),
    ("Many problems, data sets and a policy", "10 22 32 26"),
]

HOW_TO = [
    ("Scenes and robots", ["scenes", "robots", "other_simulators", "ik", "features"]),
    ("Motions", ["motion", "planning", "timing", "tool_paths"]),
    ("Tasks", ["tasks", "logic"]),
    ("Cameras", ["perception"]),
    ("Robots that move", ["control", "operation", "mcap", "simulation", "dynamics"]),
    ("Arms", ["ros2", "franka", "trossen", "ur", "lerobot_robots"]),
    ("Many problems", ["fleets", "lerobot", "sensitivities", "solvers"]),
    ("Programs", ["viewer", "cpp"]),
    (
        "Coming from",
        [
            "coming_from_robotic",
            "coming_from_moveit",
            "coming_from_pinocchio",
            "coming_from_mujoco",
            "coming_from_drake",
            "coming_from_ompl",
            "coming_from_curobo",
        ],
    ),
    ("Questions", ["troubleshooting", "faq"]),
]

EXPLANATION = [
    "theory/komo",
    "theory/verification",
    "theory/infeasibility",
    "theory/contacts",
    "theory/determinism",
    "architecture",
    "speed",
    "limits",
    "beside_other_sites",
]

REFERENCE = ["conventions", "errors"]  # beside the generated pages

# Page of the reference: title and names. Python's names; a name without a page goes to the last one.
NAMES = {
    "scenes": ("Scenes", "Config Frame JT ST FrameView checkFile raiPath setRaiPath robotNames robotPath Quaternion"),
    "features": ("Features", "FS Feature Sensitivity"),
    "ik": ("Inverse kinematics", "solveIk IkOptions IkResult IkResults IkStatus reachability interactiveIk"),
    "komo": (
        "Motion optimization",
        "KOMO OT SY NLP NLP_Solver NLP_SolverOptions OptMethod NLP_SolverID SolverReturn SolverReturns solveAll "
        "Skeleton SplineMotion NLP_Sampler NLP_Factory make_NLP_Problem get_NLP_Problem_names",
    ),
    "planning": (
        "Motion planning",
        "planMotion planMotions MotionPlan MotionPlans MotionConstraint MotionContact PlanStatus "
        "shortcut smooth Roadmap RoadmapPath PathFinder RRT_PathFinder PathReturn PathContact",
    ),
    "timing": (
        "Trajectories",
        "Trajectory retime TimedPath RetimeStatus BSpline SplineTrajectory SampledTrajectory",
    ),
    "tool_paths": ("Tool paths", "ToolPath planToolPath ToolPathPlan ToolPathStatus"),
    "tasks": (
        "Tasks",
        "planTask planTasks TaskPlan TaskPlans TaskStatus TaskBranch TaskRun TaskEvent TaskEventKind TaskExecution "
        "checkTaskPlan Domain TaskRule TaskWaypoints defaultDomain doorStates sceneFacts ArgWord LogicProblem PlanSearch "
        "PlanSearchStatus LGP_Tool LgpStatus LGP_TAMP_Abstraction default_LGP_TAMP_Abstraction KOMO_ManipulationHelper "
        "ManipulationModelling",
    ),
    "control": ("Control", "DiffIk DiffIkStatus Mpc MpcResult TargetFile Gamepad"),
    "simulation": (
        "Simulation",
        "Simulation SimulationBatch SimulationEngine SimulationOptions SimulationRecording SimulationState "
        "ControlMode StepObservation",
    ),
    "operation": (
        "Robots",
        "BotOp RobotDriver RobotInfo RobotState RobotCommand SimulatedDriver KinematicDriver RecordedDriver CommandLog "
        "GripperInfo GripperCommand GripperState servo LoopMode",
    ),
    "viewer": (
        "Viewer and cameras",
        "ConfigurationViewer CameraView CameraViewSensor ImageViewer saveFilm depthImage2PointCloud getArucoImage "
        "ViewerButton ViewerCheck ViewerFolder ViewerSlider ViewerText",
    ),
    "perception": (
        "Perception",
        "DepthView registerScene SeenScene SeenFrame SeenCamera SeenStatus SceneObserver OccupancyMap CellState Hit "
        "UnseenPlace nextView NextView calibrateCamera CameraCalibration",
    ),
    "fleets": ("Many processes", "imap readResults"),
    "mcap": ("Recordings", "Recording readRecording saveRecording serveFoxglove"),
    "lerobot": ("Data sets of LeRobot", "demonstrate LeRobotWriter Randomization checkDataset mergeShards"),
    "errors": (
        "Errors",
        "Error ArgumentError ArgumentTypeError DivergenceError FileError FrameDeleted FrameNotFound NotFound ParseError RobotFault "
        "KinegraphWarning",
    ),
}

# Names that differ in C++.
CPP_NAMES = {
    "Recording": "",  # of a robot; C++ has none
    "SimulationRecording": "Recording",
    "KOMO": "Komo",
    "NLP": "Nlp",
    "NLP_Solver": "NlpSolver",
    "NLP_SolverOptions": "SolverOptions",
    "NLP_Sampler": "NlpSampler",
    "SolverReturn": "SolverResult",
    "ConfigurationViewer": "ConfigViewer",
    "RRT_PathFinder": "PathFinder",
    "LGP_Tool": "LgpTool",
    "raiPath": "modelPath",
    "robotPath": "robotPath",
}

CPP_ENUMS = {"JT": "JointType", "ST": "ShapeType", "SY": "SwitchMode", "OT": "ObjectiveType"}

# Further names of C++ per page.
CPP_ONLY = {
    "scenes": "Pose FileOptions",
    "features": "Residual",
    "ik": "IkTarget",
    "komo": "Objective ObjectiveType",
    "planning": "PlanOptions MotionGoal",
    "timing": "RetimeOptions",
    "tasks": "PlanTaskOptions TaskPlanOptions",
    "simulation": "Contact",
}

# Pages of all other names of C++, by the beginning of their header below src/kinegraph.
CPP_ROOMS = {
    **dict.fromkeys(("planning", "rrt", "collision"), "planning"),
    **dict.fromkeys(("komo", "nlp", "solvers", "trajectory_optimization", "api/solutions"), "komo"),
    **dict.fromkeys(
        ("scene", "geometry", "gfile", "kinematics", "math", "exporters", "parsers", "api/batch"), "scenes"
    ),
    **dict.fromkeys(("features", "api/custom_feature"), "features"),
    **dict.fromkeys(("task_planning", "logic", "api/task"), "tasks"),
    **dict.fromkeys(("viewer", "rendering"), "viewer"),
    **dict.fromkeys(("simulation", "api/recorded_motion"), "simulation"),
    **dict.fromkeys(("control", "api/robot_motion"), "control"),
    **dict.fromkeys(("perception", "api/next_view"), "perception"),
    "ik": "ik",
    "robot": "operation",
    "trajectories": "timing",
    "tool_paths": "tool_paths",
    "common/errors": "errors",
}


def pageOf(header: str) -> str:
    """The page of the names of a header: that of its longest folder or beginning in `CPP_ROOMS`."""
    found = [room for room in CPP_ROOMS if header.startswith(room)]
    return CPP_ROOMS[max(found, key=len)] if found else "more"
