"""tools/check_prose.py and tools/check_lines.py count and report as their headers say."""

import subprocess
import sys
from pathlib import Path

TOOLS = Path(__file__).parent.parent.parent.parent / "tools"

PLAIN = "The planner returns a path. The solver stops at the first feasible point.\n"


def run(tool, *arguments):
    command = [sys.executable, str(TOOLS / tool), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def test_plain_prose_passes(tmp_path):
    (tmp_path / "page.md").write_text(PLAIN)
    done = run("check_prose.py", tmp_path / "page.md")
    assert done.returncode == 0, done.stdout
    assert "0.00 clause words in 100, 0.0 % odd openings, 0 of 1 texts" in done.stdout


def test_clause_words_openings_long_sentences_and_private_terms_are_reported(tmp_path):
    (tmp_path / "page.md").write_text(
        "What is found where it is wanted. " + "word " * 36 + "end. The message says in words why it failed.\n"
    )
    done = run("check_prose.py", "--worst", 1, tmp_path / "page.md")
    assert done.returncode == 1
    for problem in ("clause words in 100", "odd openings", "a sentence of 37 words", "private term 'in words'"):
        assert problem in done.stdout
    assert "2  " in done.stdout and "What is found where it is wanted." in done.stdout


def test_code_tables_strings_and_headings_are_not_counted(tmp_path):
    clause = "what where that which so that"
    (tmp_path / "page.md").write_text(f"# {clause}\n\n| {clause} |\n\n```\n{clause}\n```\n\n{PLAIN}")
    (tmp_path / "code.py").write_text(f'"""{PLAIN}"""\n\nprint("{clause}")  # prints a sentence\n')
    (tmp_path / "code.cpp").write_text(f'// {PLAIN}auto s = "// {clause}";\nauto where = 1; /* a number */\n')
    for name in ("page.md", "code.py", "code.cpp"):
        done = run("check_prose.py", tmp_path / name)
        assert done.returncode == 0, done.stdout


def test_long_comments_and_docstrings_are_reported_with_their_line(tmp_path):
    long = "a " * 61
    (tmp_path / "code.h").write_text(f"int a;\n/// {long}\nint b;  // short\n")
    (tmp_path / "code.py").write_text(f'"""Short.\n\n{long}\n"""\n\na = "{long}"\n')
    (tmp_path / "page.md").write_text(f"| {long} |\nhttps://a.b/{'c' * 120}\n{long}\n")
    done = run("check_lines.py", *(tmp_path / name for name in ("code.h", "code.py", "page.md")))
    assert done.returncode == 1
    assert [line.split("/")[-1].split(": ")[0] for line in done.stdout.splitlines()] == [
        "code.h:2",
        "code.py:3",
        "page.md:3",
    ]


def test_short_lines_pass(tmp_path):
    (tmp_path / "code.h").write_text("int a;  // short\n")
    done = run("check_lines.py", tmp_path / "code.h")
    assert done.returncode == 0, done.stdout
