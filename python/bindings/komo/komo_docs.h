#pragma once

/// Docstrings of the functions in bind_komo.cpp.
namespace kinegraph::python::docs::komo {

inline constexpr char addObjective[] = R"(Adds scale * (feature - target) as a cost or constraint in some slices.

Args:
    times: Phase times: [] for all slices, [t] for one, [from, to] inclusive.
    feature: A symbol of FS, or a custom function as for Config.eval.
    frames: Name of a frame, or a list of names.
    type: OT.sos, OT.eq, OT.ineq, OT.f, OT.ineqB or OT.ineqP.
    scale: A number, one per component of the feature, or a matrix.
    target: A number, or one per component, in the feature's units.
    order: Order of the time derivative; -1 for the feature's own.
    margin: For accumulatedCollisions, pairCollisions and distance: closer shapes count as colliding, m.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The frames do not fit the feature, times are outside of the path, or a size is wrong.)";

#define KINEGRAPH_OBJECTIVE_BY_NAME(time)                                                                      \
  "Adds scale * (feature - target) as a cost or constraint in some slices, with all arguments by name.\n\n"    \
  "Args:\n    " time                                                                                           \
  ": Phase times: [] for all slices, [t] for one, [from, to] inclusive.\n"                                     \
  "    feature: A symbol of FS, or a custom function as for Config.eval.\n"                                    \
  "    frames: Name of a frame, or a list of names.\n"                                                         \
  "    type: OT.sos, OT.eq, OT.ineq, OT.f, OT.ineqB or OT.ineqP.\n"                                            \
  "    scale: A number, one per component of the feature, or a matrix.\n"                                      \
  "    target: A number, or one per component, in the feature's units.\n"                                      \
  "    order: Order of the time derivative; -1 for the feature's own.\n"                                       \
  "    margin: For accumulatedCollisions, pairCollisions and distance: closer shapes count as colliding, m.\n" \
  "Raises:\n    FrameNotFound: A frame is not in the scene.\n"                                                 \
  "    ArgumentError: The frames do not fit the feature, times are outside of the path, or a size is wrong."
inline constexpr char addObjectiveByName[] = KINEGRAPH_OBJECTIVE_BY_NAME("time");
inline constexpr char addObjectiveByTimes[] = KINEGRAPH_OBJECTIVE_BY_NAME("times");
#undef KINEGRAPH_OBJECTIVE_BY_NAME

inline constexpr char addObjectivePerSlice[] =
    R"(Adds scale * (feature - target) with a target of its own in each slice.

    komo.addObjectivePerSlice([0, 1], ry.FS.position, ["tool"], ry.OT.eq, points)  # (K, 3)

Args:
    times: Phase times: [] for all slices, [from, to] inclusive.
    feature: A symbol of FS, or a custom function as for Config.eval.
    frames: Name of a frame, or a list of names.
    type: OT.sos, OT.eq, OT.ineq, ...
    targets: Shape (K, d): one row per selected slice, in the feature's units.
    scale: A number, one per component of the feature, or a matrix.
    order: Order of the time derivative; -1 for the feature's own.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The number of rows is not that of the slices, or a size is wrong.)";

inline constexpr char addFreeMotion[] =
    R"(Keeps all shapes that may collide apart, in slices and continuously between them.

Between slices q moves linearly, and attached objects move along. The solver first considers the slices. If the motion
between them violates the margin, it adds constraints at the times of violation and continues. A result that it calls
feasible satisfies the margin continuously. If the start is closer to an obstacle than the margin, the margin of the
motion to the first slice is half of the initial distance.

Args:
    times: Phase times: None or [] for the whole path, [from, to] for a part of it.
    margin: Minimum distance of shapes, m; the solver aims for 1 mm more.
    scale: Weight of a violation of 1 m in the residuals.
Raises:
    ArgumentError: The margin is negative, the scale is not positive, or times are outside of the path.)";

inline constexpr char addStepLimit[] =
    R"(Limits the motion of each joint from one slice to the next. Requires a kOrder of 1 or more.

Args:
    step: Largest step, rad or m.
    times: Phase times: None or [] for the whole path, [from, to] for a part of it.
Raises:
    ArgumentError: The step is not positive, kOrder is 0, or times are outside of the path.)";

inline constexpr char addControlObjective[] =
    R"(Adds the sum of squares of a time derivative of all dofs as a cost; for order 0, of the distance from home.

Args:
    times: Phase times: [] for all slices, [t] for one, [from, to] inclusive.
    order: 0 for the distance from home, 1 for velocities, 2 for accelerations.
    scale: Factor.
    target: Target of the derivative, one number per dof; None for 0.
    deltaFromSlice: Added to the first slice.
    deltaToSlice: Added to the last slice.
Raises:
    ArgumentError: The order exceeds that of the KOMO, or a size is wrong.)";

inline constexpr char addQuaternionNorms[] = R"(Keeps quaternions among the dofs at norm 1.

Args:
    times: Phase times: [] for all slices, [t] for one, [from, to] inclusive.
    scale: Factor.
    hard: True for constraints, False for costs.
Raises:
    ArgumentError: Times are outside of the path.)";

inline constexpr char addModeSwitch[] =
    R"(Changes the parent of an object from a time on: frames[1] is then attached to frames[0].

