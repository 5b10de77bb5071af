"""Progress lines of long computations."""

import io

from kinegraph.progress import clearLine, drawProgress, drawSolve, drawTime


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_the_bar_fills_and_the_line_ends_with_the_last_one():
    terminal = Terminal()
    drawProgress("solveIk", 5, 20, 2.0, stream=terminal)
    assert "5/20, 2 s, 6 s left" in terminal.getvalue() and "\n" not in terminal.getvalue()
    drawProgress("solveIk", 20, 20, 8.0, stream=terminal)
    assert terminal.getvalue().count("\r") == 2 and terminal.getvalue().endswith("\n")


def test_the_line_of_a_call_that_fails_ends_where_it_was():
    terminal = Terminal()
    drawProgress("planToolPath", 5, 20, 2.0, ends=True, stream=terminal)
    assert terminal.getvalue().endswith("5/20, 2 s\x1b[K\n")


def test_a_file_gets_no_bar():
    file = io.StringIO()
    drawProgress("solveIk", 5, 20, 2.0, stream=file)
    assert file.getvalue() == ""


def test_the_line_of_a_solver_shows_its_state_and_is_removed_at_the_end():
    terminal, file = Terminal(), io.StringIO()
    for stream in (terminal, file):
        drawSolve("NLP_Solver", 120, 1.25, 3e-3, 2.0, stream)
        clearLine(stream)
    assert "NLP_Solver: 120 evaluations, cost 1.25, violation 0.003, 2 s" in terminal.getvalue()
    assert terminal.getvalue().endswith("\r\x1b[K")
    assert file.getvalue() == ""


def test_a_call_without_parts_shows_its_time():
    terminal, file = Terminal(), io.StringIO()
    for stream in (terminal, file):
        drawTime("planMotion", 3.2, stream)
    assert terminal.getvalue().startswith("\rplanMotion: 3 s (Ctrl-C ends it)") and file.getvalue() == ""
