#pragma once

/// Docstrings for bind_page_content.cpp.
namespace kinegraph::python::docs::content {

inline constexpr char value[] = R"(The value, as the program or a user set it last. Setting it changes all pages.

Raises:
    ArgumentError: It is beyond the range of the slider, or no option of the choice.)";

inline constexpr char changed[] =
    R"(Returns whether a user has changed the value since the last call. Runs callbacks that are due, before.)";

inline constexpr char onChange[] = R"(Sets a function that is called with the value after a user changed it.

It runs in the program's thread, within `view`, `poll`, and `clicked` and `changed` of any control.

Args:
    function: Takes the value; None ends it.
Raises:
    ArgumentTypeError: It is not a function.)";

inline constexpr char clicked[] =
    R"(Returns whether a user has clicked it since the last call. Runs callbacks that are due, before.)";

inline constexpr char onClickButton[] = R"(Sets a function that is called after each click.

It runs in the program's thread, within `view`, `poll`, and `clicked` and `changed` of any control.

Args:
    function: Takes no argument; None ends it.
Raises:
    ArgumentTypeError: It is not a function.)";

inline constexpr char button[] = R"(Adds a button to the page. A known label returns the same button.

Args:
    label: Its text.
    key: A key on the page that clicks it, such as "p".
Returns:
    The button; poll `clicked()`, or set `onClick`.)";

inline constexpr char slider[] = R"(Adds a slider to the page. A known label returns the same slider.

Args:
    label: Its text.
    lower: Lowest value.
    upper: Highest value.
    value: Initial value; None: the lowest.
    unit: Unit behind the value.
Returns:
    The slider, with `value`.
Raises:
    ArgumentError: The range is empty, or the value is not in it.)";

inline constexpr char check[] = R"(Adds a check box to the page. A known label returns the same one.

Args:
    label: Its text.
    value: Initial value.
Returns:
    The check box, with `value`.)";

inline constexpr char choice[] = R"(Adds a list from which a user chooses one. A known label returns the same list.

Args:
    label: Its text.
    options: The texts to choose from.
    value: The initial one; None: the first.
Returns:
    The choice, with `value`.
Raises:
    ArgumentError: There are no options, or `value` is none of them.)";

inline constexpr char text[] = R"(Adds a text field to the page. A known label returns the same field.

Args:
    label: The text before it.
    value: Initial value.
Returns:
    The field, with `value`.)";

inline constexpr char folder[] = R"(Groups controls below a heading: those made in its with statement.

Args:
    name: The heading; folders may contain folders.
Returns:
    The folder, for a with statement.)";

inline constexpr char poll[] = R"(Runs the callbacks that are due. `view` does so, too.)";

inline constexpr char arrow[] = R"(Draws an arrow into the scene. A known name replaces the drawing.

Args:
    name: Name of the drawing, for `remove`.
    at: Its start, m, shape (3,).
    vector: From start to tip, m, shape (3,).
    label: Text at the tip.
    color: rgb or rgba in 0..1; None: blue.
    size: Thickness of the shaft, m; 0: 4 % of the length.
    frame: Frame whose coordinates are used, and that the drawing follows; None: the world.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char line[] = R"(Draws a line through points. A known name replaces the drawing.

Args:
    name: Name of the drawing, for `remove`.
    points: m, shape (n, 3).
    width: Pixels.
    color: rgb or rgba in 0..1; None: blue.
    colors: Color of each point instead, 0..255, shape (n, 3) or (n, 4).
    frame: Frame whose coordinates are used, and that the drawing follows; None: the world.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char label[] = R"(Writes a text at a place of the scene. A known name replaces the drawing.

Args:
    name: Name of the drawing, for `remove`.
    at: The place, m, shape (3,).
    text: The text.
    frame: Frame whose coordinates are used, and that the drawing follows; None: the world.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char points[] = R"(Draws points. A known name replaces the drawing.

Args:
    name: Name of the drawing, for `remove`.
    points: m, shape (n, 3).
    colors: Color of each point, 0..255, shape (n, 3) or (n, 4).
    size: Diameter, m; 0: 4 pixels.
    color: One color for all instead, rgb in 0..1; None: blue.
    frame: Frame whose coordinates are used, and that the drawing follows; None: the world.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char frustum[] = R"(Draws the view of a camera as a pyramid. A known name replaces the drawing.

Args:
    name: Name of the drawing, for `remove`.
    camera: Name of a camera frame, which the drawing follows; or a pose (7,) with x to the right, y down, z forward.
    image: An image at the end of the pyramid, uint8, shape (h, w, 3) or (h, w).
    focal_length: In heights of the image; None: that of the camera frame.
    size: Length of the pyramid, m.
    color: rgb in 0..1; None: blue.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char axes[] = R"(Draws a coordinate frame: x red, y green, z blue. A known name replaces the drawing.

Args:
    name: Name of the drawing, for `remove`.
    pose: x y z in m, then qw qx qy qz, shape (7,); or a position, shape (3,).
    size: Length of the axes, m.
    label: Text at its origin.
    frame: Frame whose coordinates are used, and that the drawing follows; None: the world.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char image[] = R"(Puts an image into the scene. A known name replaces the drawing.

Args:
    name: Name of the drawing, for `remove`.
    rgb: uint8, shape (h, w, 3) or (h, w).
    pose: Its center; x to the right of the image, y down; shape (7,), or a position (3,).
    size: Width, m.
    frame: Frame whose coordinates are used, and that the drawing follows; None: the world.
Raises:
    FrameNotFound: There is no such frame.)";

inline constexpr char remove[] = R"(Removes a drawing, a plot, a control, or all controls of a folder.

Args:
    name: Its name; "folder/label" for a control in a folder.
Raises:
    ArgumentError: There is nothing of that name.)";

inline constexpr char notify[] = R"(Shows a text on the page for some seconds.

Args:
    text: The text.
    level: "info", "warning" or "error".)";

inline constexpr char log[] = R"(Appends a sample to a plot on the page, which grows, or shows an image there.

Args:
    name: Name of the plot or image.
    value: A number, or numbers, one curve for each; or an image, uint8 (height, width, 3), in place of the last one.
    time: s; None: seconds since the first call. Pages keep the last 100,000 samples. Not with an image.
    unit: Unit in the title of the plot. Not with an image.
Raises:
    ArgumentError: The number of values differs from that of earlier samples, or the value is neither of these.)";

inline constexpr char logAll[] = R"(Appends samples to several plots on the page.

Args:
    values: A dict of names and values, each a number, numbers (one curve for each), or an image, uint8 (h, w, 3).
    time: s, of the numbers; None: seconds since the first call.
Raises:
    ArgumentError: The number of values differs from that of earlier samples, or a value is neither of these.)";

inline constexpr char onClick[] = R"(Sets a function that is called after a click on the scene.

It runs in the program's thread, within `view`, `poll`, and `clicked` and `changed` of any control.

Args:
    function: Takes a Hit with `frame`, `point` and `normal`; None ends it.
Raises:
    ArgumentTypeError: It is not a function.)";

}  // namespace kinegraph::python::docs::content
