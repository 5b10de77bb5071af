#pragma once

/// The manual of what bind_lgp.cpp binds.
namespace kinegraph::python::docs::lgp {

// What several of them say.
#define KINEGRAPH_LGP_ACTION                        \
  "Args:\n"                                         \
  "    komo: The problem.\n"                        \
  "    time: When the action is done, in phases.\n" \
  "    prev_action: The action before it, [] if there is none.\n"
#define KINEGRAPH_LGP_NO_PLAN \
  "Raises:\n"                 \
  "    ArgumentError: Nothing was found yet."

inline constexpr char abstraction[] =
    R"(What LGP_Tool asks of a domain. Subclass it, or default_LGP_TAMP_Abstraction, for actions of your own. All its methods
are called on the thread that calls LGP_Tool.)";

inline constexpr char makeAbstraction[] = R"(Makes an abstraction of a scene, without actions.

Args:
    C: The scene.)";

inline constexpr char getNewActionSequence[] = R"(The next plan in logic.

Returns:
    A list of actions, each a list of words; None if there is no further one.)";

inline constexpr char forbidBeginning[] =
    R"(No further plan shall begin like that: it was found infeasible. An abstraction may ignore it.

Args:
    plan: The first actions.
Raises:
    ArgumentError: An action is no list of words.)";

inline constexpr char setup_sequence[] = R"(The waypoint problem of a plan, without what the actions ask.

Args:
    C: The scene.
    K: The number of actions.
Returns:
    A KOMO with a slice per action.)";

inline constexpr char setup_motion[] = R"(The motion problem of a plan, without what the actions ask.

Args:
    C: The scene.
    K: The number of actions.
Returns:
    A KOMO with 30 slices per action, free of collisions, that ends at rest.)";

inline constexpr char add_action_constraints[] =
    R"(Adds what an action asks of the waypoints.

)" KINEGRAPH_LGP_ACTION R"(    action: The action.
Raises:
    ArgumentError: The action is not known.)";

inline constexpr char add_action_constraints_motion[] =
    R"(Adds what an action asks of the motion; by default what it asks of the waypoints.

)" KINEGRAPH_LGP_ACTION R"(    action: The action.
Raises:
    ArgumentError: The action is not known.)";

inline constexpr char add_all[] =
    R"(Adds what the actions of a plan ask, then that the explicit pairs do not overlap.

Args:
    komo: The problem.
    plan: The actions.
    motion: Of the motion; else of the waypoints.
Raises:
    ArgumentError: An action is not known, or explicitCollisions are no pairs.)";

inline constexpr char defaultAbstraction[] =
    R"(Actions from a .lgp file and the .fol file that it names: pick_touch, pick_box, handover, place_straightOn,
place_box, poseEq, gripper_push, end_push; pick and place, as files of earlier years call the first and the fourth. Actions
of other names need a subclass.)";

inline constexpr char makeDefault[] = R"doc(Reads the files, and what the scene says in logic.

Args:
    C: The scene.
    lgp_config_file: Name of the .lgp file: `fol: <file>`, `terminal: "(on tray cup)"`, `coll: [a b]`.
Raises:
    FileError: A file cannot be read.
    ParseError: A file is wrong, or the goal has an unknown word.)doc";

inline constexpr char nextPlan[] = R"(The next plan in logic, the shortest first.

Returns:
    A list of actions, each a list of words; None if there is no further one.)";

inline constexpr char forbid[] = R"(No further plan begins like that.

Args:
    plan: The first actions.
Raises:
    ArgumentError: There is no such action.)";

inline constexpr char addDefaultConstraints[] =
    R"(Adds what an action asks of the waypoints.

)" KINEGRAPH_LGP_ACTION R"(    action: The action: its name, and its arguments as in the .fol file.
Raises:
    ArgumentError: The action is not known, or has too few words.)";

inline constexpr char switchTo[] = R"(From a time on an object sits at a frame; it does not jump there.

Args:
    m: A helper on the problem.
    time: In phases.
    frame: Name of the frame.
    obj: Name of the object.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char steps[] = R"(Slices per action.

Args:
    komo: The problem that was set up last.
Returns:
    1 for waypoints.)";

inline constexpr char is_last[] = R"(Whether the plan ends at a time.

Args:
    time: In phases.
Returns:
    True at the end of the problem that was set up last.)";

inline constexpr char tool[] =
    R"(Finds plans that bodies can carry out: each plan of the abstraction becomes a waypoint problem. No further plan begins
as one that failed from all starts; where there is no further plan, those that failed are tried from other starts, in three
rounds. Effort is counted in solves.

    tamp = ry.default_LGP_TAMP_Abstraction(C, "problem.lgp")
    lgp = ry.LGP_Tool(C, tamp)
    lgp.solve()
    print(lgp.getSolvedPlan())
    lgp.solveFullMotion())";

inline constexpr char makeTool[] = R"(Makes a tool; nothing is searched yet.

Args:
    C: The scene.
    tamp: What is asked for plans, and for what their actions ask.
    translator: Of older scripts; the abstraction does its work.
    threads: How many solve at the same time, from other starts, or the motions of other actions. What is found is
        the same, to the bit.
    results: What makes of a SolverReturn that which is returned in its place, and says by `feasible` whether
        something is solved; None: nothing.
Raises:
    ArgumentError: threads is less than one.)";

inline constexpr char solve[] =
    R"(Searches until a new plan with feasible waypoints is found. Repeated calls give further plans. Ctrl-C ends it.

Args:
    verbose: 1: a line per plan that was tried; 0: nothing.
    maxSolves: Effort: waypoint problems that are solved, at most.
Returns:
    True if there is one; else `status` is LgpStatus.infeasible (the logic has no plan at all) or no_plan_found, and
    `message` says why plans failed.)";

inline constexpr char getSolvedPlan[] = R"(The plan that was found last.

Returns:
    A list of actions, each a list of words.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char getSolvedKOMO[] = R"(The waypoint problem of the plan that was found last, at its solution.

Returns:
    A KOMO with a slice per action.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char get_piecewiseMotionProblem[] =
    R"(The motion of one action cancellation its waypoints, with attachments as they are then.

Args:
    phase: 0: the first action.
    fixEnd: It ends exactly at the waypoint.
Returns:
    A KOMO with 30 slices that starts on the straight way.
Raises:
    ArgumentError: Nothing was found yet, or there is no such action.)";

inline constexpr char get_fullMotionProblem[] = R"(The motion over all actions of the plan, 30 slices each.

Args:
    initWithWaypoints: It starts at the waypoints; else where the scene is.
Returns:
    A KOMO.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char solvePiecewiseMotions[] = R"(Solves the motions of all actions, one after the other.

Args:
    verbose: 1: a line per action; 0: nothing.
Returns:
    How each ended. The paths are in `paths`.
)" KINEGRAPH_LGP_NO_PLAN;

inline constexpr char solveFullMotion[] =
    R"(Solves the motion over all actions, from the waypoints, then from near them.

Args:
    verbose: 1: a line says how it ended; 0: nothing.
Returns:
    How it ended. The path is in `path`, the problem in `motion`.
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
