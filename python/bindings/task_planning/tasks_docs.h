#pragma once

/// Docstrings of bind_tasks.cpp and bind_plan_task.cpp.
namespace kinegraph::python::docs::tasks {

// The arguments and errors of planTask and planTasks.
#define KINEGRAPH_TASK_ARGUMENTS                                                                                      \
  "Args:\n"                                                                                                           \
  "    C: The scene; it is not changed.\n"                                                                            \
  "    goal: Literals that shall hold: \"(on tray cup) (on tray jug)\"; a ! behind a literal negates it.\n"           \
  "    domain: Actions in logic; None: defaultDomain().\n"                                                            \
  "    rules: The geometric meaning of actions, name -> TaskRule. Rules replace or extend the default ones.\n"        \
  "    time_limit: s of wall time; None: no limit. With a limit, the result depends on the machine.\n"                \
  "    max_evaluations: Budget of evaluations of waypoint and motion problems.\n"                                     \
  "    seed: Seed of sampled initial guesses.\n"                                                                      \
  "    velocity: |dq/dt| limit, a number or one per joint, rad/s or m/s; None: the model's, or 1 if it has none.\n"   \
  "    acceleration: |d2q/dt2| limit, likewise, rad/s^2 or m/s^2; None: full speed is reached in half a second.\n"    \
  "    threads: Threads that solve variants of actions and motions in parallel. The plan is bit-identical. Threads\n" \
  "        call `rules`, too, one at a time.\n"                                                                       \
  "    margin: Clearance of all pairs of bodies whose contact is not meant, m. Less is kept only where no other "     \
  "plan\n"                                                                                                            \
  "        was found, with a warning.\n"                                                                              \
  "    contact_speed: Speed of hands up to 5 cm away from where they take or leave something, m/s; inf: no limit.\n"
#define KINEGRAPH_TASK_RAISES                                 \
  "Raises:\n"                                                 \
  "    ParseError: A word of the goal is not in the scene.\n" \
  "    ArgumentError: An action has no TaskRule, or an argument is invalid."

inline constexpr char planTask[] =
    R"(Plans actions and their motion so that a goal holds. A search in logic proposes sequences of actions. Cheap
proofs of reach, size and room, then waypoints with grasps and placements, then motions test whether bodies can carry
them out. Each failure becomes a constraint of the logic. A solved plan has passed checkTaskPlan.

Without a domain, the actions are those of defaultDomain. Grippers, objects and places are the frames that the scene
labels (`logical: { is_gripper }`). A scene without labels has as grippers the frames whose names end with "gripper", as
objects the frames with a rigid joint and a shape, and as places level boxes that do not move.

)" KINEGRAPH_TASK_ARGUMENTS R"(Returns:
    A TaskPlan; not finding one is a status.
)" KINEGRAPH_TASK_RAISES;

inline constexpr char planTasks[] =
    R"doc(Plans ever faster: the first plan is that of planTask, and each further plan takes less time than the one
before. Further plans come from other waypoints of the same actions, and from other actions.

    for plan in ry.planTasks(C, "(on tray cup)", max_evaluations=20000):
        print(plan.duration)

)doc" KINEGRAPH_TASK_ARGUMENTS R"(Returns:
    An iterator of TaskPlans. If there is no plan, it gives one TaskPlan with the reason.
)" KINEGRAPH_TASK_RAISES;

inline constexpr char checkTaskPlan[] =
    R"(Checks a plan by playing it in a copy of the scene. The check knows the scene, the actions and the motion, and
nothing of the search. Objects move only by being taken along.

In logic, the goal has to hold after the last action. The motion must not jump, is at rest where an action begins and
ends, and keeps its limits of velocity and acceleration. Joints stay within their limits, and shapes overlap by at most
1 mm, also between samples (`Config.checkMotion`). A hand touches the object that it takes, to 1 mm. An object that is
put down stands level to half a degree, at the height of its place to 1 mm. Its center is 5 mm inside the edges, and its
center of mass is above the area shared with the place. Objects that stand on a carried object tilt by less than 5
degrees and are accelerated by at most 2 m/s^2. Pushed objects move straight and level, away from the pusher. Doors move
only while a hand holds their handle. At rest, nothing overlaps.

