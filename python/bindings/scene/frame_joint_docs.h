#pragma once

/// The manual of what bind_frame_joint.cpp binds.
namespace kinegraph::python::docs::frame_joint {

inline constexpr char computeCompoundInertia[] =
    R"(Gathers the inertias of the frame and of all that is fixed to it from below in the frame; the others lose theirs.
Returns the frame itself.)";

inline constexpr char transformToDiagInertia[] =
    R"(Moves the frame to its center of mass and turns it to its principal axes of inertia. What is below it stays in place.

Args:
    transformMesh: The points of the frame's mesh stay in place as well.
Returns:
    The motion, shape (7,): x y z (m) qw qx qy qz of the new frame in the old one.
Raises:
    ArgumentError: The frame has no mass, or it has dofs, or a shape that would have to move.)";

inline constexpr char setMass[] = R"(Sets mass and inertia of the frame.

Args:
    mass: In kg; 0 removes it.
    inertiaMatrix: 3, 6 or 9 numbers, kg m^2: the diagonal, the upper triangle, or the matrix; None: that of the
        surface of the frame's shape.
Returns:
    The frame itself.
Raises:
    ArgumentError: A negative mass, or another number of entries.)";

inline constexpr char getInertia[] =
    R"(Mass (kg), center of mass (3,) in m and inertia about it (3, 3) in kg m^2, both in the frame; (0, [], []) without a
mass.)";

inline constexpr char setJoint[] = R"(Gives the frame a joint to its parent.

Args:
    jointType: Of JT; JT.none removes the joint.
    limits: All lower, then all upper bounds, rad or m; None: no limits.
    axis: Of a JT.hinge, in the frame, shape (3,).
    scale: Motion per unit of q.
    mimic: A frame with a joint whose dofs this one follows.
Returns:
    The frame itself.
Raises:
    ArgumentError: Limits or axis of another size, or a frame without a parent.)";

inline constexpr char setJointState[] = R"(Sets the joint's dofs.

Args:
    q: Shape (k,), rad or m.
Returns:
    The frame itself.
Raises:
    ArgumentError: The frame has no joint, or one with another number of dofs.)";

inline constexpr char getJointQIndex[] =
    R"(Where the joint's dofs begin in q; a mimic has the index of its source. Of an inactive joint: the index among the
dofs of all inactive joints.

Raises:
    ArgumentError: The frame has no joint.)";

inline constexpr char setJointSampleStdDev[] = R"(Sets how far from its home setRandom draws the joint.

Args:
    deviation: Standard deviation, rad or m, 0 or more.
Returns:
    The frame itself.
Raises:
    ArgumentError: A negative number, or a frame without a joint.)";

}  // namespace kinegraph::python::docs::frame_joint
