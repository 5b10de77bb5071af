"""The line that says how far a long computation is."""

import io

from kinegraph.progress import drawProgress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_the_bar_fills_and_the_line_ends_with_the_last_one():
    terminal = Terminal()
    drawProgress("solveIk", 5, 20, 2.0, terminal)
    assert "5/20, 2 s, 6 s left" in terminal.getvalue() and "\n" not in terminal.getvalue()
    drawProgress("solveIk", 20, 20, 8.0, terminal)
    assert terminal.getvalue().count("\r") == 2 and terminal.getvalue().endswith("\n")


def test_a_file_gets_no_bar():
    file = io.StringIO()
    drawProgress("solveIk", 5, 20, 2.0, file)
    assert file.getvalue() == ""
