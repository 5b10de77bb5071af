"""The generated pages of the site: gallery, robots, options."""

import inspect
import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "site"))

import gallery_page  # noqa: E402
import option_calls  # noqa: E402
import option_tables  # noqa: E402
import project_pages  # noqa: E402
import result_plots  # noqa: E402
import robot_gallery  # noqa: E402

GALLERY = {name: f for module in gallery_page.CHAPTERS.values() for name, f in gallery_page.entries(module).items()}


def test_the_gallery_has_forty_entries_with_captions_and_short_code():
    assert len(GALLERY) >= 40
    for name, function in GALLERY.items():
        assert (inspect.getdoc(function) or "").endswith("."), name
        assert len(gallery_page.code(function).splitlines()) <= gallery_page.LONGEST_CODE, name


@pytest.mark.parametrize("name", ["over_a_wall", "follow_a_circle", "friction_on_a_slope", "stack_two_boxes"])
def test_an_entry_of_the_gallery_moves(name):
    C, path, seconds = GALLERY[name]()
    path = np.asarray(path)
    assert len(path) > 5 and seconds > 0
    assert path[0].shape in ((C.getJointDimension(),), (len(C), 7))
    assert np.abs(path[-1] - path[0]).max() + np.abs(np.diff(path, axis=0)).max() > 0.01


