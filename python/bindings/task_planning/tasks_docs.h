#pragma once

/// The manual of what bind_tasks.cpp binds.
namespace kinegraph::python::docs::tasks {

// What both planTask and planTasks say.
#define KINEGRAPH_TASK_ARGUMENTS                                                                                      \
  "Args:\n"                                                                                                           \
  "    C: The scene; it is not changed.\n"                                                                            \
  "    goal: Literals that shall hold: \"(on tray cup) (on tray jug)\"; with ! behind one, that it does not.\n"       \
  "    domain: Actions in logic; None: the default ones.\n"                                                           \
  "    rules: What actions of other names ask: name -> TaskRule.\n"                                                   \
  "    seconds: Gives up after that long; None: never. The answer then depends on the machine.\n"                     \
  "    evaluations: Effort: gives up after so many evaluations of motion problems.\n"                                 \
  "    seed: Of the starts that are drawn.\n"                                                                         \
  "    velocity: Most |dq/dt|, a number or one per joint, rad/s or m/s; None: the model's, 1 where it says none.\n"   \
  "    acceleration: Most |d2q/dt2|, the same, rad/s^2 or m/s^2; None: what reaches full speed in half a second.\n"   \
  "    threads: How many try variants of actions, and motions, at the same time; the plan is the same, to the bit.\n" \
  "        They call `rules`, too, one at a time.\n"
#define KINEGRAPH_TASK_RAISES                                 \
  "Raises:\n"                                                 \
  "    ParseError: A word of the goal is not in the scene.\n" \
  "    ArgumentError: Nothing is known of an action, or an argument makes no sense."

inline constexpr char planTask[] =
    R"(Finds what to do, and how to move, so that a goal holds: a search in logic proposes sequences of actions; cheap
proofs of reach, size and room, then waypoints with grasps and placements, then motions say whether bodies can carry
them out; conflicts go back into the logic. What is called solved has passed checkTaskPlan.

Without a domain the actions are those of defaultDomain. Grippers, objects and places are those that the scene names
(`logical: { is_gripper }`); else frames whose names end with gripper, frames with a joint of type rigid and a shape,
and level boxes that do not move.

)" KINEGRAPH_TASK_ARGUMENTS R"(Returns:
    A TaskPlan; not finding one is no error.
)" KINEGRAPH_TASK_RAISES;

inline constexpr char planTasks[] =
    R"doc(Plans that get better while one waits: the first is that of planTask, each further one takes less time than the one
before. They come from other waypoints of the same actions, and from other actions.

    for plan in ry.planTasks(C, "(on tray cup)", evaluations=20000):
        print(plan.duration)

)doc" KINEGRAPH_TASK_ARGUMENTS R"(Returns:
    An iterator of TaskPlans; where there is none, one that says why.
)" KINEGRAPH_TASK_RAISES;

inline constexpr char checkTaskPlan[] =
    R"(Plays a plan in a copy of the scene: objects are taken along from where they are, never moved otherwise. An independent
judge: it knows the scene, the actions and the motion, and nothing of how they were found.

Looked at: that the goal holds in logic after the last action; that the motion does not jump, is at rest where an action
begins and ends, and keeps its limits of velocity and acceleration; that joints are within their limits and nothing
overlaps by more than 1 mm, at all times and not only in samples (`Config.checkMotion`); that a hand touches what it
takes, to 1 mm; that what is put down stands level to half a degree, at the height of its place to 1 mm, with its center
5 mm inside the edges, and its center of mass above what it shares with the place; that what stands on something that is carried tilts by less than 5 degrees and is accelerated by
at most 2 m/s^2; that what is pushed moves straight and level, away from what pushes it; and that nothing that is at
rest then overlaps.

Args:
    C: The scene at the start; it is not changed.
    plan: A TaskPlan with actions, path and times.
    states: What holds before and after each action, as of PlanSearch.states; None: logic is not looked at.
Returns:
    What is wrong, a line each; empty if nothing is.
Raises:
    ParseError: A state has what is no literal.
    ArgumentError: The parts of the plan do not fit each other, or the scene.)";

inline constexpr char cornersOf[] =
    R"(The rows of a path at which it turns, with its ends: those inside of a straight piece are left out.

Args:
    path: Shape (T, n).
