#pragma once

/// Docstrings for bind_frame_joint.cpp.
namespace kinegraph::python::docs::frame_joint {

inline constexpr char computeCompoundInertia[] =
    R"(Gathers the inertias of the frame and of all frames fixed below it in the frame; the others lose theirs.
Returns the frame itself.)";

inline constexpr char transformToDiagInertia[] =
    R"(Moves the frame to its center of mass and rotates it to its principal axes. Frames below keep their world poses.

Args:
    transformMesh: Keeps the points of the frame's mesh in place as well.
Returns:
    The motion, shape (7,): x y z (m) qw qx qy qz of the new frame in the old one.
Raises:
    ArgumentError: The frame has no mass, or it has dofs or a shape that cannot stay in place.)";

inline constexpr char setMass[] = R"(Sets mass and inertia of the frame.

Args:
    mass: In kg; 0 removes it.
    inertiaMatrix: 3, 6 or 9 numbers, kg m^2: the diagonal, the upper triangle, or the matrix; None: the inertia of
        the surface of the frame's shape.
Returns:
    The frame itself.
Raises:
    ArgumentError: The mass is negative, or the matrix has another number of entries.)";

inline constexpr char getInertia[] =
    R"(Returns mass (kg), center of mass (3,) in m and inertia about it (3, 3) in kg m^2, in the frame's coordinates.
Without a mass returns (0, [], []).)";

inline constexpr char setJoint[] =
    R"(Gives the frame a joint to its parent, whose dofs are those nearest to the present relative pose.

A warning says what the joint does not express of it: a hinge has no offset. Give the offset to a frame in between.

Args:
    jointType: A JT; JT.none removes the joint.
    limits: All lower, then all upper bounds, rad or m; None: unlimited.
    axis: Axis of a JT.hinge, in the frame, shape (3,).
    scale: Motion per unit of q.
    mimic: A frame with a joint whose dofs this joint follows.
Returns:
    The frame itself.
Raises:
    ArgumentError: Limits or axis have another size, or the frame has no parent.)";

inline constexpr char setJointState[] = R"(Sets the joint's dofs.

Args:
    q: Shape (k,), rad or m.
Returns:
    The frame itself.
Raises:
    ArgumentError: The frame has no joint, or one with another number of dofs.)";

inline constexpr char getJointQIndex[] =
    R"(Returns the index in q of the joint's first dof; a mimic has the index of its source.

For an inactive joint, returns the index among the dofs of all inactive joints.

Raises:
    ArgumentError: The frame has no joint.)";

inline constexpr char setJointSampleStdDev[] = R"(Sets the standard deviation of the joint around its home in setRandom.

Args:
    deviation: Standard deviation, rad or m, >= 0.
Returns:
    The frame itself.
Raises:
    ArgumentError: The deviation is negative, or the frame has no joint.)";

}  // namespace kinegraph::python::docs::frame_joint
