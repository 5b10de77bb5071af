#pragma once

/// The manual of what bind_joints.cpp binds.
namespace kinegraph::python::docs::joints {

inline constexpr char getJointNames[] =
    R"(One name per entry of q: the joint's frame, with `:0`, `:1` ... where it has several dofs.

Returns:
    n names; behind them those of active joints that mimic others and so have no entry of their own.)";

inline constexpr char getJointState[] = R"(The joint vector q, a copy.

Args:
    joints: Names of frames with joints, to get only their dofs, in that order; None for all of q.
Returns:
    q, shape (n,), rad or m; or the dofs of the named frames.
Raises:
    FrameNotFound: A name that is not in the scene.
    ArgumentError: A named frame has no joint.)";

inline constexpr char setJointState[] = R"(Sets the joint vector q. Limits are not enforced.

Args:
    q: Shape (n,), rad or m; or the dofs of the named frames.
    joints: Names of frames with joints, to set only their dofs, in that order; None for all of q.
Raises:
    ArgumentError: q has another size, or a named frame has no joint.
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char setRandom[] =
    R"(Draws q at random: each joint near its home with the deviation `sampleSdv` of its frame, or, with the probability
`sampleUniform`, uniform within its limits. ry.rnd_seed seeds it.

Args:
    timeSlices_d1: Not used; older scripts pass it.
    verbose: Not used; older scripts pass it.)";

inline constexpr char selectJoints[] =
    R"(Makes the joints at or above the named frames the active ones: q and all Jacobians consist of their dofs.

Args:
    jointNames: Names of frames.
    notThose: All joints but these become active.
Raises:
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char getStateNames[] =
    R"(Names of the joint states that the scene knows, from SRDF files or the attribute joint_states.

Args:
    group: Only the states of this group of joints; None for all.
Returns:
    The names.)";

inline constexpr char getNamedState[] =
    R"(The present q with the values of a named state: C.setJointState(C.getNamedState("home")).

Args:
    name: Name of the state. Joints that it does not name keep their values.
    group: The group of joints that it belongs to; None takes the states of this name of all groups together.
Returns:
    q, shape (n,), rad or m.
Raises:
    NotFound: There is no state of that name.)";

inline constexpr char getJointGroups[] = R"(Groups of joints, from SRDF files or the attribute joint_groups.

Returns:
    A dict from the name of a group to the names of its frames, for selectJoints.)";

}  // namespace kinegraph::python::docs::joints
