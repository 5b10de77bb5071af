#pragma once

/// The docstrings of bind_tool_paths.cpp.
namespace kinegraph::python::docs::tool_path {

inline constexpr char ToolPath[] =
    R"(A curve of poses that a frame, the tool, follows. It has lines, arcs, circles, splines, and dense rows of poses.

    path = ry.ToolPath("pen", relativeTo="part").start(first).line(second).arc(via, third, blend=.01).free()

Poses are arrays of shape (7,): x y z qw qx qy qz, m; or positions (3,), at which the tool keeps the rotation that it
has. They are in the coordinates of the world or of another frame, which may move. The place of the tool on the path is
its distance along the curve in m; a rotation on the spot counts .1 m per rad. Methods return the path itself.)";

inline constexpr char make[] =
    R"(Makes a path without elements.

Args:
    frame: Name of the frame that moves along the path.
    relativeTo: Name of the frame in whose coordinates poses are given; None: the world. Either frame may move: the
        part may be in the hand, or on a positioner.)";

inline constexpr char along[] =
    R"(Makes a path from dense rows of points or poses, samples of a smooth curve.

A spline is fitted to the rows within a quarter of the tolerance of planToolPath. Corners between rows stay if they are
sharper than 1 rad, or sharper than .35 rad and than those beside them: the tool stops there.

Args:
    points: Shape (K, 3), m, or poses (K, 7): x y z qw qx qy qz.
    normals: Shape (K, 3): the direction of the tool's z axis at each point. None: poses, or the tool keeps its
        rotation.
    frame: Name of the frame that moves along the path.
    relativeTo: Name of the frame in whose coordinates rows are given; None: the world.
Returns:
    A ToolPath.
Raises:
    ValueError: Another shape, fewer than two rows, or numbers that are not finite.)";

inline constexpr char read[] =
    R"(Reads a path from a text file with one row per line.

Rows have 3 numbers (x y z, m), 6 (with a normal) or 7 (x y z qw qx qy qz), separated by commas, semicolons or spaces.
Columns are in this order, unless a first line names them: x y z, and nx ny nz or qw qx qy qz, in any order. Names may
have a unit, such as x_mm or X [mm], and columns with other names are ignored with a line in `warnings`. Other first
lines without numbers are skipped, and so is the text behind #. Files with the extension .nc, .ngc, .gcode, .gc, .tap or
.cnc are read by readGcode.

Args:
    file: Path of the file.
    frame: Name of the frame that moves along the path.
    relativeTo: Name of the frame in whose coordinates rows are given; None: the world.
Returns:
    A ToolPath.
Raises:
    FileError: The file cannot be read.
    ParseError: The file has other content; the message has line and column.)";

inline constexpr char readGcode[] =
    R"(Reads a path from a program of G-code.

It knows G0 to G3 in the planes G17 to G19, with arcs and helices by I J K or R. Units are mm (G21, the default) or inch
(G20), coordinates absolute (G90, the default) or relative (G91), and F is per minute. G64 P sets the radius of blends,
and G61 ends them. G90.1 makes centers of arcs absolute. Moves with G0, and those before the first F, have the speed of
planToolPath. The path starts where the first moves that name all axes end; axes that are named later start at 0. Moves
to places of the machine (G28, G30, G53), tool lengths (G43), and spindle, coolant, tool and dwell commands are ignored,
each with a line in `warnings`.

Args:
    file: Path of the file.
    frame: Name of the frame that moves along the path; it keeps its rotation.
    relativeTo: Name of the frame at the program's zero point; None: the world.
    blend: Radius (m) at corners until G64 P or G61 sets another one; 0: the tool stops.
Returns:
    A ToolPath.
Raises:
    FileError: The file cannot be read.
    ParseError: The file has a word that is not known, or an impossible arc; the message has line and column.
    ValueError: blend is negative.)";

inline constexpr char start[] =
    R"(Sets the first pose. Without it, the path starts at the pose of the tool at the time of planning.

Args:
    pose: Shape (7,) or (3,).
Returns:
    The path itself.
Raises:
    ValueError: A pose has another number of entries, or they are not finite.)";

inline constexpr char line[] =
    R"(Appends a straight line; the tool rotates at a constant rate.

Args:
    pose: Its end, shape (7,), or (3,) to keep the rotation.
    blend: Radius (m) of the sphere around the corner at its start, within which a curve with continuous curvature
        replaces the corner; 0: the tool stops at the corner. Radii that overlap are reduced, with a warning. Corners
        beside splines and rows are not blended, with a warning.
Returns:
    The path itself.
Raises:
    ValueError: The pose has another number of entries, or blend is negative.)";

inline constexpr char arc[] =
    R"(Appends a circular arc.

Args:
    via: A position on the arc, shape (3,), m.
    pose: Its end, shape (7,), or (3,) to keep the rotation.
    blend: As for line.
Returns:
    The path itself.
Raises:
    ValueError: A pose has another number of entries, or blend is negative.)";

inline constexpr char circle[] =
    R"(Appends a circle or a part of it. The tool keeps its rotation.

Args:
    center: Shape (3,), m.
    axis: Direction of the axis, shape (3,).
    angle: rad, counterclockwise about the axis; may be negative, and larger than a full circle.
    blend: As for line.
    advance: Way along the axis, m: a helix.
Returns:
    The path itself.
Raises:
    ValueError: An array has another length, or the axis has no direction.)";

inline constexpr char spline[] =
    R"(Appends a cubic spline through the present end and all of these poses.

