"""The panel of the page: switches, tree of frames, keys, pictures."""

from __future__ import annotations

import base64
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import kinegraph as kg

from .browser import Browser
from .camera import Camera

LEAVES = "[...document.querySelectorAll('#tree .leaf, #tree summary')].filter((x) => x.checkVisibility()).map((x) => x.textContent).join(' ')"


@pytest.fixture
def page(config: kg.Config, browser: Browser) -> Iterator[Browser]:
    """Shows a table with a box and a transparent box on it, and a marker."""
    config.addFrame("table").setShape(kg.ST.ssBox, [1, 1, 0.1, 0.02]).setColor([0, 0.7, 0])
    config.addFrame("box", "table").setShape(kg.ST.box, [0.3, 0.3, 0.3]).setColor([1, 0, 0]).setRelativePosition(
        [0, 0, 0.5]
    )
    config.addFrame("ghost", "table").setShape(kg.ST.sphere, [0.2]).setColor([0, 0, 1, 0.5]).setRelativePosition(
        [0.4, 0, 0.9]
    )
    config.addFrame("target").setShape(kg.ST.marker, [0.5]).setPosition([-0.5, 0, 1])
    config.view()
    config.viewer().setCamera(CAMERA.position, CAMERA.target)
    browser.open(config.viewer().url)
    yield browser
    assert config.viewer().takeKey() == 0  # nothing that was meant for the panel reaches the program


def test_collision_shapes_are_shown_when_somebody_asks_for_them(config: kg.Config, browser: Browser) -> None:
    """Nearly transparent collision shapes are hidden; other transparent shapes are visible."""
    for i, (name, alpha, contact) in enumerate([("hull", 0.1, 1), ("haze", 0.1, 0), ("glass", 0.5, 1), ("wall", 1, 1)]):
        frame = config.addFrame(name).setShape(kg.ST.box, [0.4, 0.4, 0.4]).setPosition([0.6 * i - 0.9, 0, 0.5])
        frame.setColor([1, 0, 0, alpha]).setContact(contact)
    config.view()
    config.viewer().setCamera([0, -4, 0.5], [0, 0, 0.5])
    browser.open(config.viewer().url)

    def seen() -> list[str]:
        """Returns the frames found by clicks."""
        names = []
        for i in range(4):
            browser.click(*browser.pixel([0.6 * i - 0.9, -0.2, 0.5]))
            names.append(browser.evaluate("kinegraph.selected()"))
            browser.press("Escape")  # the card is in front of the scene
        return names

    assert seen() == [None, "haze", "glass", "wall"]
    browser.press_alt("L")
    assert seen() == ["hull", "haze", "glass", "wall"]


# a visible point of each object, and the channel of its color
PLACES = {
    "table": ([0.3, 0.4, 0.05], 1),
    "box": ([0, 0.15, 0.5], 0),
    "ghost": ([0.4, 0, 0.9], 2),
    "target": ([-0.5, 0, 1.2], 2),
}
CAMERA = Camera([0, 3, 1], [0, 0, 0.5])


def seen(page: Browser) -> set[str]:
    """Returns the objects that are visible at their points."""
    picture = page.picture().astype(int)
    names = set()
    for name, (point, channel) in PLACES.items():
        x, y = page.pixel(point)
        color = picture[round(y), round(x)]
        if color[channel] > np.delete(color, channel).max() + 30:
            names.add(name)
    return names


def test_switches_hide_and_show_kinds_of_shapes(page: Browser) -> None:
    assert seen(page) == {"table", "box", "ghost", "target"}
    page.press_alt("C")
    assert seen(page) == {"table", "box", "target"}
    page.press_alt("M")
    assert seen(page) == {"table", "box"}
    page.press_alt("V")
    assert seen(page) == set()
    for letter in "CMV":
        page.press_alt(letter)
    assert seen(page) == {"table", "box", "ghost", "target"}


def test_names_and_axes_of_frames_can_be_shown(page: Browser) -> None:
    page.press_alt("N")
    page.wait_for(
        "[...document.querySelectorAll('.name')].map((x) => x.textContent).join() == 'table,box,ghost,target'"
    )
    assert page.is_visible(".name")
    geometries = page.evaluate("kinegraph.geometries()")
    page.press_alt("N")
    page.wait_for("[...document.querySelectorAll('.name')].every((x) => !x.checkVisibility())")
    page.press_alt("A")
    page.wait_for(f"kinegraph.idle() && kinegraph.geometries() > {geometries}")


