"""The page as a new person sees it: on a screen, a tablet and a phone, in both languages, nothing lies over something else or
is cut off. Usage: walk_test.py NEZUMI [TEST...]"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

SIZES = ((1280, 800), (800, 600), (390, 844))
VIEWS = ("world", "diagram", "plots", "drive", "parameters", "cameras", "explain", "console", "log", "scenarios")

# What can be used and lies over another such thing, or is not wholly on the screen; what scrolls is left out.
WRONG = """
  const used = [...document.querySelectorAll("button, select, input, textarea, summary")].filter((each) => each.checkVisibility() &&
    !each.closest(".marks, .CodeMirror") && each.getBoundingClientRect().width > 0);
  const name = (each) => (each.getAttribute("aria-label") ?? (each.textContent || each.className)).trim().slice(0, 30);
  const scrolls = (each) => {
    for (let at = each.parentElement; at; at = at.parentElement) if (/auto|scroll/.test(getComputedStyle(at).overflowX + getComputedStyle(at).overflowY)) return true;
    return false;
  };
  const fixed = used.filter((each) => !scrolls(each));
  const box = (each) => each.getBoundingClientRect();
  const found = fixed.filter((each) => box(each).right > innerWidth + 1 || box(each).left < -1 || box(each).bottom > innerHeight + 1).map((each) => `${name(each)} is beyond the edge`);
  fixed.forEach((one, i) => fixed.slice(i + 1).forEach((other) => {
    if (one.contains(other) || other.contains(one)) return;
    const [a, b] = [box(one), box(other)];
    const [w, h] = [Math.min(a.right, b.right) - Math.max(a.left, b.left), Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top)];
    if (w > 3 && h > 3) found.push(`${name(one)} lies over ${name(other)}`);
  }));
  return found;
"""


class Walk(rig.PageCase):
    def setUp(self):
        self.addCleanup(self.page.resize, *self.size)

    def walk(self, system):
        self.open(system)
        self.page.js("document.querySelector('header .run').click()")  # a world that stands is drawn less often
        wrong = []
        for size in SIZES:
            self.page.resize(*size)
            for view in VIEWS:
                self.page.view(view)
                wrong += [(size[0], view, each) for each in self.page.js(WRONG)]
        self.assertEqual(wrong, [])
        self.assertEqual(self.page.errors(), [])

    def test_what_lies_over_something_else_is_found(self):
        self.open(rig.WALL)
        self.page.js("document.querySelector('button.stop').style.cssText = 'position: fixed; left: 0; top: 0'")
        self.assertTrue(self.page.js(WRONG))

    def test_a_system_with_a_camera_and_a_long_name(self):
        self.walk("behaviors/systems/camera_line_follower.lua")

    def test_an_ev3(self):
        self.walk("behaviors/systems/errand.lua")

    def test_lateness_has_room_on_a_phone(self):
        self.page.resize(390, 844)
        self.open(rig.WALL)
        late = "12.6 ms 遅れ" if self.language == "ja" else "12.6 ms late"
        right, needed, given = self.page.js("""
            document.querySelector('.late').textContent = arguments[0];
            const late = document.querySelector('.late');
            return [document.querySelector('header .time select').getBoundingClientRect().right, late.scrollWidth, late.clientWidth];""", late)
        self.assertLessEqual(right, 380, "within the bar")
        self.assertLessEqual(needed, given, "all of it is seen")

    def test_the_pad_is_on_a_tablets_screen(self):
        self.page.resize(800, 600)
        self.open(rig.WALL)
        self.page.view("drive")
        pad, nav = (self.page.js("const { left, top, bottom } = document.querySelector(arguments[0]).getBoundingClientRect(); return [left, top, bottom]", each) for each in (".pad", ".bottom"))
        self.assertLess(pad[2], nav[1])
        self.assertGreater(pad[0], 400, "beside the world")

    def test_the_many_keys_of_an_ev3_do_not_hide_the_world_on_a_phone(self):
        self.page.resize(390, 844)
        self.open("behaviors/systems/errand.lua")
        self.page.view("drive")
        self.page.until("!document.querySelector('.devices').hidden", "its devices are there")
        self.assertLess(self.page.js("return document.querySelector('.devices').offsetHeight"), 60)
        self.page.find(".devices summary").click()
        self.assertTrue(self.page.find(".devices button").is_displayed())

    def test_the_editors_style_is_its_own(self):
        self.open(rig.WALL)
        page = self.page
        page.view("editor")
        page.until("document.querySelector('.CodeMirror') !== null", "the editor is there")
        page.view("scenarios")
        page.until("document.querySelector('.scenario .place') !== null", "scenarios are listed")
        self.assertEqual(page.js("return getComputedStyle(document.querySelector('.scenario .place')).boxShadow"), "none")


class WalkInJapanese(Walk):
    language = "ja"


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
