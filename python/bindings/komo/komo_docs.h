#pragma once

/// The manual of what bind_komo.cpp binds.
namespace kinegraph::python::docs::komo {

inline constexpr char addObjective[] = R"(Adds scale * (feature - target) as costs or constraints of some slices.

Args:
    times: In phases: [] all slices, [t] one, [from, to] both included.
    feature: A symbol of FS, or a function of your own as for Config.eval.
    frames: The name of a frame, or a list of names.
    type: OT.sos, OT.eq, OT.ineq, OT.f, OT.ineqB or OT.ineqP.
    scale: A number, one per row of the feature, or a matrix.
    target: A number, or one per row of the feature, in the feature's units.
    order: Of the time derivative; -1: what is usual for the feature.
    margin: Of accumulatedCollisions, pairCollisions and distance: shapes that are nearer count as colliding, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The feature cannot be made of these frames, times are not in the path, or a size does not fit.)";

inline constexpr char addObjectiveByName[] =
    R"(Adds scale * (feature - target) as costs or constraints of some slices, all arguments by name.

Args:
    time: In phases: [] all slices, [t] one, [from, to] both included.
    feature: A symbol of FS, or a function of your own as for Config.eval.
    frames: The name of a frame, or a list of names.
    type: OT.sos, OT.eq, OT.ineq, OT.f, OT.ineqB or OT.ineqP.
    scale: A number, one per row of the feature, or a matrix.
    target: A number, or one per row of the feature, in the feature's units.
    order: Of the time derivative; -1: what is usual for the feature.
    margin: Of accumulatedCollisions, pairCollisions and distance: shapes that are nearer count as colliding, m.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The feature cannot be made of these frames, times are not in the path, or a size does not fit.)";

inline constexpr char addFreeMotion[] =
    R"(Keeps all shapes that may collide apart, in slices and at all times cancellation them; q goes straight from slice to slice,
and objects that are attached move along. The solver first looks at the slices; where the motion cancellation them comes too
near to something, it takes up the instants at which it does, and goes on. What it then calls feasible keeps the margin at
all times. Where the start is nearer to something than the margin, the motion to the first slice keeps half of that.

Args:
    times: In phases: None or [] the whole path, [from, to] a part of it.
    margin: How far shapes keep apart, m; the solver aims at 1 mm more.
    scale: Of the residuals: how much a violation of 1 m counts.
Raises:
    ArgumentError: A negative margin, a scale that is not positive, or times that are not in the path.)";

inline constexpr char addStepLimit[] =
    R"(Lets no joint move by more than a step from one slice to the next. It needs a kOrder of 1 or more.

Args:
    step: The largest step, rad or m.
    times: In phases: None or [] the whole path, [from, to] a part of it.
Raises:
    ArgumentError: A step that is not positive, a kOrder of 0, or times that are not in the path.)";

inline constexpr char addControlObjective[] =
    R"(Adds the sum of squares of a time derivative of all dofs as cost; for order 0, of the distance from home.

Args:
    times: In phases: [] all slices, [t] one, [from, to] both included.
    order: 0: distance from home; 1: velocity; 2: acceleration.
    scale: Factor.
    target: Of the derivative, one number per dof; None: 0.
    deltaFromSlice: Added to the first slice.
    deltaToSlice: Added to the last slice.
Raises:
    ArgumentError: The order is higher than that of the KOMO, or a size does not fit.)";

inline constexpr char addQuaternionNorms[] = R"(Keeps the length of quaternion dofs at 1.

Args:
    times: In phases: [] all slices, [t] one, [from, to] both included.
    scale: Factor.
    hard: As constraints; False: as costs.
Raises:
    ArgumentError: Times that are not in the path.)";

inline constexpr char addModeSwitch[] =
    R"(Changes what carries an object, from a time on: frames[1] hangs below frames[0] then.

Args:
    times: [from, to] in phases; to: when the next switch follows, or -1.
    newMode: SY.stable (a grasp), stableOn (on a box), stableOnX, stableOnY, stableYPhi, stableZero, dynamic (flies,
        or is pushed), dynamicOn (slides), dynamicTrans, quasiStatic or quasiStaticOn (moves as far as contact forces
        push it), magic or magicTrans (moves as it likes).
    frames: Names: [parent, object].
    firstSwitch: False: the object does not jump where the switch begins.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another number of frames, or times that are not in the path.)";

inline constexpr char addRigidSwitch[] = R"(Puts an object at a frame, rigidly, from a time on.

