#pragma once

/// The manual of what bind_scene.cpp binds.
namespace kinegraph::python::docs::scene {

inline constexpr char addFile[] = R"(Adds the frames of a scene file.

What an .srdf file says (named states, groups, pairs that never collide) goes to the frames of its robot, which must
be there already; an .srdf file beside a .urdf file is read with it. An error leaves the scene as it was.

Args:
    filename: Path of a .g, .yml, .urdf or .srdf file, or of a MuJoCo .xml file. Paths of shipped models: ry.raiPath.
    namePrefix: Put in front of the name of each frame.
Returns:
    The first frame that was added, or None if the file has none.
Raises:
    FileError: The file cannot be read.
    ParseError: A mistake in the file; it has the file, the line and the column.)";

inline constexpr char addText[] = R"(Adds the frames of a scene given as text in .g syntax.

Args:
    text: The scene. An error leaves the present scene as it was.
    name: What messages call the text in place of a file name.
Returns:
    The first frame that was added, or None if the text has none.
Raises:
    ParseError: A mistake in the text; it has the line and the column.)";

inline constexpr char addFrame[] = R"(Appends a frame at the pose of its parent, or at the origin of the world.

A shape that is set later collides with nothing until `setContact(1)` says so: `contact` is 0 at first.

Args:
    name: Its name. If the name exists, that frame is returned as it is, with a warning.
    parent: The frame above: its name, id or Frame; "" for a root.
    args: Attributes as in a .g file, such as "shape: box, size: [.1 .1 .1], contact: 1".
Returns:
    The frame.
Raises:
    FrameNotFound: There is no such parent.
    ParseError: A mistake in args.
    Error: The name exists with another parent or other attributes.)";

inline constexpr char addConfigurationCopy[] = R"(Appends copies of all frames of another scene.

Args:
    config: The other scene.
    prefix: Put in front of the name of each copy.
    tau: Not used; older scripts pass it.
Returns:
    The first copy, or None if the other scene is empty.)";

inline constexpr char copyFrom[] = R"(Becomes a copy of another scene.

Args:
    other: The other scene.)";

inline constexpr char delFrame[] = R"(Removes a frame. Its children stay where they are, as roots.

Args:
    frame: Its name, id or Frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char attach[] =
    R"(Cuts the link of a frame off and attaches it, where it is, rigidly below another frame.

Args:
    frame1: Name of the new parent.
    frame2: Name of the frame that is attached.
Raises:
    FrameNotFound: There is no such frame.
    Error: frame1 is below frame2.)";

inline constexpr char getFrame[] = R"(The first frame of a name.

Args:
    frameName: The name.
    warnIfNotExist: False: an unknown name gives None in place of an error.
Returns:
    The Frame.
Raises:
    FrameNotFound: There is no such frame; the message has names that are near.)";

inline constexpr char frame[] = R"(The frame of a name or id.

Args:
    frame: Its name or id. A Frame is returned as it is.
Returns:
    The Frame.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char setFrameState[] =
    R"(Sets world poses of frames. Frames with a joint move as far as the joint allows.

Args:
    X: Poses, shape (frames, 7): rows x y z (m) qw qx qy qz.
    frames: Names of the frames; without names X is for all of them, in order.
Raises:
    ArgumentError: X has another shape.
    FrameNotFound: A name that is not in the scene.)";

inline constexpr char checkFile[] = R"(All that is wrong or odd about a scene file, without adding it to a scene.

Args:
    filename: Path of the file (.g, .yml, .urdf, .xml).
Returns:
    A dict: messages (list of str, each with file:line:column, the line and a caret), and the numbers of errors,
    warnings and frames.
Raises:
    FileError: The file cannot be read.)";

}  // namespace kinegraph::python::docs::scene
