"""The arena edited by hand in the browser's page. Usage: arena_test.py NEZUMI [TEST...]"""

import math
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

ROOM = """-- A room with a table.
arena {
  size = { 2.0, 2.0 },
  box { at = { 0.6, 0.3 }, size = { 0.2, 0.2, 0.1 } },  -- the table
}
robot "mouse" { model = "raspimouse" }
"""
CONTROL, DELETE, RIGHT = "\ue009", "\ue017", "\ue014"


class Arena(rig.PageCase):
    def begin(self, text=ROOM):
        self.run = self.open(text=text)
        self.page.press("Edit arena")
        self.told("Changes are written into tried.lua")

    def on_disk(self):
        with open(os.path.join(self.run.folder, "tried.lua")) as file:
            return file.read()

    def told(self, part):
        self.page.until("document.querySelector('.arena-tools [role=status]')?.textContent.includes(%r)" % part,
                        lambda: "it tells %r, not %r" % (part, self.page.text(".arena-tools [role=status]")))

    def becomes(self, text):
        rig.wait_until(lambda: self.on_disk() == text, lambda: "the file is %r, not %r, %s" % (text, self.on_disk(), self.page.text(".arena-tools [role=status]")))

    def choose(self, name):
        self.page.choose_text(".world .tools select", name)
        self.page.js("document.querySelector('.world canvas').focus()")

    def test_texts_of_system_files_are_changed_where_they_must(self):
        self.open(text=ROOM)
        self.check_modules("arena_text_test.js", 18)

    def test_a_thing_that_is_moved_and_turned_by_keys_is_written_with_its_comment(self):
        self.begin()
        self.choose("box 1")
        canvas = self.page.driver.switch_to.active_element
        canvas.send_keys(RIGHT)
        moved = ROOM.replace("{ 0.6, 0.3 }", "{ 0.62, 0.3 }")
        self.becomes(moved)
        self.told("Written into tried.lua")
        self.choose("box 1")
        self.page.driver.switch_to.active_element.send_keys("[")
        self.becomes(moved.replace("0.1 } },", "0.1 }, yaw = 0.0873 },"))
        self.told("Written")
        self.page.press("Undo")
        self.becomes(moved)
        self.page.find(".world canvas").send_keys(CONTROL + "z")
        self.becomes(ROOM)
        self.assertEqual(self.page.text(".late"), "paused")

    def test_a_thing_is_dragged(self):
        from selenium.webdriver.common.action_chains import ActionChains

        self.begin()
        page = self.page
        page.press("Top")
        self.choose("box 1")
        pixel = page.until("document.querySelector('.world canvas').dataset.chosen", "it is chosen")
        x, y = (float(each) for each in pixel.split(","))
        width, height = page.js("const box = document.querySelector('.world canvas').getBoundingClientRect(); return [box.width, box.height]")
        ActionChains(page.driver).move_to_element_with_offset(page.find(".world canvas"), x - width / 2, y - height / 2).click_and_hold().move_by_offset(-60, 0) \
            .move_by_offset(-10, 0).release().perform()
        rig.wait_until(lambda: self.on_disk() != ROOM, "the file changes")
        self.assertIn("-- the table", self.on_disk())
        self.assertNotIn("{ 0.6, 0.3 }", self.on_disk())

    def test_a_thing_is_dragged_by_a_finger_on_a_phone(self):
        page = self.page
        self.addCleanup(page.resize, *self.size)
        page.resize(390, 844)
        self.begin()
        page.press("Top")
        self.choose("box 1")
        pixel = page.until("document.querySelector('.world canvas').dataset.chosen", "it is chosen")
        left, top = page.js("const box = document.querySelector('.world canvas').getBoundingClientRect(); return [box.left, box.top]")
        x, y = (each + edge for each, edge in zip((float(each) for each in pixel.split(",")), (left, top)))

        def touch(kind, *points):
            page.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x + dx, "y": y} for dx in points]})
        touch("touchStart", 0)
        for dx in (-8, -16, -24):
            touch("touchMove", dx)
        touch("touchEnd")
        rig.wait_until(lambda: self.on_disk() != ROOM, lambda: "the file changes: %s" % page.text(".arena-tools [role=status]"))
        self.assertIn("-- the table", self.on_disk())

    def test_things_and_robots_are_added_and_removed(self):
        self.begin()
        page = self.page
        for word, name in (("Box", "box 2"), ("Wall", "box 3"), ("Cylinder", "cylinder 1"), ("Marker", "marker"), ("Robot", "robot1")):
            page.press(word)
            page.until("[...document.querySelector('.world .tools select').options].some((each) => each.textContent.startsWith(%r))" % name,
                       lambda: "%s is there: %s" % (name, page.text(".arena-tools [role=status]")))
        self.assertTrue(self.on_disk().startswith(ROOM.split("}\nrobot")[0]))
        self.assertEqual(page.errors(), [])
        before = self.on_disk()
        self.choose("cylinder 1")
        self.page.driver.switch_to.active_element.send_keys(DELETE)
        rig.wait_until(lambda: "cylinder" not in self.on_disk(), "it is removed")
        page.press("Undo")
        self.becomes(before)

    def test_keys_undo_what_a_button_did(self):
        self.begin()
        page = self.page
        page.press("Box")
        rig.wait_until(lambda: self.on_disk().count("box {") == 2, "a box is added")
        self.told("Written")
        for _ in range(2):  # the second time nothing is left, and the button has lost the focus
            page.keys().key_down(CONTROL).send_keys("z").key_up(CONTROL).perform()
            self.becomes(ROOM)
        page.press("Box")
        rig.wait_until(lambda: self.on_disk().count("box {") == 2, "a box is added")
        self.told("Written")
        page.find(".console textarea").click()
        page.keys().key_down(CONTROL).send_keys("z").key_up(CONTROL).perform()
        page.drawn()
        self.assertEqual(self.on_disk().count("box {"), 2, "in a text Ctrl-Z is the text's own")

    def test_things_that_are_added_do_not_overlap(self):
        self.begin()
        for word in ("Box", "Box", "Box", "Wall", "Cylinder", "Marker", "Wall", "Robot"):
            before = self.on_disk()
            self.page.press(word)
            rig.wait_until(lambda: self.on_disk() != before, lambda: "%s is added: %s" % (word, self.page.text(".arena-tools [role=status]")))
        text = self.on_disk()
        number = r"(-?[\d.]+)"
        circles = [(0.0, 0.0, 0.04), (0.6, 0.3, 0.1)]  # the mouse, the table: what is within them for sure
        for kind, radius in (("box", 0.05), ("cylinder", 0.05), ("marker", 0.04)):
            for at in re.findall(kind + r" \{.*?at = \{ " + number + ", " + number, text):
                if at != ("0.6", "0.3"):
                    circles.append((*map(float, at), radius))
        for x, low, high in re.findall(r"wall \{ from = \{ " + number + ", " + number + r" \}, to = \{ [-\d.]+, " + number, text):
            circles += [(float(x), float(low) + (float(high) - float(low)) * i / 10, 0.004 + i / 1e9) for i in range(11)]
        circles += [(float(x), float(y), 0.04) for x, y in re.findall(r"pose = \{ x = " + number + ", y = " + number, text)]
        self.assertEqual(len(circles), 2 + 3 + 1 + 1 + 2 * 11 + 1)
        self.page.picture("arena_added")
        walls = [each for each in circles if each[2] < 0.01]
        for i, one in enumerate(circles):
            for other in circles[i + 1:]:
                if one in walls and other in walls:
                    continue
                self.assertGreater(math.dist(one[:2], other[:2]), one[2] + other[2], "%s and %s in %s" % (one, other, text))

    def test_what_can_not_be_is_refused_and_not_written(self):
        self.begin()
        self.choose("mouse")
        for _ in range(4):
            self.page.find(".world canvas").send_keys("+")
        self.page.press("Edit arena")
        self.page.press("Edit arena")
        self.told("Changes")
        computed = ROOM.replace("{ 0.6, 0.3 }", "{ 0.6 + 0, 0.3 }")
        with open(os.path.join(self.run.folder, "tried.lua"), "w") as out:
            out.write(computed)
        self.choose("box 1")
        self.page.driver.switch_to.active_element.send_keys(RIGHT)
        self.told("Another program has changed the file")
        self.choose("box 1")
        self.page.driver.switch_to.active_element.send_keys(RIGHT)
        self.told("'at' is computed")
        self.assertEqual(self.on_disk(), computed)


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
