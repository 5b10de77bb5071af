"""The page works with the keyboard and screen readers, and its texts are legible."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import kinegraph as kg

from .browser import Browser

# the smallest contrast of all visible texts, and its place: by WCAG 2, with blended backgrounds
CONTRAST = """(() => {
  const context = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
  const rgba = (color) => { context.clearRect(0, 0, 1, 1); context.fillStyle = color; context.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = context.getImageData(0, 0, 1, 1).data; return [r, g, b, a / 255]; };
  const over = (top, below) => [0, 1, 2].map((i) => top[3] * top[i] + (1 - top[3]) * below[i]);
  const opacity = (element) => element ? Number(getComputedStyle(element).opacity) * opacity(element.parentElement) : 1;
  const ground = (element) => {
    if (!element) return rgba(getComputedStyle(document.documentElement).getPropertyValue("--paper")).slice(0, 3);
    return over(rgba(getComputedStyle(element).backgroundColor), ground(element.parentElement));
  };
  const luminance = (color) => { const [r, g, b] = color.map((x) => (x /= 255) <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  let worst = [Infinity, ""], count = 0;
  for (const element of document.body.querySelectorAll("*")) {
    const text = [...element.childNodes].filter((x) => x.nodeType === 3).map((x) => x.textContent.trim()).join("") || element.value;
    if (!text || ["SCRIPT", "OPTION"].includes(element.tagName) || element.type === "checkbox" || element.type === "range") continue;
    if (element.disabled || !element.checkVisibility() || element.closest(".labels")) continue;
    const below = ground(element), color = rgba(getComputedStyle(element).color);
    const ink = luminance(over([...color.slice(0, 3), color[3] * opacity(element)], below)), paper = luminance(below);
    const contrast = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
    ++count;
    if (contrast < worst[0]) worst = [contrast, `${element.tagName} ${element.id}.${element.className}: ${text.slice(0, 40)}`];
  }
  return [count, ...worst];
})()"""


@pytest.fixture
def page(config: kg.Config, browser: Browser) -> Iterator[Browser]:
    """The page with everything open: message, error, panel, card, help, motion."""
    config.addFrame("table").setShape(kg.ST.box, [1, 1, 0.1])
    config.addFrame("arm", "table").setJoint(kg.JT.hingeX, [-1, 1]).setShape(kg.ST.box, [0.1, 0.1, 0.5])
    config.view(False, "a message")
    config.viewer().setError("an error")
    config.view_path([[0.0], [0.5]], 0.05)
    config.viewer().select(config.getFrame("arm").ID)
    browser.open(config.viewer().url)
    browser.wait_for("kinegraph.selected() === 'arm' && kinegraph.slice() === 1")
    yield browser
    browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "light"}])


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_texts_can_be_read(page: Browser, scheme: str) -> None:
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
    page.press("?")
    for letter in "TJO":
        page.press_alt(letter)
        count, contrast, where = page.evaluate(CONTRAST)
        assert count > 30
        assert contrast >= 4.5, where
        assert page.is_visible("#help")


def test_everything_that_can_be_used_has_a_name(page: Browser) -> None:
    roles = {"button", "checkbox", "slider", "spinbutton", "searchbox", "combobox", "tab", "link", "textbox", "img"}
    seen = set()
    for letter in "TJO":
        page.press_alt(letter)
        page.call("Accessibility.enable")
        for node in page.call("Accessibility.getFullAXTree")["nodes"]:
            role = node.get("role", {}).get("value")
            if node["ignored"] or role not in roles:
                continue
            seen.add(role)
            assert node.get("name", {}).get("value"), node
    assert seen >= {"button", "checkbox", "slider", "spinbutton", "searchbox", "tab", "combobox"}


def test_the_focus_is_seen_wherever_the_tab_key_leads(page: Browser) -> None:
    page.press_alt("T")
    rings, reached = set(), set()
    for step in range(80):
        if step == 50:
            page.press_alt("T")  # on narrow pages the panel hides the card
        page.press("Tab", code="Tab", windowsVirtualKeyCode=9)
        name, ring = page.evaluate("""((x) => [x.ariaLabel || x.id || x.textContent,
          getComputedStyle(x).outlineStyle + " " + getComputedStyle(x).outlineWidth])(document.activeElement)""")
        reached.add(name)
        if not page.evaluate("document.activeElement === document.body"):
            rings.add(ring)
    assert {"show table", "play", "time", "speed", "copy as .g", "move", "search frames"} <= reached
    assert rings == {"solid 2px"}


def test_the_scene_itself_is_moved_with_the_keyboard(page: Browser) -> None:
    page.press("Escape")
    page.press("Escape")
    before = page.evaluate("kinegraph.camera()")
    page.press("3", code="Digit3", modifiers=1)  # Alt 3: from above
    page.wait_for(f"JSON.stringify(kinegraph.camera()) !== '{str(before).replace(' ', '')}'")
    page.wait_for("kinegraph.idle()")  # it glides there
    above = page.evaluate("kinegraph.camera()")
    page.press("ArrowLeft", code="ArrowLeft", modifiers=1)
    page.press("PageUp", code="PageUp", modifiers=1)
    page.press("ArrowDown", code="ArrowDown", modifiers=1)
    x, y, z = page.evaluate("kinegraph.camera()")
    assert z < above[2]
    assert x**2 + y**2 > above[0] ** 2 + above[1] ** 2 + 0.01
    page.press("Home")
    page.wait_for(f"JSON.stringify(kinegraph.camera()) !== '{str(above).replace(' ', '')}'")