Args:
    times: [from, to], phase times; to is the time of the next switch, or -1.
    newMode: SY.stable (a grasp), stableOn (on a box), stableOnX, stableOnY, stableYPhi, stableZero, dynamic (flying or
        pushed), dynamicOn (sliding), dynamicTrans, quasiStatic or quasiStaticOn (contact forces balance friction),
        magic or magicTrans (unconstrained motion).
    frames: Names [parent, object].
    firstSwitch: True also requires a continuous motion of the object at the beginning of the mode.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The number of frames is wrong, or times are outside of the path.)";

inline constexpr char addRigidSwitch[] = R"(Attaches an object rigidly to a frame from a time on.

Args:
    times: The phase time.
    frames: Names [parent, object].
    noJumpStart: True requires a continuous motion of the object at the switch.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The number of frames is wrong.)";

inline constexpr char addFrameDof[] = R"(Adds a frame with a joint to all slices.

Args:
    name: Name of the new frame.
    parent: Name of its parent.
    jointType: A type of JT.
    stable: True for one value of the joint in all slices, False for one per slice.
    originFrameName: Name of the frame whose pose is the origin of the joint; None for the parent's pose.
    originFrame: This frame itself, with the pose that it has, for example from getFrame at another time.
Returns:
    A copy of the new frame.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The name exists already.)";

inline constexpr char addContactForceFrame[] =
    R"(Lets a body push an object at a point of contact, along the z axis of a new frame on the object.

The force is one dof per slice, in units of the weight of init_objMass. FS.totalForce and FS.physics balance it, about
the object's own center of mass.

Args:
    times: Phase times: [t] for one slice, [from, to] inclusive.
    obj: Name of the object.
    from_: Name of the body.
    frictionCone_mu: Friction coefficient.
    init_objMass: Approximate mass of the object, kg.
    obj_com_frame: Ignored; accepted for older scripts.
Returns:
    A copy of the new frame.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: Times are outside of the path.)";

inline constexpr char addContact_WithPoaFrame[] =
    R"(Lets a body push an object at a point with any force in the friction cone: three dofs per slice.

Args:
    time: Phase times: [t] for one slice, [from, to] inclusive.
    obj: Name of the object.
    from_: Name of the body.
    frictionCone_mu: Friction coefficient.
    init_objMass: Approximate mass of the object, kg.
    init_POAdist: Initial distance of the point from the object, m.
Returns:
    A copy of the new frame.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: Times are outside of the path.)";

inline constexpr char addContact[] =
    R"(Lets two bodies push each other at a point that moves along both surfaces.

Adds six dofs per slice: the point, and the force on `obj` there in units of its weight. FS.totalForce and FS.physics
balance the forces.

Args:
    times: Phase times: [t] for one slice, [from, to] inclusive.
    obj: Name of the object.
    from_: Name of the other body.
    kind: "slide" (they touch, the force is along the normal), "stick" (no sliding; with kOrder 0 the force is within
        the friction cone), "complementary" (no force without contact) or "bounce" (in one slice; requires kOrder 2).
    friction: Friction coefficient.
Returns:
    The name of the frame at the point.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The kind does not exist, or times are outside of the path.)";

inline constexpr char addTimeOptimization[] = R"(Raises an error: time optimization is not available.

Raises:
    Error: Always; set durations with setTiming.)";

inline constexpr char makePath[] =
    R"(Makes a path of phases * slicesPerPhase slices. With 1, 1 and kOrder 0 it is inverse kinematics.

Args:
    config: The scene.
    phases: Number of phases.
    slicesPerPhase: Slices per phase.
    kOrder: Highest order of time derivatives: features may depend on kOrder + 1 consecutive slices.
    enableCollisions: Ignored, except for a warning about initial contacts: objectives enable collisions.
Raises:
    ArgumentError: The number of slices or the order is invalid.)";

inline constexpr char setConfig[] = R"(Sets the scene.

Args:
    config: The scene.
    enableCollisions: Ignored: objectives enable collisions.)";

inline constexpr char setTiming[] = R"(Sets the time grid.

Args:
    phases: Number of phases.
    slicesPerPhase: Slices per phase.
    durationPerPhase: Duration of a phase, s.
    kOrder: Highest order of time derivatives.
Raises:
    ArgumentError: A number is invalid.)";

inline constexpr char optimize[] = R"(Solves the problem from the present path.

Args:
    addInitializationNoise: Standard deviation of noise added to the path first, rad or m.
    verbose: 1 logs a line at the end, higher values log the steps.
Returns:
    The SolverReturn.
Raises:
    Error: The scene or the timing is missing.)";

inline constexpr char explain[] =
    R"(Describes which objectives and limits contradict each other near the present path.

The text names their slices, the conflicts in m or rad, and the single constraint whose relaxation helps most. Solves
small problems; the path does not change.

Args:
    tolerance: Largest violation that counts as none.
Returns:
    A few lines of text.)";

inline constexpr char conflicts[] = R"(Returns the conflicts that explain describes.

Args:
    tolerance: Largest violation that counts as none.
Returns:
    A dict per constraint, as from SolverReturn.conflicts.)";

}  // namespace kinegraph::python::docs::komo