Args:
    times: The time in phases.
    frames: Names: [parent, object].
    noJumpStart: The object does not jump when the switch begins.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Another number of frames.)";

inline constexpr char addFrameDof[] = R"(Adds a frame with a joint to all slices.

Args:
    name: Of the new frame.
    parent: Name of the frame above.
    jointType: Of JT.
    stable: One value of the joint for all slices.
    originFrameName: Name of the frame at whose pose it starts; None: at the parent's.
    originFrame: That frame itself, at the pose that it has, as from getFrame at another time.
Returns:
    A copy of the new frame.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: The name exists.)";

inline constexpr char addContactForceFrame[] =
    R"(Lets a body push an object where they touch, along the z axis of a frame on the object that is added. One dof per
slice is the force, in units of the weight of init_objMass. FS.totalForce and FS.physics balance it, about the
object's own center of mass.

Args:
    times: In phases: [t] one slice, [from, to] both included.
    obj: Name of the object.
    from_: Name of the body.
    frictionCone_mu: Coefficient of friction.
    init_objMass: About the object's mass, kg.
    obj_com_frame: Not used; older scripts pass it.
Returns:
    A copy of the frame that was added.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Times that are not in the path.)";

inline constexpr char addContact_WithPoaFrame[] =
    R"(Lets a body push an object at a point with a force of any direction within the cone of friction: three dofs per slice.

Args:
    time: In phases: [t] one slice, [from, to] both included.
    obj: Name of the object.
    from_: Name of the body.
    frictionCone_mu: Coefficient of friction.
    init_objMass: About the object's mass, kg.
    init_POAdist: Distance of the point from the object at first, m.
Returns:
    A copy of the frame that was added.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: Times that are not in the path.)";

inline constexpr char addContact[] =
    R"(Lets two bodies push each other at a point that moves along both: six more dofs per slice, the point and the force on
`obj` there, in weights of `obj`. What balances the forces is up to FS.totalForce and FS.physics.

Args:
    times: In phases: [t] one slice, [from, to] both included.
    obj: Name of the object.
    from_: Name of the other body.
    kind: "slide" (they touch, the force is along the normal), "stick" (they do not slide; in a KOMO of kOrder 0 the
        force is within the cone of friction), "complementary" (no force where they do not touch) or "bounce" (off
        each other, in one slice; kOrder 2).
    friction: Coefficient of friction.
Returns:
    The name of the frame at the point.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: There is no such kind, or times that are not in the path.)";

inline constexpr char addTimeOptimization[] = R"(Not available.

Raises:
    Error: Always; durations are given with setTiming.)";

inline constexpr char makePath[] =
    R"(A path of phases * slicesPerPhase slices. With 1, 1 and kOrder 0 it is inverse kinematics.

Args:
    config: The scene that moves.
    phases: Number of phases.
    slicesPerPhase: Slices per phase.
    kOrder: Highest order of time derivatives: features are of up to kOrder + 1 consecutive slices.
    enableCollisions: Not used: collisions are computed where objectives ask for them.
Raises:
    ArgumentError: A number of slices, or an order, that makes no sense.)";

inline constexpr char setConfig[] = R"(Sets the scene that moves.

Args:
    config: The scene.
    enableCollisions: Not used: collisions are computed where objectives ask for them.)";

inline constexpr char setTiming[] = R"(Sets the time grid.

Args:
    phases: Number of phases.
    slicesPerPhase: Slices per phase.
    durationPerPhase: In s.
    kOrder: Highest order of time derivatives.
Raises:
    ArgumentError: A number that makes no sense.)";

inline constexpr char optimize[] = R"(Solves from the present path.

Args:
    addInitializationNoise: Standard deviation of what is added to the path first, rad or m.
    verbose: 1 prints a line at the end, more prints steps.
Returns:
    The SolverReturn.
Raises:
    Error: There is no problem yet.)";

inline constexpr char explain[] =
    R"(Says which objectives and limits contradict each other around the present path, in which slices, by how many m or
rad, and which single one helps most if it gives way. Solves small problems; the path stays.

Args:
    tolerance: Largest violation that counts as none.
Returns:
    A few lines.)";

inline constexpr char conflicts[] = R"(What explain says.

Args:
    tolerance: Largest violation that counts as none.
Returns:
    A dict per constraint, as of SolverReturn.conflicts.)";

}  // namespace kinegraph::python::docs::komo
