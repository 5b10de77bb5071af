#pragma once

/// The manual of what bind_streams.cpp binds.
namespace kinegraph::python::docs::streams {

inline constexpr char target_file[] =
    R"(Poses at times, from a text file: rows of t x y z, or t x y z qw qx qy qz, in s and m.

Numbers are separated by commas; empty lines, lines that begin with # and a header are left out. Between rows positions
go straight and rotations turn evenly; before the first and after the last row the pose stays.)";

inline constexpr char read[] = R"(Reads the file.

Args:
    path: The file.
Raises:
    FileError: It cannot be read.
    ParseError: A row is not as expected; says where.)";

inline constexpr char pose[] = R"(The pose at a time.

Args:
    t: Time, s.
Returns:
    x y z, shape (3,), or x y z qw qx qy qz, shape (7,).)";

inline constexpr char open[] = R"(Opens the device.

Args:
    device: Its file.
    speed: Of the position where a stick is at its end, m/s.
    axes: Which axes of the gamepad move x, y and z; y and z against the sticks, which count downwards.
Raises:
    FileError: It cannot be opened.)";

inline constexpr char velocity[] = R"(Takes in what has happened since.

Returns:
    Where the sticks push, m/s, shape (3,).)";

inline constexpr char servo[] =
    R"(Steps a DiffIk while its target moves: with a file, a gamepad, a function, or the handle in the browser.

Args:
    ik: With a task at the target.
    config: Its scene.
    target: Name of the frame that moves.
    source: A TargetFile or a function of the time in s, that gives a position or a pose; a Gamepad; or None: the frame
        stays where people put it in the browser.
    seconds: How long.
    dt: Length of a step, s.
    show: Shows the scene thirty times a second; None: without a source, as people drag it there.
    realtime: Waits so that steps come as time goes on; else as fast as they can.
Raises:
    ArgumentError: seconds or dt is not positive, or the source gives no pose.
    FrameNotFound: There is no such frame.)";

}  // namespace kinegraph::python::docs::streams
