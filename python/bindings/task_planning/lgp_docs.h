#pragma once

/// Docstrings of bind_lgp.cpp.
namespace kinegraph::python::docs::lgp {

// Shared parts.
#define KINEGRAPH_LGP_ACTION                      \
  "Args:\n"                                       \
  "    komo: The problem.\n"                      \
  "    time: The end of the action, in phases.\n" \
  "    prev_action: The action before it, [] if there is none.\n"
#define KINEGRAPH_LGP_NO_PLAN \
  "Raises:\n"                 \
  "    ArgumentError: No plan was found yet."

inline constexpr char abstraction[] =
    R"(The domain of an LGP_Tool. Subclass it, or default_LGP_TAMP_Abstraction, for your own actions. All methods are
called on the thread that calls LGP_Tool.)";

inline constexpr char makeAbstraction[] = R"(Makes an abstraction of a scene, without actions.

Args:
    C: The scene.)";

inline constexpr char getNewActionSequence[] = R"(Returns the next plan in logic.

Returns:
    A list of actions, each a list of words; None if there is no further one.)";

inline constexpr char forbidBeginning[] =
    R"(Excludes plans that begin with these actions, which are infeasible. An abstraction may ignore it.

Args:
    plan: The first actions.
Raises:
    ArgumentError: An action is no list of words.)";

inline constexpr char setup_sequence[] = R"(Makes the waypoint problem of a plan, without the constraints of the
actions.

Args:
    C: The scene.
    K: The number of actions.
Returns:
    A KOMO with a slice per action.)";

inline constexpr char setup_motion[] = R"(Makes the motion problem of a plan, without the constraints of the actions.

Args:
    C: The scene.
    K: The number of actions.
Returns:
    A KOMO with 30 slices per action, collision-free and with rest at the end.)";

inline constexpr char add_action_constraints[] =
    R"(Adds the constraints of an action to a waypoint problem.

)" KINEGRAPH_LGP_ACTION R"(    action: The action.
Raises:
    ArgumentError: The action is unknown.)";

inline constexpr char add_action_constraints_motion[] =
    R"(Adds the constraints of an action to a motion problem; by default those of the waypoints.

)" KINEGRAPH_LGP_ACTION R"(    action: The action.
Raises:
    ArgumentError: The action is unknown.)";

inline constexpr char add_all[] =
    R"(Adds the constraints of all actions of a plan, then those of the explicit pairs.

Args:
    komo: The problem.
    plan: The actions.
    motion: True for a motion problem, False for a waypoint problem.
Raises:
    ArgumentError: An action is unknown, or explicitCollisions are no pairs.)";

inline constexpr char defaultAbstraction[] =
    R"(Actions from a .lgp file and the .fol file that it names: pick_touch, pick_box, handover, place_straightOn,
place_box, poseEq, gripper_push and end_push. Older files call the first pick and the fourth place. Other actions need a
subclass.)";

inline constexpr char makeDefault[] = R"doc(Reads the files and the facts of the scene.

Args:
    C: The scene.
    lgp_config_file: Name of the .lgp file: `fol: <file>`, `terminal: "(on tray cup)"`, `coll: [a b]`.
Raises:
    FileError: A file cannot be read.
    ParseError: A file is invalid, or the goal has an unknown word.)doc";

inline constexpr char nextPlan[] = R"(Returns the next plan in logic, the shortest first.

Returns:
    A list of actions, each a list of words; None if there is no further one.)";

inline constexpr char forbid[] = R"(Excludes plans that begin with these actions.

Args:
    plan: The first actions.
Raises:
    ArgumentError: An action is unknown.)";

inline constexpr char addDefaultConstraints[] =
    R"(Adds the constraints of an action to a waypoint problem.

)" KINEGRAPH_LGP_ACTION R"(    action: The action: its name, and its arguments as in the .fol file.
Raises:
    ArgumentError: The action is unknown, or has too few words.)";

inline constexpr char switchTo[] = R"(Attaches an object to a frame from a time on, without a jump.

Args:
    m: A helper for the problem.
    time: In phases.
    frame: Name of the frame.
    obj: Name of the object.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char steps[] = R"(Returns the number of slices per action.

Args:
    komo: The problem that was set up last.
Returns:
    1 for waypoints.)";

inline constexpr char is_last[] = R"(Returns whether the plan ends at a time.

Args:
    time: In phases.
Returns:
    True at the end of the problem that was set up last.)";

inline constexpr char tool[] =
    R"(Finds plans that bodies can carry out: each plan of the abstraction becomes a waypoint problem. No further plan
begins like one that failed from all initial guesses. If there is no further plan, the failed ones are tried from other
guesses, in three rounds. The budget counts solves.

    tamp = ry.default_LGP_TAMP_Abstraction(C, "problem.lgp")
    lgp = ry.LGP_Tool(C, tamp)
    lgp.solve()
    print(lgp.getSolvedPlan())
    lgp.solveFullMotion())";

inline constexpr char makeTool[] = R"(Makes a tool; `solve` begins the search.

Args:
    C: The scene.
    tamp: The abstraction: plans, and the constraints of their actions.
    translator: An argument of older scripts; ignored.
    threads: Threads that solve from several guesses, or the motions of several actions. Results are bit-identical.
    results: Converts a SolverReturn to the returned object, whose `feasible` tells whether a problem is solved; None:
        no conversion.
Raises:
    ArgumentError: threads is less than one.)";

inline constexpr char solve[] =
    R"(Searches for a new plan with feasible waypoints. Repeated calls give further plans. Ctrl-C ends it.

Args:
    verbose: 1: logs a line per plan that was tried; 0: logs nothing.
    maxSolves: Maximum number of solves of waypoint problems.
Returns:
    True if a plan was found. Else `status` is LgpStatus.infeasible (the logic has no plan at all) or no_plan_found, and
    `message` has the causes.)";

inline constexpr char getSolvedPlan[] = R"(Returns the last plan.

Returns:
    A list of actions, each a list of words.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char getSolvedKOMO[] = R"(Returns the waypoint problem of the last plan, at its solution.

Returns:
    A KOMO with a slice per action.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char get_piecewiseMotionProblem[] =
    R"(Makes the motion problem of one action between its waypoints, with the attachments of that time.

Args:
    phase: Index of the action.
    fixEnd: The motion ends exactly at the waypoint.
Returns:
    A KOMO with 30 slices, initialized by interpolation.
Raises:
    ArgumentError: No plan was found yet, or phase is out of range.)";

inline constexpr char get_fullMotionProblem[] = R"(Makes the motion problem of all actions of the plan, 30 slices each.

Args:
    initWithWaypoints: Initializes the path with the waypoints, else with the scene.
Returns:
    A KOMO.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char solvePiecewiseMotions[] = R"(Solves the motions of all actions, one after the other.

Args:
    verbose: 1: logs a line per action; 0: logs nothing.
Returns:
    The results. The paths are in `paths`.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char solveFullMotion[] =
    R"(Solves the motion of all actions, from the waypoints, then from perturbed ones.

Args:
    verbose: 1: logs the result in a line; 0: logs nothing.
Returns:
    The result. The path is in `path`, the problem in `motion`.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char view_solved[] = R"(Shows the waypoints.

Args:
    pause: Waits for a key.
Returns:
    The key, or 0.
)" KINEGRAPH_LGP_NO_PLAN;

#undef KINEGRAPH_LGP_ACTION
#undef KINEGRAPH_LGP_NO_PLAN

}  // namespace kinegraph::python::docs::lgp
