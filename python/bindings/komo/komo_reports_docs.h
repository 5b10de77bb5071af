#pragma once

/// Docstrings of the functions in bind_komo_reports.cpp.
namespace kinegraph::python::docs::komo_reports {

inline constexpr char report[] = R"(Reports the objectives with their errors at the present path, smallest first.

Args:
    specs: Adds an entry `specs` with the sizes of the problem.
    listObjectives: False omits the objectives.
    plotOverTime: Not available, warns; info_objectiveErrorTraces returns the numbers.
    sortByError: False lists the objectives in the order of addition.
Returns:
    A dict with an entry o<i> per objective (name, frames, err, order, type, scale, target, times, slices), and totals:
    the sums of sos, ineq, eq and f.)";

inline constexpr char info_sliceErrors[] =
    R"(Lists the objectives with errors in a slice, largest first, one per line.

Args:
    t: The slice.
    errorTraces: The result of info_objectiveErrorTraces, shape (T, objectives).
Returns:
    The lines.
Raises:
    ArgumentError: The slice does not exist.)";

inline constexpr char info_sliceCollisions[] =
    R"(Lists the pairs of shapes that are closer than a margin in a slice, one per line.

Args:
    t: The slice.
    belowMargin: The margin, m.
Returns:
    The lines.
Raises:
    ArgumentError: The slice does not exist.)";

inline constexpr char view[] =
    R"(Shows all slices in the browser, including those before the path.

The page has a time slider, the errors of the objectives, and marks violations in red.

Args:
    pause: Waits for a key.
    txt: Text in the corner of the page.
Returns:
    The code of the pressed key, or 0.)";

inline constexpr char view_slice[] = R"(Shows a slice. The time slider gives access to the others.

Args:
    t: The slice; negative ones are before the path.
    pause: Waits for a key.
Returns:
    The code of the pressed key, or 0.
Raises:
    ArgumentError: The slice does not exist.)";

inline constexpr char view_play[] = R"(Plays the slices once and waits for the end; a key ends it earlier.

Args:
    pause: Waits for a key at the end.
    txt: Text in the corner of the page.
    delay: Time per slice, s.
    saveVideoPath: Saves a picture of each slice as <saveVideoPath>000000.png and so on, and replaces existing ones.
Returns:
    The code of the pressed key, or 0.)";

inline constexpr char set_viewer[] = R"(Shows this problem in the viewer of another one.

Args:
    viewer: The other viewer.)";

}  // namespace kinegraph::python::docs::komo_reports