def test_of_overlapping_names_the_nearest_is_shown(config: kg.Config, browser: Browser) -> None:
    for name, place in {"far": [0, 0.5, 0.5], "near": [0, 0, 0.5], "beside": [0.8, 0, 0.5]}.items():
        config.addFrame(name).setPosition(place)
    config.view()
    config.viewer().setCamera([0, -3, 0.5], [0, 0, 0.5])
    browser.open(config.viewer().url)
    browser.press_alt("N")
    visible = (
        "[...document.querySelectorAll('.name')].filter((x) => x.checkVisibility({ visibilityProperty: true }))"
        ".map((x) => x.textContent).sort().join()"
    )
    browser.wait_for(f"{visible} === 'beside,near'")
    config.getFrame("far").setPosition([0, 0.5, 0.8])
    config.view()
    browser.wait_for(f"{visible} === 'beside,far,near'")


def test_the_tree_shows_hides_and_searches_frames(page: Browser) -> None:
    page.press_alt("T")
    page.wait_for(f"{LEAVES} == 'table box ghost target'")
    assert page.evaluate("document.activeElement.id") == "search"
    page.type("BO")
    page.wait_for(f"{LEAVES} == 'table box'")
    page.type("xyz")
    page.wait_for("document.querySelector('#tree').textContent == 'no such frame'")
    page.evaluate(
        "document.querySelector('#search').value = ''; document.querySelector('#search').dispatchEvent(new Event('input'))"
    )
    page.evaluate("document.querySelector('[aria-label=\"show box\"]').click()")
    assert seen(page) >= {"table", "ghost"}
    assert "box" not in seen(page)
    page.evaluate("document.querySelector('[aria-label=\"show table\"]').click()")
    assert not seen(page) & {"table", "box", "ghost"}
    page.press("Escape")
    page.wait_for("document.querySelector('#panel').hidden")


def test_names_at_the_end_of_a_long_chain_fit_into_the_tree(config: kg.Config, browser: Browser) -> None:
    for i in range(24):
        config.addFrame(f"joint_{i:02d}_origin", f"joint_{i - 1:02d}_origin" if i else "")
    config.view()
    browser.open(config.viewer().url)
    browser.press_alt("T")
    right = "[...document.querySelectorAll('#tree .frame')].at(-1).getBoundingClientRect().right"
    assert browser.evaluate(right) <= browser.evaluate("document.querySelector('#tree').getBoundingClientRect().right")


def test_the_tree_follows_the_scene(page: Browser, config: kg.Config) -> None:
    page.press_alt("T")
    page.evaluate("document.querySelector('[aria-label=\"show ghost\"]').click()")
    page.evaluate("document.querySelector('#tree summary').click()")
    page.wait_for(f"{LEAVES} == 'table target'")
    config.addFrame("new", "target")
    config.delFrame("box")
    config.view()
    page.wait_for(f"{LEAVES} == 'table target new'")
    assert not page.evaluate("document.querySelector('[aria-label=\"show ghost\"]').checked")
    assert "ghost" not in seen(page)


def test_everything_in_the_panel_is_reached_by_the_tab_key(page: Browser) -> None:
    page.press_alt("T")
    reached = set()
    for _ in range(40):
        page.press("Tab", code="Tab", windowsVirtualKeyCode=9)
        reached.add(
            page.evaluate(
                "document.activeElement.ariaLabel || document.activeElement.id || document.activeElement.tagName"
            )
        )
    assert {"show table", "show box", "show ghost", "show target", "SUMMARY", "search frames"} <= reached
    page.press_alt("O")
    page.wait_for("document.activeElement.closest('#tab-view') !== null")
    for _ in range(40):
        page.press("Tab", code="Tab", windowsVirtualKeyCode=9)
        reached.add(page.evaluate("document.activeElement.id || document.activeElement.textContent"))
    assert {"front", "aslant", "picture", "model", "page", "help-button"} <= reached


def test_a_scene_is_seen_as_it_was_left(page: Browser, config: kg.Config) -> None:
    other = kg.Config()
    other.addFrame("something else")
    for i in range(2):
        other.addFrame(f"box{i}").setShape(kg.ST.box, [0.5, 0.5, 0.5])
    other.view()
    page.open(other.viewer().url)
    first = page.evaluate("kinegraph.camera()")
    page.drag((300, 200), (360, 240))
    page.press_alt("N")
    turned = page.evaluate("kinegraph.camera()")
    page.open(other.viewer().url)
    assert page.evaluate("kinegraph.camera()") == pytest.approx(turned)
    assert page.is_visible(".name")
    other.viewer().setCamera([4, 0, 1], [0, 0, 0])  # the program takes precedence
    page.open(other.viewer().url)
    assert page.evaluate("kinegraph.camera()") == pytest.approx([4, 0, 1])
    assert first != turned
    other.view_close()


