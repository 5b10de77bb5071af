#pragma once

/// Docstrings for bind_structure.cpp.
namespace kinegraph::python::docs::structure {

inline constexpr char processStructure[] = R"(Simplifies the tree and keeps all world poses.

Frames are attached directly below the frame of their link's joint; a child with only a shape at its parent's pose
passes the shape to the parent; leaves without joint, shape and mass are deleted, named ones too. Frames are sorted by
depth.

Args:
    pruneRigidJoints: Also removes rigid joints.
    reconnectToLinks: False keeps the parents of all frames.
    pruneNonContactShapes: Also removes leaves that never collide, except markers.
    pruneTransparent: Also removes leaves with an alpha below 1.)";

inline constexpr char processInertias[] = R"(Gathers the inertia of every link in its frame.

Args:
    recomputeInertias: First sets the mass of opaque shapes to 5 kg per m^2 of surface, and of transparent ones to 0.
    transformToDiagInertia: Moves link frames to their center of mass and principal axes. One that cannot move,
        because it has a shape or dofs, gets a child <name>_inertia there with the inertia.)";

inline constexpr char makeMeshesSSCvx[] =
    R"(Replaces every mesh by its convex hull, shrunk and then swept by a ball. Flat meshes are unchanged.

Args:
    radius: Radius of the ball, m.)";

inline constexpr char recalibrateJointsToZero[] =
    R"(Makes the current q the zero of every joint: the motion moves into the frame above, and limits shift.

Raises:
    ArgumentError: A joint has several dofs, or the frame above is a root or has a shape, a mass, a joint or other
        joints below. The scene is then unchanged.)";

inline constexpr char checkConsistency[] = R"(Returns True if the data of all frames are consistent.

Raises:
    Error: The data are inconsistent; the message names the first frame.)";

inline constexpr char getShapes[] = R"(Returns the frames with a shape.

Args:
    shared_only_once: Returns only the first of several frames that share a shape.
Returns:
    The frames, in order.)";

inline constexpr char selectJointsBySubtree[] = R"(Activates exactly the joints at or below a frame.

Args:
    root: The frame: its name, id or Frame.
Raises:
    FrameNotFound: The frame does not exist.)";

inline constexpr char addH5Object[] =
    R"(Adds a frame with the inertia of an HDF5 file, and children _mesh, _pts (points) and _decomp (colliding convex
parts), as far as the file has the groups mesh, points, decomp and inertia.

Args:
    framename: Name of the frame.
    filename: Path of the file.
    verbose: Not used; accepted for older scripts.
Returns:
    The frame.
Raises:
    FileError: The file cannot be read, or has none of these groups.)";

}  // namespace kinegraph::python::docs::structure
