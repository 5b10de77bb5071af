#pragma once

/// The manual of what bind_komo_reports.cpp binds.
namespace kinegraph::python::docs::komo_reports {

inline constexpr char report[] = R"(The objectives with their errors at the present path, smallest first.

Args:
    specs: Adds an entry `specs` with the sizes of the problem.
    listObjectives: False: without the objectives.
    plotOverTime: Not available: a warning; info_objectiveErrorTraces has the numbers.
    sortByError: False: in the order in which they were added.
Returns:
    A dict: for each objective an entry o<i> (name, frames, err, order, type, scale, target, times, slices), and totals,
    the sums of sos, ineq, eq and f.)";

inline constexpr char info_sliceErrors[] = R"(The objectives with errors in a slice, largest first, a line each.

Args:
    t: The slice.
    errorTraces: As info_objectiveErrorTraces gives them, shape (T, objectives).
Returns:
    The lines.
Raises:
    ArgumentError: There is no such slice.)";

inline constexpr char info_sliceCollisions[] = R"(The pairs of shapes nearer than a margin in a slice, a line each.

Args:
    t: The slice.
    belowMargin: The margin, m.
Returns:
    The lines.
Raises:
    ArgumentError: There is no such slice.)";

inline constexpr char view[] =
    R"(Shows all slices at once in the browser, those before the path as well, with a time slider, the errors of the
objectives, and what violates them in red.

Args:
    pause: Waits for a key.
    txt: Text in the corner of the page.
Returns:
    The code of the key that was pressed, or 0.)";

inline constexpr char view_slice[] = R"(Shows a slice. The others are at the time slider.

Args:
    t: The slice; negative ones are before the path.
    pause: Waits for a key.
Returns:
    The code of the key that was pressed, or 0.
Raises:
    ArgumentError: There is no such slice.)";

inline constexpr char view_play[] = R"(Plays the slices, and waits until they have been played once; a key ends it.

Args:
    pause: Then waits for a key.
    txt: Text in the corner of the page.
    delay: How long each slice is shown, s.
    saveVideoPath: Saves a picture of each slice as <saveVideoPath>000000.png and so on, in place of those that are
        there.
Returns:
    The code of the key that was pressed, or 0.)";

inline constexpr char set_viewer[] = R"(Shows this problem in the viewer of another one.

Args:
    viewer: The other viewer.)";

}  // namespace kinegraph::python::docs::komo_reports
