#pragma once

/// Docstrings for bind_joints.cpp.
namespace kinegraph::python::docs::joints {

inline constexpr char getJointNames[] =
    R"(Returns one name per entry of q: the joint's frame, followed by `:0`, `:1` ... if it has several dofs.

Returns:
    n names, then those of active joints that mimic others and have no entry of their own.)";

inline constexpr char getJointState[] = R"(Returns a copy of the joint vector q.

Args:
    joints: Names of frames with joints: returns only their dofs, in that order; None for all of q.
Returns:
    q, shape (n,), rad or m; or the dofs of the named frames.
Raises:
    FrameNotFound: A name is not in the scene.
    ArgumentError: A named frame has no joint.)";

inline constexpr char setJointState[] = R"(Sets the joint vector q. Limits are not enforced.

Args:
    q: Shape (n,), rad or m; or the dofs of the named frames.
    joints: Names of frames with joints: sets only their dofs, in that order; None for all of q.
Raises:
    ArgumentError: q has another size, or a named frame has no joint.
    FrameNotFound: A name is not in the scene.)";

inline constexpr char setRandom[] =
    R"(Samples q: each joint near its home with the deviation `sampleSdv` of its frame, or, with probability
`sampleUniform`, uniformly within its limits. ry.rnd_seed sets the seed.

Args:
    timeSlices_d1: Not used; accepted for older scripts.
    verbose: Not used; accepted for older scripts.)";

inline constexpr char selectJoints[] =
    R"(Activates the joints at or above the named frames: q and all Jacobians then consist of their dofs.

Args:
    jointNames: Names of frames.
    notThose: Activates all other joints instead, except those with `joint_active: false` in their file, such as
        fingers.
Raises:
    FrameNotFound: A name is not in the scene.)";

inline constexpr char getStateNames[] =
    R"(Returns the names of the stored joint states, from SRDF files or the attribute joint_states.

Args:
    group: Only the states of this group of joints; None for all.
Returns:
    The names.)";

inline constexpr char getNamedState[] =
    R"(Returns the current q with the values of a named state: C.setJointState(C.getNamedState("home")).

Args:
    name: Name of the state. Joints not named by the state keep their values.
    group: The state's group of joints; None merges the states of this name of all groups.
Returns:
    q, shape (n,), rad or m.
Raises:
    NotFound: No state has that name.)";

inline constexpr char getJointGroups[] = R"(Returns the groups of joints, from SRDF files or the attribute joint_groups.

Returns:
    A dict from the name of a group to the names of its frames, for selectJoints.)";

}  // namespace kinegraph::python::docs::joints