Returns:
    Rows of it, shape (K, n).)";

inline constexpr char treeText[] =
    R"(Branches of a search as a tree: actions that several begin with stand once, causes behind the last one.

Args:
    branches: Actions, and why they were given up, or "".
Returns:
    A line per action.)";

inline constexpr char holderOf[] =
    R"(The hand that an object hangs below without a joint of q in cancellation.

Args:
    C: The scene.
    obj: The object's frame.
    hands: Names of frames.
Returns:
    One of the hands; "" if there is none.)";

inline constexpr char defaultDomain[] =
    R"(The domain of planTask where none is given: pick (Obj From Hand) for what nothing stands on, lift (Obj From Hand) for
what is called is_carrier, with all that stands on it, place (Obj Hand To), handover (Obj Hand To), lay (Obj Hand To
Face) where the goal says which face is up, pose (Obj Hand Goal) for frames that are called is_pose, push_start (Obj
From Hand) and push_end (Obj Hand To) for what is called is_pushable, hook_start (Obj From Hook Tool Hand) and hook_end (Obj
Hook To Tool Hand) with a tool of which a part is called is_hook, hold, open and close (Door Handle Hand) for what is called
is_door or is_drawer, with a part that is called is_handle.

Returns:
    A domain, to which actions can be added.)";

inline constexpr char makeRule[] = R"(Makes a rule.

Args:
    add: Called with the waypoint problem w, the time in phases, the action's words and a variant; adds what it asks:
        w.komo.addObjective, w.m (a KOMO_ManipulationHelper), w.attach(time, hand, obj), w.put(time, obj, place).
    variants: Called with the scene and the action's words; gives the names of its variants, best first.
Raises:
    TypeError: By planTask: one of them does not take these arguments.)";

inline constexpr char makeWaypoints[] = R"(Makes the problem; planTask does.

Args:
    C: The scene.
    actions: The words of each action.
    variants: In which way each is done.
    rules: What actions ask, by their first words; those of the default domain need none.
Raises:
    NotFound: An action has no rule.)";

inline constexpr char attach[] = R"(From a time on the hand holds the object, in a pose that is found.

Args:
    time: In phases.
    hand: The frame that holds, or pushes.
    obj: The object's frame.
    touching: Their surfaces touch, as where a stick takes something along.
    gap: They are that far apart then, m.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char put[] = R"(From a time on the object stands on a place, upright.

Args:
    time: In phases.
    obj: The object's frame.
    to: The place's frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char lay[] = R"(From a time on the object, a box, lies on a place with one of its faces up.

Args:
    time: In phases.
    obj: The object's frame.
    to: The place's frame.
    face: Which axis of the object points up: x, y, z, xNeg, yNeg, zNeg.
Raises:
    FrameNotFound: There is no such frame.
    ArgumentError: There is no such face, or a shape is no box.)";

inline constexpr char push[] =
    R"(Between two times the object is pushed straight to a place, from behind, without turning.

Args:
    start: In phases: when the pusher touched it.
    end: In phases: when the object is there.
    pusher: The frame that pushes.
    obj: The object's frame.
    to: The place's frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char guide[] = R"(A hand that has held a handle since the time before moves its door or drawer.

Args:
    time: In phases.
    door: The frame of the door or drawer.
    handle: The part of it that is held.
    hand: The frame that holds it.
    opens: Until it is open; else until it is closed.
Raises:
    ArgumentError: It is no door.
    FrameNotFound: There is no such frame.)";

inline constexpr char doorStates[] = R"(The doors and drawers of a scene, and whether they are open.

A frame that is called is_door or is_drawer (`logical: { is_door }`), whose joint is active and has one dof and limits. It is
closed at the limit that is nearer to zero.

Args:
    C: The scene.
Returns:
    By name: 'opened' (from 80 % of the joint's range on), 'closed' (up to 5 %), or 'ajar'.)";

inline constexpr char start[] = R"(A starting point: hands near what they do.

Args:
    seed: Of placements and grasps that are drawn; None: placements are in the middle.
    grasps: Draws grasps, too.
Returns:
    The variables of the problem, shape (n,).)";

#undef KINEGRAPH_TASK_ARGUMENTS
#undef KINEGRAPH_TASK_RAISES

}  // namespace kinegraph::python::docs::tasks
