#pragma once

/// The manual of what bind_structure.cpp binds.
namespace kinegraph::python::docs::structure {

inline constexpr char processStructure[] = R"(Simplifies the tree without moving anything.

Frames hang directly below the frame of their link's joint; a child at its parent's place that only has a shape hands
it to the parent; and leaves without joint, shape and mass are deleted, named ones too. Frames are sorted by depth.

Args:
    pruneRigidJoints: Rigid joints go as well.
    reconnectToLinks: False leaves the frames below the parents that they have.
    pruneNonContactShapes: Leaves that never collide, but markers, go as well.
    pruneTransparent: Leaves with an alpha below 1 go as well.)";

inline constexpr char processInertias[] = R"(Gathers the inertia of every link in its frame.

Args:
    recomputeInertias: First, opaque shapes weigh 5 kg per m^2 of surface, and transparent ones nothing.
    transformToDiagInertia: Link frames move to their center of mass and principal axes. One that cannot move,
        because it has a shape or dofs, gets a child <name>_inertia there, which holds the inertia.)";

inline constexpr char makeMeshesSSCvx[] =
    R"(Replaces every mesh by its convex hull, drawn in and then swept by a ball. Flat meshes stay.

Args:
    radius: Of the ball, m.)";

inline constexpr char recalibrateJointsToZero[] =
    R"(Makes the present q the zero of every joint: the motion goes into the frame above, and limits shift.

Raises:
    ArgumentError: A joint has several dofs, or the frame above is a root or has a shape, a mass, a joint or other
        joints below. Nothing has changed then.)";

inline constexpr char checkConsistency[] = R"(True if the data of all frames agree.

Raises:
    Error: They do not; the message names the first frame.)";

inline constexpr char getShapes[] = R"(The frames with a shape.

Args:
    shared_only_once: Of frames that share one shape only the first.
Returns:
    The frames, in order.)";

inline constexpr char selectJointsBySubtree[] = R"(Makes the joints at or below a frame the active ones, and no others.

Args:
    root: The frame: its name, id or Frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char addH5Object[] =
    R"(Adds a frame with the inertia of an HDF5 file, and children _mesh, _pts (points) and _decomp (convex parts, which
collide), as far as the file has the groups mesh, points, decomp and inertia.

Args:
    framename: Name of the frame.
    filename: Path of the file.
    verbose: Not used; older scripts pass it.
Returns:
    The frame.
Raises:
    FileError: The file cannot be read, or has none of these groups.)";

}  // namespace kinegraph::python::docs::structure