Args:
    poses: Shape (K, 7), or (K, 3) to keep the rotation.
Returns:
    The path itself.
Raises:
    ValueError: A pose has another number of entries, or they are not finite.)";

inline constexpr char speedOfElements[] =
    R"(Sets the speed of the tool on the elements that are appended from now on.

Args:
    speed: m/s; 0: that of planToolPath.
Returns:
    The path itself.
Raises:
    ValueError: speed is negative.)";

inline constexpr char free[] =
    R"(Frees the rotation about an axis of the tool. It is an angle from the poses of the path.

Args:
    about: "x", "y" or "z".
    range: Least and largest angle, rad; None: a whole turn. The tool is never outside of it.
    prefer: Angle (rad) that is kept all along if a motion can do so; else angles near it are preferred. None: all are
        equal.
Returns:
    The path itself.
Raises:
    ValueError: about is another text, the range is empty, or prefer is outside of it.)";

inline constexpr char lean[] =
    R"(Leans the tool of all rows that have normals so far.

The tool's z axis turns by `travel` towards the direction of the path, then by `work` to its left, seen along the path
with z up: the travel angle and the work angle of welding. `tilt` allows deviations instead.

Args:
    travel: Between -pi / 2 and pi / 2, rad.
    work: Between -pi / 2 and pi / 2, rad.
Returns:
    The path itself.
Raises:
    ArgumentError: Another angle, a path without rows with normals, or normals along the path.)";

inline constexpr char tilt[] =
    R"(Allows the free axis to lean from its direction within a cone. Frees the rotation about z if no axis is free.

Args:
    angle: Half angle of the cone, rad, below pi / 2.
Returns:
    The path itself.
Raises:
    ValueError: The angle is not between 0 and pi / 2.)";

inline constexpr char ToolPathPlan[] =
    R"(The motion that planToolPath found, or the reason why there is none; a Trajectory. True if there is a motion.)";

inline constexpr char view[] =
    R"(Shows the paths and the motion on the page of the scene.

The page has the curves that were asked (gray), and the way of the tool: green at its largest speed, yellow at half of
it, red at rest. There are axes at both ends, cones of free axes, and the place of a failure with its cause. The page
plays the motion, or the configurations up to the failure. Later calls replace the drawings.

Args:
    config: The scene of the call, with the same q.
    paths: The paths of the call.
    pause: True waits for a key.
Returns:
    Code of the key, or 0.
Raises:
    FrameNotFound: A frame of a path does not exist.
    ValueError: The scene has other joints.)";

inline constexpr char way[] =
    R"(Returns the place of the tool.

Args:
    t: Time, s, clamped to the duration.
Returns:
    Index of the path, -1 on a transfer, and the place on it, m from its start; negative on an approach.
Raises:
    ValueError: There is no motion, or t is NaN.)";

inline constexpr char speed[] =
    R"(Returns the speed of the tool along its path.

Args:
    t: Time, s, clamped to the duration.
Returns:
    m/s; 0 on a transfer.
Raises:
    ValueError: There is no motion, or t is NaN.)";

inline constexpr char plan[] =
    R"(Plans the motion of a robot whose tool follows paths.

The branch of the inverse kinematics, and the angles that a path leaves free, come from a search: all solutions at the
start of a path are followed along it, and a graph of their configurations is searched if none gets to the end without
collision. There is no threshold for jumps. The deviation of the tool from its curve and freedom of collisions are
proven for all times. The tool moves at the given speed where the limits of the joints allow it, and as fast as they
allow elsewhere; plan.slow lists where. Paths are connected by planMotion. The Config is not changed, and equal
arguments give equal bits.

Args:
    config: Scene; its q is tried first.
    paths: A ToolPath or a sequence of them.
    speed: Speed of the tool where the path has no speed of its own, m/s.
    order: "given", or "free": any order, each path from either end.
    approach: Length (m) of a straight approach along the tool's free axis, or z, before each path. 0: none. It is on
        the side of the tool's own link, whether the axis points into the work or out of it.
    retract: Length (m) of a straight retract after each path. 0: none.
    flow: Where transfers end with the speed of what follows, if that takes less time: "approach"; "path" also at paths
        without an approach, whose start the tool then passes without a stop; "none": all start at rest.
    tolerance: Largest distance of the tool from the curve, m.
    rotation_tolerance: Largest rotation of the tool, or of its free axis, from the curve, rad. With a cone, the axis is
        never outside of it.
    margin: Distance that all pairs keep, m.
    touching: Names of frames that the tool's link may touch.
    start: Configuration at the start of the first path, shape (n,): its branch is then given. None: the best one.
    transfer_from: Configuration of the robot, shape (n,); adds a transfer from there to the first path. None: the
        motion begins at the first path.
    velocity: Limit of |dq/dt|, a number or one per joint. None: the model's.
    acceleration: Limit of |d2q/dt2|. None: full speed within a quarter of a second.
    jerk: Limit of |d3q/dt3|. None: no limit.
    tool_acceleration: Limit along the path, m/s^2.
    tool_jerk: Limit along the path, m/s^3; counts if jerk is given.
    time_limit: Ends the search after so many seconds.
    seed: Of the samples.
    verbose: 1 logs a line at the end, and shows a progress bar during long searches.
Returns:
    A ToolPathPlan.
Raises:
    FrameNotFound: A frame of a path or in touching does not exist.
    ValueError: An argument is invalid, or no joint moves a tool.)";

}  // namespace kinegraph::python::docs::tool_path
