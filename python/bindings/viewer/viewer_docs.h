#pragma once

/// Docstrings for bind_viewer.cpp.
namespace kinegraph::python::docs::viewer {

inline constexpr char waitForClient[] = R"(Waits until a browser is connected.

Args:
    seconds: Longest waiting time, s.
Returns:
    False if no browser connected in time.)";

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
    R"(Returns whether users moved joints or frames in the browser since the last view(), which applies such changes.)";

inline constexpr char select[] = R"(Shows the card of a frame, with handles to move it.

Args:
    frame: Its ID.
Raises:
    ArgumentError: No frame has this ID.)";

inline constexpr char saveHtml[] = R"(Saves asHtml() as a file for any browser.

Args:
    path: Path of the file, .html.
    client: Path of a file with the script of all such pages, .js: the page loads it from there, and is small. The
        file is written if it does not exist. None: the page contains the script.
Raises:
    FileError: A file cannot be written, or client is another file.)";

inline constexpr char record[] =
    R"(Records what this viewer shows and logs: scenes, simulations, motions, drawings and plots.
Times are those of a shown simulation, else of the clock; a motion takes its duration. The command
`kinegraph view run.kgr` plays the file.

    with C.viewer().record("run.kgr"):
        loop()

Args:
    path: Path of the file, .kgr.
Returns:
    The recording, a context manager: it starts with `with`, or by start().
Raises:
    ArgumentTypeError: The path is no path.)";

inline constexpr char ViewerRecording[] = R"(A recording of what a viewer shows; see ConfigurationViewer.record.)";

inline constexpr char startRecording[] = R"(Starts the recording.

Returns:
    The recording itself.
Raises:
    FileError: The file cannot be written.
    ArgumentError: The viewer is recorded already.)";

inline constexpr char stopRecording[] = R"(Ends the recording and writes the file. Does nothing if it does not run.

Raises:
    FileError: The file cannot be written.)";

inline constexpr char runPage[] = R"(Returns a web page that plays a recorded run without a program.

Args:
    content: Content of a file written by ConfigurationViewer.record.
Returns:
    The page, HTML.
Raises:
    ArgumentError: The content is not a recorded run.)";

inline constexpr char view[] =
    R"(Shows the scene in the browser, in a notebook below the cell. The first call logs the page's address, and opens
a browser if there is a display. With KINEGRAPH_HEADLESS=1 it opens nothing, logs nothing and does not wait.

Args:
    pause: Whether to wait for a key in the browser, or Enter on the terminal.
    message: Text in the corner of the page.
    offscreen: Opens no browser; viewer().getRgb() and the other pictures need none.
    host: Address of the page, "127.0.0.1" by default; "0.0.0.0" also for browsers on other machines, which then need
        the token in the printed address.
    port: First port tried; 7000 by default, 0 for any free one.
    token: Required from browsers, part of the printed address: letters, digits, "-" and "_". None: none on this
        machine, else a random one.
Returns:
    The code of the key pressed since the last call (ord("a"), 13 Enter, 27 Escape ...), or 0.
Raises:
    ArgumentError: The host is not an IP address, or the port or the token is invalid.)";

inline constexpr char serveAt[] = R"(Sets the address of the page; a page at another address is closed.

Args:
    host: IP address: "127.0.0.1" for this machine, "0.0.0.0" also for other machines.
    port: First port tried; 0 for any free one.
    token: Required from browsers, part of the address: letters, digits, "-" and "_"; "" is none on this machine, else a
        random one.
Raises:
    ArgumentError: The host is not an IP address, or the port or the token is invalid.
    Error: This machine does not have the address, or no port is free.)";

inline constexpr char make[] = R"(Makes a viewer of an empty scene; C.set_viewer(viewer) shows C there.)";

inline constexpr char set_viewer[] = R"(Shows this scene in the viewer of another one.

Args:
    viewer: The other viewer.)";

inline constexpr char animateSpline[] =
    R"(Plays a smooth motion through random joint vectors within the limits and back, in T + 1 s, until a key is
pressed. Does not change q.

Args:
    T: Number of joint vectors.)";

inline constexpr char view_path[] =
    R"(Shows a motion with a time slider, and waits until it has been played once. Does not change q.

Args:
    path: Joint vectors, shape (T, n), rad or m.
    seconds: Duration, s.
    pause: Whether to wait for a key afterwards.
    message: Text in the corner of the page.
Returns:
    The code of the key that was pressed, or 0.
Raises:
    ArgumentError: The path is empty or has another shape, or seconds is not positive.)";

inline constexpr char watchFile[] =
    R"(Loads a scene file, shows it, and reloads it whenever it or an included file changes. It ends with q in the
browser, Enter on the terminal, or Ctrl-C. An error in the file is shown in the browser and printed; the last valid
scene stays.

Args:
    filename: Path of the scene file.
Raises:
    FileError: The file cannot be read.)";

}  // namespace kinegraph::python::docs::viewer
