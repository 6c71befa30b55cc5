"""Robots moved and driven by hand on the page, in a real browser. Usage: hands_test.py NEZUMI [TEST...]"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

STICK = "behaviors/systems/joystick.lua"
STANDING = """
arena { size = { 2, 2 }, marker { name = "tag", id = 7, size = 0.1, at = { 0.5, 0.5, 0.1 }, facing = math.pi } }
robot "mouse" { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
robot "other" { model = "raspimouse", pose = { x = -0.5, y = 0.5, heading = 0 } }
"""


class World(rig.PageCase):
    """The world, and hands on it."""

    def at(self, name):
        """The pixel of what is called so, in the window."""
        found = self.page.js("""
            const label = [...document.querySelectorAll('.labels .name')].find((each) => !each.hidden && each.textContent === arguments[0]);
            if (!label) return null;
            const [, x, y] = /translate\\(([-0-9.]+)px, ([-0-9.]+)px\\)/.exec(label.style.transform).map(Number);
            const box = label.parentElement.getBoundingClientRect();
            return [box.left + x, box.top + y];""", name)
        return found

    def drag(self, start, by):
        keys = self.page.keys()
        keys.w3c_actions.pointer_action.move_to_location(round(start[0]), round(start[1]))
        keys.w3c_actions.pointer_action.pointer_down()
        for part in (0.3, 0.7, 1):
            keys.w3c_actions.pointer_action.move_to_location(round(start[0] + by[0] * part), round(start[1] + by[1] * part))
        keys.w3c_actions.pointer_action.pointer_up()
        keys.w3c_actions.perform()

    def test_a_robot_is_dragged_to_another_place(self):
        self.open(text=STANDING)
        self.page.press("Top")
        self.page.choose(".world select", "robot 0")
        self.page.drawn()
        start = rig.wait_until(lambda: self.at("mouse"), "the robot's name is shown")
        self.drag(start, (0, 120))
        rig.wait_until(lambda: self.page.pose()[1] < -0.15, lambda: "the robot is farther south than %r" % self.page.pose())
        x, _, heading = self.page.pose()
        self.assertAlmostEqual(x, 0, delta=0.05)
        self.assertAlmostEqual(heading, 0, delta=1)
        self.assertIn("teleport mouse", self.log())

    def log(self):
        self.page.view("log")
        return self.page.text(".log .lines")

    def test_what_is_chosen_is_moved_and_turned_by_keys(self):
        self.open(text=STANDING)
        self.page.choose(".world select", "robot 0")
        canvas = self.page.find(".world canvas")
        canvas.send_keys("\ue014\ue014\ue014")  # to the right
        rig.wait_until(lambda: self.page.pose()[0] > 0.03, "the robot moves east")
        canvas.send_keys("[[")
        rig.wait_until(lambda: self.page.pose()[2] > 4, "the robot turns left")

    def test_a_marker_is_moved(self):
        self.open(text=STANDING)
        self.page.choose(".world select", "marker 0")
        self.assertAlmostEqual(self.page.pose()[0], 0.5, delta=0.001)
        self.page.find(".world canvas").send_keys("\ue012\ue012")  # to the left
        rig.wait_until(lambda: self.page.pose()[0] < 0.48, "the marker has moved west")
        self.assertAlmostEqual(abs(self.page.pose()[2]), 180, delta=0.5)

    def test_a_thousand_robots_are_drawn_in_fewer_than_20_calls(self):
        self.open(text="""
            for i = 0, 999 do
              robot("mouse_" .. i, { model = "raspimouse", pose = { x = (i % 40) * 0.3, y = (i // 40) * 0.3, heading = i } })
            end""")
        self.page.until("Number(document.querySelector('canvas').dataset.calls) > 3", "the robots are drawn")
        calls = int(self.page.js("return document.querySelector('canvas').dataset.calls"))
        self.assertLess(calls, 20)


class Driving(rig.PageCase):
    """The pad, and who drives."""

    def hold(self, key):
        keys = self.page.keys().click(self.page.find(".pad"))
        keys.key_down(key).perform()

    def release(self, key):
        self.page.keys().key_up(key).perform()

    def test_arrow_keys_drive_while_they_are_held(self):
        self.open(text=STANDING)
        page = self.page
        page.choose(".world select", "robot 0")
        self.hold("\ue013")  # forward
        page.until("document.querySelector('.who').textContent === 'You drive.'", "the page says who drives")
        self.assertEqual(page.text(".cells output"), "0")
        self.assertEqual([each.text for each in page.all(".cells output")], ["0", "150", "150", "90", "0.30", "0.00"])
        rig.wait_until(lambda: page.pose()[0] > 0.1, "the robot drives forward")
        self.release("\ue013")
        page.until("document.querySelector('.who').textContent === 'No driver.'", "no driver any more")
        self.stands()

    def test_a_joystick_component_hears_pixels(self):
        self.open(STICK)
        page = self.page
        page.choose(".driving select", "stick.pos")
        page.choose(".world select", "robot 0")
        self.hold("\ue013")
        rig.wait_until(lambda: page.pose()[0] > 0.1, "both robots drive forward")
        page.view("plots")
        page.unfold("stick", "stick.pos")
        page.until("document.querySelectorAll('.tree [data-key^=\"stick.pos \"]').length === 2", "the stick has two numbers")
        page.view("world")
        self.release("\ue013")
        self.stands()

    def test_dragging_the_stick_turns_the_robot_and_letting_go_centres_it(self):
        self.open(text=STANDING)
        page = self.page
        page.choose(".world select", "robot 0")
        pad = page.find(".pad")
        page.keys().move_to_element(pad).click_and_hold().move_by_offset(-60, 0).perform()
        rig.wait_until(lambda: page.pose()[2] > 20, "the robot turns left")
        page.keys().release().perform()
        self.assertEqual(page.js("return document.querySelector('.pad .knob').getAttribute('transform')"), "translate(0 0)")
        page.until("document.querySelector('.who').textContent === 'No driver.'", "no driver any more")

    def test_losing_the_focus_is_letting_go(self):
        self.open(text=STANDING)
        page = self.page
        self.hold("\ue013")
        page.until("document.querySelector('.who').textContent === 'You drive.'", "the page says who drives")
        page.js("window.dispatchEvent(new Event('blur'))")
        page.until("document.querySelector('.who').textContent === 'No driver.'", "no driver any more")
        self.release("\ue013")

    def test_nobody_drives_once_the_connection_is_lost(self):
        system = self.open(text=STANDING)
        self.hold("\ue013")
        self.page.until("document.querySelector('.who').textContent === 'You drive.'", "the page says who drives")
        system.process.kill()
        self.page.until("document.querySelector('.who').textContent === 'No driver.'", "no driver any more")
        self.release("\ue013")

    def test_a_gamepad_drives_while_its_stick_is_away_from_the_centre(self):
        self.open(text=STANDING)
        page = self.page
        page.choose(".world select", "robot 0")
        page.js("""
            document.hasFocus = () => true;
            window.stick = [0, -1];
            navigator.getGamepads = () => [{ connected: true, id: "a gamepad", axes: window.stick }];
            window.dispatchEvent(new Event("gamepadconnected"));""")
        rig.wait_until(lambda: page.pose()[0] > 0.1, "the robot drives forward")
        self.assertIn("In use: a gamepad", page.text(".driving"))
        page.js("window.stick = [0.05, 0.05]")
        page.until("document.querySelector('.who').textContent === 'No driver.'", "no driver any more")
        self.stands()

    def test_another_browser_sees_who_drives_and_takes_over_on_purpose(self):
        system = self.open(text=STANDING)
        page = self.page
        other = rig.Page()
        self.addCleanup(other.close)
        other.open(system.url)
        self.hold("\ue013")
        other.until("document.querySelector('.who').classList.contains('other')", "the other browser says who drives")
        self.assertRegex(other.text(".who"), r"^browser \d+ drives\.$")
        other.press("Take over")
        page.until("[...document.querySelectorAll('.notice')].some((each) => each.textContent.includes('another user drives this port'))",
                   "who drove is told")
        self.assertEqual(page.js("return document.querySelector('.pad .knob').getAttribute('transform')"), "translate(0 0)")
        self.release("\ue013")


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
