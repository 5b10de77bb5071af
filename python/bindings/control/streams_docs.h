#pragma once

/// The manual of what bind_streams.cpp binds.
namespace kinegraph::python::docs::streams {

inline constexpr char target_file[] =
    R"(A sequence of timed poses from a text file: lines of t x y z, or t x y z qw qx qy qz, in s and m.

Commas separate the numbers. Empty lines, lines that begin with # and a header are ignored. Between lines, positions are
interpolated linearly and rotations spherically; before the first and after the last line the pose is constant.)";

inline constexpr char read[] = R"(Reads the file.

Args:
    path: The file.
Raises:
    FileError: It cannot be read.
    ParseError: A line has another format; the message has its place.)";

inline constexpr char pose[] = R"(Returns the pose at a time.

Args:
    t: Time, s.
Returns:
    x y z, shape (3,), or x y z qw qx qy qz, shape (7,).)";

inline constexpr char open[] = R"(Opens the device.

Args:
    device: Its file.
    speed: Speed of the position for a stick at its end, m/s.
    axes: Axes of the gamepad that move x, y and z; y and z have the opposite sign, because sticks count downwards.
Raises:
    FileError: It cannot be opened.)";

inline constexpr char velocity[] = R"(Reads all events since the last call.

Returns:
    Velocity of the position, m/s, shape (3,).)";

inline constexpr char servo[] =
    R"(Steps a DiffIk while its target moves: by a file, a gamepad, a function, or the handle in the browser.

Args:
    ik: A DiffIk with a task at the target.
    config: Its scene.
    target: Name of the frame that moves.
    source: A TargetFile, or a function of the time in s that returns a position or a pose; a Gamepad; or None: people
        move the frame in the browser.
    seconds: Duration, s.
    dt: Length of a step, s.
    show: True shows the scene thirty times a second; None: only without a source.
    realtime: True waits, so that steps follow the clock; False steps as fast as possible.
Raises:
    ArgumentError: seconds or dt is not positive, or the source returns no pose.
    FrameNotFound: There is no such frame.)";

}  // namespace kinegraph::python::docs::streams