def test_the_question_mark_shows_and_hides_the_help(page: Browser) -> None:
    assert not page.is_visible("#help")
    page.press("?")
    assert page.is_visible("#help")
    page.press("?")
    assert not page.is_visible("#help")


def test_the_picture_is_saved_as_png(page: Browser, tmp_path: Path) -> None:
    page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    page.press_alt("P")
    deadline = time.monotonic() + 30
    while not (files := list(tmp_path.glob("*.png"))) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert [file.name for file in files] == ["Kinegraph.png"]
    assert files[0].read_bytes().startswith(b"\x89PNG")
    size = page.evaluate(f"""(async () => {{
      const answer = await fetch("data:image/png;base64,{base64.b64encode(files[0].read_bytes()).decode()}");
      const picture = await createImageBitmap(await answer.blob());
      return [picture.width, picture.height];
    }})()""")
    assert size[0] * 3 == size[1] * 4
    assert size[0] >= 640
    assert files[0].stat().st_size > 5000  # not an empty canvas


def test_keys_reach_the_program_after_a_box_was_ticked(config: kg.Config, browser: Browser) -> None:
    config.addFrame("box").setShape(kg.ST.box, [0.4, 0.4, 0.4])
    config.view()
    browser.open(config.viewer().url)
    browser.press_alt("O")
    browser.evaluate("document.querySelector('#options input').focus()")
    browser.press(" ", code="Space", text=" ")
    browser.press("q", code="KeyQ", text="q")
    deadline = time.monotonic() + 10
    keys = []
    while ord("q") not in keys and time.monotonic() < deadline:
        keys.append(config.viewer().takeKey())
    assert [key for key in keys if key] == [ord("q")]


def test_the_tab_key_reaches_the_round_buttons_while_the_panel_is_closed(page: Browser) -> None:
    reached = set()
    for _ in range(16):
        page.press("Tab", code="Tab", windowsVirtualKeyCode=9)
        reached.add(page.evaluate("document.activeElement.id"))
    assert {"panel-button", "help-button"} <= reached


def test_a_long_message_scrolls(page: Browser, config: kg.Config) -> None:
    config.view(False, "\n".join(f"line {i}" for i in range(60)))
    page.wait_for("kinegraph.message().includes('line 59')")
    inside, whole, bottom = page.evaluate(
        "((x) => [x.clientHeight, x.scrollHeight, x.getBoundingClientRect().bottom])(document.querySelector('#message'))"
    )
    assert inside < whole
    assert bottom < page.evaluate("innerHeight")


def test_boxes_below_a_hidden_frame_are_gray(page: Browser) -> None:
    page.press_alt("T")
    box = "document.querySelector('[aria-label=\"show {}\"]')"
    assert not page.evaluate(box.format("box") + ".disabled")
    page.evaluate(box.format("table") + ".click()")
    assert page.evaluate(f"[{box.format('box')}.disabled, {box.format('target')}.disabled]") == [True, False]
    page.evaluate(box.format("table") + ".click()")
    assert not page.evaluate(box.format("box") + ".disabled")


def test_the_frame_under_a_resting_mouse_is_named(page: Browser) -> None:
    page.mouse("mouseMoved", *page.pixel([0, 0, 0.5]))
    page.wait_for("document.querySelector('#hover').checkVisibility()")
    assert page.evaluate("document.querySelector('#hover').textContent") == "box"
    assert page.evaluate("getComputedStyle(document.querySelector('#canvas')).cursor") == "pointer"
    page.mouse("mouseMoved", 3, 3)
    page.wait_for("!document.querySelector('#hover').checkVisibility()")


def test_presets_glide(page: Browser) -> None:
    places = """(async () => {
      const places = new Set(), start = performance.now();
      dispatchEvent(new KeyboardEvent("keydown", { altKey: true, code: "Digit3", key: "3" }));
      while (performance.now() - start < 5000 && (places.size < 2 || !kinegraph.idle())) {
        places.add(JSON.stringify(kinegraph.camera()));
        await new Promise(requestAnimationFrame);
      }
      return [...places].map(JSON.parse);
    })()"""
    seen = page.evaluate(places)
    assert len(seen) > 2
    assert abs(seen[-1][0]) < 0.2 and seen[-1][2] > 1.5
