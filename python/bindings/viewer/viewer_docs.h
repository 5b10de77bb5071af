#pragma once

/// The manual of what bind_viewer.cpp binds.
namespace kinegraph::python::docs::viewer {

inline constexpr char waitForClient[] = R"(Waits until a browser is connected.

Args:
    seconds: How long at most, s.
Returns:
    False if no browser came in time.)";

inline constexpr char setMessage[] = R"(Shows a text in the corner.

Args:
    text: The text; empty removes it.)";

inline constexpr char setError[] = R"(Shows a text in a red box.

Args:
    text: The text; empty removes it.)";

inline constexpr char setTitle[] = R"(Sets the title of the page.

Args:
    text: The title.)";

inline constexpr char hasEdits[] =
    R"(True if people have moved joints or frames in the browser since the last view(), which takes that over.)";

inline constexpr char select[] = R"(Shows the card of a frame, with handles to move it.

Args:
    frame: Its ID.
Raises:
    ArgumentError: No frame has this ID.)";

inline constexpr char saveHtml[] = R"(Saves asHtml() as a file, to be opened in any browser, or sent to somebody.

Args:
    path: Path of the file, .html.
Raises:
    OSError: The file cannot be written.)";

inline constexpr char view[] =
    R"(Shows the scene in the browser, in a notebook below the cell. The first call opens a browser if there is a display,
and prints the page's address. With KINEGRAPH_HEADLESS=1 nothing opens, nothing is printed and nothing waits.

Args:
    pause: Waits for a key in the browser, or Enter on the terminal.
    message: Text in the corner of the page.
    offscreen: Opens nothing; viewer().getRgb() and the other pictures do without a browser.
    host: Address that the page is served at, "127.0.0.1" by default; "0.0.0.0" for browsers on other machines too,
        which then need the token in the address that is printed.
    port: First port that is tried; 7000 by default, 0 for any free one.
Returns:
    The code of the key pressed since the last call (ord("a"), 13 Enter, 27 Escape ...), or 0.
Raises:
    ArgumentError: The host is no IP address, or the port is none.)";

inline constexpr char serveAt[] = R"(Serves the page at another address from now on; one that is open elsewhere ends.

Args:
    host: IP address: "127.0.0.1" for this machine, "0.0.0.0" for browsers on other machines too.
    port: First port that is tried; 0 for any free one.
Raises:
    ArgumentError: The host is no IP address, or the port is none.
    Error: This machine does not have the address, or no port is free.)";

inline constexpr char set_viewer[] = R"(Shows this scene in the viewer of another one.

Args:
    viewer: The other viewer.)";

inline constexpr char animateSpline[] =
    R"(Plays a smooth motion through random joint vectors within the limits and back, in T + 1 s. A key ends it; q stays as
it is.

Args:
    T: How many joint vectors.)";

inline constexpr char view_path[] =
    R"(Shows a motion with a time slider, and waits until it has been played once; q stays as it is.

Args:
    path: Joint vectors, shape (T, n), rad or m.
    seconds: How long it plays, s.
    pause: Then waits for a key.
    message: Text in the corner of the page.
Returns:
    The code of the key that was pressed, or 0.
Raises:
    ArgumentError: The path is empty or has another shape, or seconds is not positive.)";

inline constexpr char watchFile[] =
    R"(Loads a scene file and shows it, and again whenever it, or a file that it includes, changes. It ends with q in the
browser, Enter on the terminal, or Ctrl-C. A mistake in the file is shown there and printed; the last scene stays.

Args:
    filename: Path of the scene file.
Raises:
    FileError: The file cannot be read.)";

}  // namespace kinegraph::python::docs::viewer
