"""Who uses the page by keyboard, by a screen reader or with weak eyes finds everything. Usage: accessibility_test.py NEZUMI
[TEST...]"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig
from rig import WALL

VIEWS = ("world", "diagram", "plots", "editor", "drive", "parameters", "cameras", "explain", "console", "log", "scenarios")
LEAST = 4.5  # contrast of text, as WCAG 2.1 AA has it; 3 for large text

# Text in sight whose contrast with what lies behind it is too low: [text, contrast, colour, ground].
PALE = """
  const pen = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgba = (css) => {
    pen.clearRect(0, 0, 1, 1);
    pen.fillStyle = css;
    pen.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = pen.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = ([r, g, b, a], [R, G, B]) => [r * a + R * (1 - a), g * a + G * (1 - a), b * a + B * (1 - a), 1];
  const light = (color) => {
    const [r, g, b] = color.slice(0, 3).map((each) => each / 255).map((each) => (each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ground_of = (node) => {
    const grounds = [];
    for (let at = node; at; at = at.parentElement) {
      grounds.push(rgba(getComputedStyle(at).backgroundColor));
      if (grounds.at(-1)[3] === 1) break;
    }
    return grounds.reverse().reduce((below, each) => over(each, below), [255, 255, 255, 1]);
  };
  const found = new Map();
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let text = walk.nextNode(); text; text = walk.nextNode()) {
    const node = text.parentElement;
    const words = text.textContent.trim();
    const style = getComputedStyle(node);
    const is_there = words && node.checkVisibility({ opacityProperty: true, visibilityProperty: true }) && node.getClientRects().length > 0;
    if (!is_there || node.closest(":disabled, [aria-hidden=true], option, svg, script, noscript, .labels, .CodeMirror-measure")) continue;
    const ground = ground_of(node);
    const ink = over(rgba(style.color), ground);
    const [a, b] = [light(ink), light(ground)].sort((x, y) => y - x);
    const contrast = (a + 0.05) / (b + 0.05);
    const size = parseFloat(style.fontSize);
    const is_large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    if (contrast < (is_large ? 3 : arguments[0])) found.set(`${words.slice(0, 40)} (${node.className || node.tagName})`, contrast.toFixed(2));
  }
  return [...found].map((each) => each.join(": "));
"""

# What can be used but not reached by Tab, arrow keys within a list of tabs apart.
UNREACHED = """
  const used = document.querySelectorAll("button, select, input, textarea, a[href], summary, [role=button], [role=slider], [role=separator], [role=tab], [role=application]");
  return [...used].filter((each) => each.checkVisibility() && !each.disabled && each.tabIndex < 0 && each.getAttribute("role") !== "tab" && !each.closest(".CodeMirror, [aria-hidden=true]"))
    .map((each) => each.outerHTML.slice(0, 120));
"""


class Accessibility(rig.PageCase):
    def setUp(self):
        self.addCleanup(self.page.resize, *self.size)

    def each_view(self):
        for view in VIEWS:
            self.page.view(view)
            if view == "editor":
                self.page.until("document.querySelector('.CodeMirror') !== null", "the editor is there")
            yield view

    def unnamed(self):
        """Roles of what a person can use and that has no name, as the browser tells a screen reader."""
        roles = {"button", "checkbox", "combobox", "link", "listbox", "menuitem", "radio", "searchbox", "slider", "spinbutton", "switch", "tab",
                 "textbox", "application", "separator", "DisclosureTriangle", "img", "dialog", "tabpanel", "tablist"}
        nodes = self.page.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        return [(each["role"]["value"], each.get("backendDOMNodeId")) for each in nodes if not each.get("ignored")
                and each.get("role", {}).get("value") in roles and not each.get("name", {}).get("value", "").strip()]

    def html_of(self, node):
        try:
            return self.page.driver.execute_cdp_cmd("DOM.getOuterHTML", {"backendNodeId": node})["outerHTML"][:160]
        except Exception:  # noqa: BLE001: gone meanwhile
            return ""

    def test_all_that_can_be_used_has_a_name(self):
        self.open(WALL)
        self.page.js("document.body.append(Object.assign(document.createElement('button'), { id: 'nameless' }))")
        self.assertTrue(any("nameless" in self.html_of(node) for _, node in self.unnamed()))
        self.page.js("document.querySelector('#nameless').remove()")
        found = set()
        for view in self.each_view():
            found |= {(view, role, self.html_of(node)) for role, node in self.unnamed()}
        self.assertEqual({each for each in found if each[2]}, set())

    def test_all_that_can_be_used_is_reached_by_the_keyboard(self):
        self.open(WALL)
        found = {(view, each) for view in self.each_view() for each in self.page.js(UNREACHED)}
        self.assertEqual(found, set())
        for view in ("world", "drive", "console"):
            self.page.view(view)
        self.page.js("document.querySelector('.stop').focus()")
        keys = self.page.keys()
        seen = set()
        for _ in range(60):
            keys.send_keys("\ue004").perform()
            keys.reset_actions()
            seen.add(self.page.js("const at = document.activeElement; return at.getAttribute('role') ?? at.tagName"))
        self.assertLessEqual({"tab", "BUTTON", "SELECT", "application", "TEXTAREA"}, seen)

    def test_a_focus_is_seen(self):
        self.open(WALL)
        self.page.js("document.querySelector('.stop').focus()")
        self.page.keys().send_keys("\ue004").perform()
        self.assertNotEqual(self.page.js("return getComputedStyle(document.activeElement).outlineStyle"), "none")

    def test_text_is_dark_enough_to_be_read_in_light_and_dark_colours(self):
        self.open(WALL)
        self.page.js("document.querySelector('.view .hint').style.color = '#999'")
        self.assertTrue(self.page.js(PALE, LEAST))
        self.page.js("document.querySelector('.view .hint').style.color = ''")
        found = set()
        for dark in (False, True):
            self.page.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
                {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}, {"name": "prefers-reduced-motion", "value": "reduce"}]})
            self.page.drawn()
            for view in self.each_view():
                found |= {("dark" if dark else "light", view, each) for each in self.page.js(PALE, LEAST)}
        self.assertEqual(found, set())


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
