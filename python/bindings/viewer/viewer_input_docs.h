#pragma once

/// Docstrings for bind_viewer_input.cpp.
namespace kinegraph::python::docs::viewer_input {

inline constexpr char view[] = R"(Shows a text on the present scene.

Args:
    pause: Whether to wait for a key in the browser, or Enter on the terminal.
    text: The text; None: the present one.
    offscreen: Opens no browser.
Returns:
    The code of the key, or 0, like Config.view.)";

inline constexpr char setQuad[] = R"(Shows an image on top of the scene, in the browser and in getRgb().

Args:
    id: -1 for a new image, or the id of an existing one to replace.
    rgb: 0..255, shape (height, width, 3), or (height, width) for gray.
    x: Left edge, relative to the window's, in heights of the window.
    y: Top edge, relative to the window's, in heights of the window.
    h: Height, in heights of the window.
Returns:
    The id.
Raises:
    ArgumentError: Another shape, or numbers that are not finite.)";

inline constexpr char setupEventHandler[] = R"(Collects mouse and key events of the page for getEvents().

Args:
    blockDefaultHandler: The page itself ignores the events: the camera does not move.)";

inline constexpr char getEvents[] =
    R"(Returns the events since the last call: "click down left", "key up a", "scroll up", "mod shift" (the pressed
modifiers from then on).)";

inline constexpr char getEventCursor[] =
    R"(Returns the surface point under the pointer, in the world (m), and the surface's normal, shape (6,). It is empty,
shape (0,), until the pointer was on a surface; over the background the last point is kept. Browsers report it from the
first call on.)";

inline constexpr char viewImage[] = R"(Shows an image.

Args:
    img: 0..255, shape (height, width, 3), or (height, width) for gray.
    wait: Whether to wait for a key.
    zoom: Size of each pixel, in pixels of the screen.
Returns:
    The code of the key, or 0.
Raises:
    ArgumentError: A wrong shape, or a zoom outside (0, 100].)";

inline constexpr char viewFloat[] = R"(Shows an image of floating-point numbers.

Args:
    img: 0..255, shape (height, width, 3), or (height, width) for gray; clipped to this range.
    wait: Whether to wait for a key.
    zoom: Size of each pixel, in pixels of the screen.
Returns:
    The code of the key, or 0.
Raises:
    ArgumentError: A wrong shape, or a zoom outside (0, 100].)";

}  // namespace kinegraph::python::docs::viewer_input