def test_the_page_of_robots_counts_what_the_scene_has():
    files = robot_gallery.robotFiles(Path(ry.raiPath("")))
    assert len(files) >= 12
    facts = robot_gallery.facts(next(file for file in files if file.stem == "ur5e"))
    assert facts["dofs"] == "6"
    C = ry.Config()
    C.addFile(ry.raiPath("ur5e/ur5e.g"))
    assert facts["collision pairs"] == str(len(C.getCollidablePairs()) // 2)
    assert "data sheet" in facts["source of its figures"]


@pytest.mark.parametrize("options", [ry.IkOptions, ry.NLP_SolverOptions, ry.SimulationOptions])
def test_a_table_of_options_has_what_the_code_expects(options):
    fields = options().dict()
    rows = [option_tables.optionFrom(name, getattr(options, name).__doc__) for name in fields]
    option_tables.expectations(options.__name__, rows)
    for row in rows:
        assert row.meaning and row.expects and row.default == str(fields[row.name]), row
        if row.expects == "a positive number":
            with pytest.raises(ry.ArgumentError):
                options(**{row.name: -1.0})
            assert math.isclose(getattr(options(**{row.name: 0.01}), row.name), 0.01)


@pytest.mark.parametrize(
    ("call", "option", "words", "refused"),
    [
        ("planMotions", "margin", "a number >= 0", -1.0),
        ("replan", "optimize", "one of time, length, clearance", "speed"),
        ("retime", "corners", "one of blend, stop, spline", "round"),
        ("planToolPath", "order", "'given' or 'free'", "any"),
        ("DiffIk", "damping", "a number > 0", 0.0),
        ("reachability", "directions", "a whole number >= 0", -1),
        ("planTask", "margin", "a number >= 0", -1.0),
    ],
)
def test_an_option_of_a_call_expects_what_it_does_not_refuse(call, option, words, refused):
    function = option_calls.calls()[call]
    assert option_tables.expectation(function, option) == words
    with pytest.raises(ry.ArgumentError, match=option):
        function(**{option: refused})
    function()


def test_the_glossary_has_terms_and_meanings_only():
    page = project_pages.glossary((ROOT / "CONTRIBUTING.md").read_text())
    rows = [line for line in page.splitlines() if line.startswith("|")]
    assert rows[0] == "| term | meaning |" and len(rows) > 40
    assert "| path | a sequence of configurations, geometric, without time |" in rows


def test_the_citation_has_the_fields_of_its_file():
    page = project_pages.citation((ROOT / "CITATION.cff").read_text())
    assert "@software{kinegraph," in page and f"version = {{{ry.__version__}}}" in page


def test_a_robot_of_the_extra_has_the_license_beside_it(tmp_path):
    (tmp_path / "README.md").write_text("# Arm\n\nupstream: https://example.org/arm\nLicense: BSD-3-Clause\n")
    assert robot_gallery.description(tmp_path) == ("Arm", "https://example.org/arm", "BSD-3-Clause")


def test_a_robot_whose_base_is_its_middle_is_raised_to_the_ground():
    C = ry.Config()
    C.addText("body: {} foot (body): { Q: [0 0 -.5] }")
    robot_gallery.standOnGround(C)
    assert C.getFrame("foot").getPosition()[2] == pytest.approx(0.05)
    assert C.getFrame("body").getPosition()[2] == pytest.approx(0.55)


def test_a_comment_behind_a_table_becomes_a_bar_per_row_and_column(tmp_path):
    page = tmp_path / "times.md"
    rows = ["| what | how | `a` | b |", "|---|---|---|---|", "| 2 arms | slow | 2 ms | 500 µs |", "| | fast | 1 ms | |"]
    page.write_text("\n".join(["# Times", "", *rows, "", "<!-- plot: `a` | b -->", ""]))
    shown = result_plots.bars(rows, ["`a`", "b"])
    assert [(bar.label, bar.text) for bar in shown] == [
        ("2 arms, slow", "2 ms"),
        ("", "500 µs"),
        ("2 arms, fast", "1 ms"),
    ]
    assert [bar.value for bar in shown] == pytest.approx([2e-3, 5e-4, 1e-3])
    result_plots.withPlots(page)
    assert "](plots/plot_times_1.svg)" in page.read_text() and "<!--" not in page.read_text()
    widths = re.findall(r'<rect [^>]*width="([\d.]+)"', (tmp_path / "plots" / "plot_times_1.svg").read_text())
    assert [float(width) for width in widths] == pytest.approx([330, 82.5, 165])


def test_members_without_a_docstring_are_described():
    from member_texts import rows

    docs = ROOT / "docs"
    described = {**rows(docs / "scenes.md"), **rows(docs / "motion.md")}
    for enum in (ry.ST, ry.JT, ry.SY):
        missing = {member.name for member in enum} - set(described) - {"none", "generic"}
        assert not missing, enum


def test_names_of_examples_become_links_to_their_pages():
    from example_pages import withExampleLinks

    text = "`examples/33_look_plan_pick.py`, `examples/cpp/39_one_kilohertz.cpp`, [`examples/05_features.py`](x)"
    assert withExampleLinks(text, "../") == (
        "[`examples/33_look_plan_pick.py`](../examples/33_look_plan_pick.md), "
        "[`examples/cpp/39_one_kilohertz.cpp`](../examples/39_one_kilohertz.md), [`examples/05_features.py`](x)"
    )
    assert withExampleLinks("`examples/00_first_motion.py`", "") == "[`examples/00_first_motion.py`](install.md)"


def test_a_program_without_a_twin_in_python_has_a_page(tmp_path):
    from example_pages import programPage, titleAndText

    programPage(ROOT / "examples" / "cpp" / "39_one_kilohertz.cpp", tmp_path)
    page = (tmp_path / "39_one_kilohertz.md").read_text()
    assert page.startswith(
        "# A control loop at 1 kHz: inverse kinematics that follow a moving target\n\nPrints how late"
    )
    assert ":language: cpp" in page
    titles = [titleAndText(script)[0] for script in sorted((ROOT / "examples").glob("[0-9]*.py"))]
    assert len(set(titles)) == len(titles) and max(map(len, titles)) <= 85, titles


def test_names_of_cpp_without_a_comment_are_described_and_keywords_are_names(tmp_path):
    import cpp_reference
    import pages

    empty = "<briefdescription></briefdescription><detaileddescription></detaileddescription>"
    place = '<location file="kinegraph/ik/a.h" line="2"/>'
    variable = f'<memberdef kind="variable" prot="public"><type></type><name>double</name>{empty}{place}</memberdef>'
    struct = f"<compounddef><compoundname>kinegraph::AOptions</compoundname>{variable}{empty}{place}</compounddef>"
    head = f"<memberdef kind='function'><type>T</type><name>{{}}</name>{{}}{empty}{place}</memberdef>"
    take = head.format("solve", "<param><type>const AOptions &amp;</type></param>")
    functions = take + head.format("kindName", "") + head.format("plain", "") + head.format("kindName", "")
    (tmp_path / "kinegraph" / "ik").mkdir(parents=True)
    (tmp_path / "kinegraph" / "ik" / "a.h").write_text("struct AOptions {\n  double local = 1.;\n};\n")
    (tmp_path / "structkinegraph_1_1AOptions.xml").write_text(f"<doxygen>{struct}</doxygen>")
    (tmp_path / "namespacekinegraph.xml").write_text(f"<doxygen>{functions}</doxygen>")
    (tmp_path / "index.xml").write_text(
        "<index><compound kind='struct' refid='structkinegraph_1_1AOptions'><name>kinegraph::AOptions</name></compound></index>"
    )
    cpp_reference.cpp_texts.fillDescriptions(tmp_path, tmp_path)
    written = (tmp_path / "structkinegraph_1_1AOptions.xml").read_text()
    assert "Options of solve." in written and "<type>double</type><name>local</name>" in written
    names = cpp_reference.CppNames(tmp_path)
    assert names.headers == {"AOptions": "ik/a.h", "kindName": "ik/a.h"}
    assert [pages.pageOf(header) for header in ("ik/a.h", "api/task_run.h", "common/text.h")] == ["ik", "tasks", "more"]


def test_words_that_people_search_lead_to_headings_that_exist():
    from search_words import WORDS, withSearchWords

    for page in WORDS:
        file = ROOT / ("site" if page == "install" else "docs") / f"{page}.md"
        assert withSearchWords(page, file.read_text()).count("```{index} !") == len(WORDS[page])
    words = [word for places in WORDS.values() for text in places.values() for word in text.split(", ")]
    assert len(set(words)) == len(words) and all(word == word.lower() for word in words)
    with pytest.raises(SystemExit, match="conventions.md has no heading 'Grippers'"):
        withSearchWords("conventions", "# Conventions\n\n## Numbers\n")


def test_links_of_the_site_are_resolved(tmp_path):
    import checks

    (tmp_path / "a.html").write_text('<h1 id="top">A</h1><a href="b.html#part">b</a><a href="#top">top</a>')
    (tmp_path / "b.html").write_text('<h1 id="part">B</h1><a href="c.html">c</a><a href="a.html#gone">a</a>')
    assert checks.brokenLinks(tmp_path) == ["b.html: c.html does not exist", "b.html: a.html#gone has no such anchor"]


def test_pages_of_scenes_share_one_script(tmp_path):
    client, pages = tmp_path / "shared scripts" / "viewer #1.js", tmp_path / "scenes"
    client.parent.mkdir()
    pages.mkdir()
    for i in range(10):
        C = ry.Config()
        C.addText(f"ball: {{ shape: sphere, size: [{0.1 + 0.01 * i}] }}")
        C.viewer().saveHtml(pages / f"{i}.html", client=client)
    written = [file.read_text() for file in pages.iterdir()]
    for page in written:
        assert '<script src="../shared%20scripts/viewer%20%231.js"></script>' in page and 'id="recording"' in page
        assert "script-src 'self' file:;" in page and "sha256-" not in page
    assert sum(map(len, written)) + client.stat().st_size < 3_000_000


def test_a_client_of_another_version_is_not_replaced(tmp_path):
    client = tmp_path / "viewer.js"
    client.write_text("another")
    with pytest.raises(ry.FileError, match=r"saveHtml: the client '.*viewer.js' is another file"):
        ry.Config().viewer().saveHtml(tmp_path / "scene.html", client=client)
    assert client.read_text() == "another" and not (tmp_path / "scene.html").exists()
    with pytest.raises(OSError, match="saveHtml: .* cannot be written"):
        ry.Config().viewer().saveHtml(tmp_path / "missing" / "scene.html")
