#pragma once

/// Docstrings for bind_scene.cpp.
namespace kinegraph::python::docs::scene {

inline constexpr char addFile[] = R"(Adds the frames of a scene file.

An .srdf file (named states, groups, disabled collision pairs) extends the frames of its robot, which must be added
first; an .srdf file beside a .urdf file is read with it. Flaws of URDF and MJCF files are mended with a
KinegraphWarning, which fileWarnings keeps. On an error the scene is unchanged.

Args:
    filename: Path of a .g, .yml, .urdf, .srdf or .xacro file, or of a MuJoCo .xml file. Paths of shipped models:
        ry.raiPath; of the robots of installed packages: ry.robotPath.
    namePrefix: Prefix of the frame names.
    strict: True refuses a file with warnings; the ParseError lists them.
    xacro: Arguments of a .xacro file, by name. Such files need the package xacrodoc (kinegraph[xacro]).
    floating: Gives the root frame a free joint below a new frame `world`, for legged and other robots without a fixed
        base: q gets 7 more entries (position and quaternion), and the robot falls in a Simulation.
    orphans: A frame whose parent is unknown has no parent, and a warning, instead of an error.
Returns:
    The first added frame, or None if the file has none.
Raises:
    ArgumentError: floating, and the file has several roots, or its root is the world or has a joint.
    FileError: The file cannot be read.
    ParseError: The file has an error; the message has the file, the line and the column.)";

inline constexpr char addText[] = R"(Adds the frames of a scene text in .g syntax.

Args:
    text: The scene. On an error the current scene is unchanged.
    name: Name of the text in messages, in place of a file name; its extension selects the format.
    strict: True refuses a text with warnings; the ParseError lists them.
Returns:
    The first added frame, or None if the text has none.
Raises:
    ParseError: The text has an error; the message has the line and the column.)";

inline constexpr char fileWarnings[] = R"(Returns the warnings of all files and texts added since the last clear().

Returns:
    One "file:line:column: ..." per warning, with what was found and what was assumed.)";

inline constexpr char addFrame[] = R"(Appends a frame at the pose of its parent, or at the origin of the world.

The shape collides with nothing until `setContact(1)`, because `contact` is 0 at first.

Args:
    name: Name of the frame. If it exists, that frame is returned unchanged, with a warning.
    parent: The parent: its name, id or Frame; "" for a root.
    args: Attributes as in a .g file, such as "shape: box, size: [.1 .1 .1], contact: 1".
Returns:
    The frame.
Raises:
    FrameNotFound: The parent does not exist.
    ParseError: args has an error.
    Error: The name exists with another parent or other attributes.)";

inline constexpr char addConfigurationCopy[] = R"(Appends copies of all frames of another scene.

Args:
    config: The other scene.
    prefix: Prefix of the copies' names.
    tau: Not used; accepted for older scripts.
Returns:
    The first copy, or None if the other scene is empty.)";

inline constexpr char copyFrom[] = R"(Replaces this scene by a copy of another one.

Args:
    other: The other scene.)";

inline constexpr char delFrame[] = R"(Removes a frame. Its children become roots and keep their world poses.

Args:
    frame: Its name, id or Frame.
Raises:
    FrameNotFound: The frame does not exist.)";

inline constexpr char attach[] =
    R"(Cuts off the link of a frame and fixes it below another frame, keeping its world pose.

Args:
    frame1: Name of the new parent.
    frame2: Name of a frame of the attached link.
Raises:
    FrameNotFound: A frame does not exist.
    Error: frame1 is below frame2.)";

inline constexpr char getFrame[] = R"(Returns the first frame with a name.

Args:
    frameName: The name.
    warnIfNotExist: False returns None for an unknown name instead of raising an error.
Returns:
    The Frame.
Raises:
    FrameNotFound: The frame does not exist; the message has similar names.)";

inline constexpr char frame[] = R"(Returns the frame with a name or id.

Args:
    frame: Name or id. A Frame is returned unchanged.
Returns:
    The Frame.
Raises:
    FrameNotFound: The frame does not exist.)";

inline constexpr char setFrameState[] =
    R"(Sets world poses of frames. Frames with a joint move as far as the joint allows.

Args:
    X: Poses, shape (frames, 7): x y z (m) qw qx qy qz.
    frames: Names of the frames; without names, X has the poses of all frames in order.
Raises:
    ArgumentError: X has another shape.
    FrameNotFound: A name is not in the scene.)";

inline constexpr char checkFile[] = R"(Checks a scene file for errors and warnings, without adding it to a scene.

Args:
    filename: Path of the file (.g, .yml, .urdf, .xml).
Returns:
    A dict: messages (list of str, each with file:line:column, the line and a caret), and the numbers of errors,
    warnings and frames.
Raises:
    FileError: The file cannot be read.)";

}  // namespace kinegraph::python::docs::scene