Args:
    C: The scene at the start; it is not changed.
    plan: A TaskPlan with actions, path and times.
    states: The facts before and after each action, as of PlanSearch.states; None: the logic is not checked.
    margin: Clearance of all pairs of bodies whose contact is not meant, m; None: plan.margin.
Returns:
    Violations, a sentence each; empty if there are none.
Raises:
    ParseError: A state has a word that is no literal.
    ArgumentError: The parts of the plan do not fit each other or the scene.)";

inline constexpr char defaultDomain[] =
    R"(Returns the domain of planTask if none is passed. Its actions are:

- pick (Obj From Hand), for objects with nothing on them;
- lift (Obj From Hand), for objects labeled is_carrier, with everything that stands on them;
- place (Obj Hand To) and handover (Obj Hand To);
- lay (Obj Hand To Face), if the goal names the face that points up;
- pose (Obj Hand Goal), for frames labeled is_pose;
- push_start (Obj From Hand) and push_end (Obj Hand To), for objects labeled is_pushable;
- hook_start (Obj From Hook Tool Hand) and hook_end (Obj Hook To Tool Hand), with a tool with a part labeled is_hook;
- hold, open and close (Door Handle Hand), for frames labeled is_door or is_drawer that have a part labeled is_handle.

Returns:
    A domain, to which actions can be added.)";

inline constexpr char makeRule[] = R"(Makes a rule.

Args:
    add: Adds the constraints of an action to its waypoint problem. Called with the problem w (TaskWaypoints), the time
        in phases, the action's words and a variant. It uses w.komo.addObjective, w.m (a KOMO_ManipulationHelper),
        w.attach(time, hand, obj) and w.put(time, obj, place).
    variants: Returns the names of the variants, the best first. Called with the scene and the action's words.
Raises:
    TypeError: In planTask: a function does not take these arguments.)";

inline constexpr char makeWaypoints[] = R"(Makes the problem; planTask makes one for each sequence of actions.

Args:
    C: The scene.
    actions: The words of each action.
    variants: The variant of each action.
    rules: TaskRules of actions, by name; actions of the default domain need none.
Raises:
    NotFound: An action has no rule.)";

inline constexpr char attach[] = R"(Lets a hand hold an object from a time on. The solver finds the relative pose.

Args:
    time: In phases.
    hand: The frame that holds or pushes.
    obj: The object's frame.
    touching: The surfaces have to touch, as of a stick that takes an object along.
    gap: Distance of the surfaces with `touching`, m.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char put[] = R"(Lets an object stand upright on a place from a time on.

Args:
    time: In phases.
    obj: The object's frame.
    to: The place's frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char lay[] = R"(Lets a box lie on a place from a time on, with one of its faces up.

Args:
    time: In phases.
    obj: The object's frame.
    to: The place's frame.
    face: The axis of the object that points up: x, y, z, xNeg, yNeg, zNeg.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no such face, or a shape is no box.)";

inline constexpr char push[] =
    R"(Pushes an object straight to a place between two times, from behind and without rotation.

Args:
    start: Time of the first contact, in phases.
    end: Time of the arrival, in phases.
    pusher: The frame that pushes.
    obj: The object's frame.
    to: The place's frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char guide[] = R"(Moves a door or drawer by a hand that has held its handle since the action before.

Args:
    time: In phases.
    door: The frame of the door or drawer.
    handle: The part of the door that the hand holds.
    hand: The frame that holds it.
    opens: True: opens it; else closes it.
Raises:
    ArgumentError: The frame is no door or drawer.
    FrameNotFound: There is no such frame.)";

inline constexpr char doorStates[] = R"(Returns the doors and drawers of a scene with their states.

A door or drawer is a frame labeled is_door or is_drawer (`logical: { is_door }`) with an active joint of one dof with
limits. It is closed at the limit that is closer to zero.

Args:
    C: The scene.
Returns:
    name -> 'opened' (from 80 % of the joint's range on), 'closed' (up to 5 %), or 'ajar'.)";

inline constexpr char start[] = R"(Returns an initial guess with hands close to the objects that they handle.

Args:
    seed: Seed of sampled placements and grasps; None: placements are central.
    grasps: Samples grasps, too.
Returns:
    The variables of the problem, shape (n,).)";

#undef KINEGRAPH_TASK_ARGUMENTS
#undef KINEGRAPH_TASK_RAISES

}  // namespace kinegraph::python::docs::tasks
