#pragma once

/// The manual of what bind_viewer_input.cpp binds.
namespace kinegraph::python::docs::viewer_input {

inline constexpr char view[] = R"(Shows a text; everything else that is shown stays as it is.

Args:
    pause: Waits for a key in the browser, or Enter on the terminal.
    text: The text; None: the one that is there.
    offscreen: Opens nothing.
Returns:
    The code of the key, or 0, as Config.view.)";

inline constexpr char setQuad[] = R"(Shows a picture on top of the scene, in the browser and in getRgb().

Args:
    id: -1 for another picture, or the id of one, to replace it.
    rgb: 0..255, shape (height, width, 3), or (height, width) for gray.
    x: Left edge, from that of the window, in heights of the window.
    y: Top edge, from that of the window, in heights of the window.
    h: Height, in heights of the window.
Returns:
    The id.
Raises:
    ArgumentError: Another shape, or numbers that are not finite.)";

inline constexpr char setupEventHandler[] = R"(Collects what people do with mouse and keys on the page, for getEvents().

Args:
    blockDefaultHandler: The page itself does nothing with it: the camera stays.)";

inline constexpr char getEvents[] =
    R"(What people did since the last call: "click down left", "key up a", "scroll up", "mod shift" (what is held from then
on).)";

inline constexpr char getEventCursor[] =
    R"(The point of a surface that the pointer is on, in the world (m), and the surface's normal, shape (6,). It is empty,
shape (0,), until the pointer has been on a surface; over the background the last point stays. Browsers tell from the
first call on.)";

inline constexpr char viewImage[] = R"(Shows a picture.

Args:
    img: 0..255, shape (height, width, 3), or (height, width) for gray.
    wait: For a key.
    zoom: Size of each pixel, in pixels of the screen.
Returns:
    The code of the key, or 0.
Raises:
    ArgumentError: Another shape, or a zoom that is not in 0..100.)";

inline constexpr char viewFloat[] = R"(Shows a picture of floating-point numbers.

Args:
    img: 0..255, shape (height, width, 3), or (height, width) for gray; what is below or above is cut off.
    wait: For a key.
    zoom: Size of each pixel, in pixels of the screen.
Returns:
    The code of the key, or 0.
Raises:
    ArgumentError: Another shape, or a zoom that is not in 0..100.)";

}  // namespace kinegraph::python::docs::viewer_input
