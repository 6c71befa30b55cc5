"""The diagram of a system on the page, in a real browser. Usage: diagram_test.py NEZUMI [TEST...]"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig
from rig import APART, WALL

LEADER = """network { name = "ev3", domain = 231 }
robot    "vehicle" { model = "ev3" }
behavior "driver"  { script = "robot_controller", config = { speed_x = 0.1, stop_d = 30000 } }
connect("driver.out", "vehicle.velocity2D")
"""
FOLLOWER = """network { name = "pi", domain = 231 }
robot "mouse" { model = "raspimouse" }
connect("late/driver.out", "mouse.target_velocity_in")
"""


CHAIN = """
robot    "mouse" { model = "raspimouse" }
behavior "first" { script = "robot_controller" }
behavior "second" { script = "robot_controller" }
robot    "other" { model = "raspimouse", pose = { x = 1 } }
connect("mouse.ir_sensor_out", "first.in")
connect("first.out", "mouse.target_velocity_in")
connect("mouse.ir_sensor_out", "second.in")
connect("second.out", "other.target_velocity_in")
"""


class OnAPhone(rig.PageCase):
    """The diagram on a narrow screen."""

    size = (390, 844)

    def shown(self):
        return sorted(self.page.js("return [...document.querySelectorAll('.node')].map((each) => each.dataset.component)"))

    def test_the_diagram_begins_at_one_component_and_leads_to_the_whole(self):
        self.open(text=CHAIN)
        page = self.page
        page.view("diagram")
        page.picture("diagram_phone")
        self.assertEqual(self.shown(), ["first", "mouse", "second"])
        height = page.js("return document.querySelector('.node .name').getBoundingClientRect().height")
        self.assertGreater(height, 9, "names can be read")
        page.choose(".diagram .tools select", "other")
        self.assertEqual(self.shown(), ["other", "second"])
        page.js("document.querySelector('.node[data-component=second] .title').focus()")
        page.keys().send_keys("\ue007").perform()
        self.assertEqual(self.shown(), ["mouse", "other", "second"])
        page.press("Whole system")
        self.assertEqual(self.shown(), ["first", "mouse", "other", "second"])
        page.picture("diagram_phone_whole")
        page.press("Neighbours only")
        self.assertEqual(self.shown(), ["mouse", "other", "second"])
        self.assertEqual(page.errors(), [])

    def test_the_robot_that_is_chosen_in_the_world_is_in_the_middle(self):
        self.open(text=CHAIN)
        self.page.choose_text(".world .tools select", "other")
        self.page.view("diagram")
        self.assertEqual(self.shown(), ["other", "second"])


class Wiring(rig.PageCase):
    """The diagram of the system."""

    def port(self, name):
        return self.page.find('.port[data-port="%s"] .reach' % name)

    def wires(self):
        return self.page.js("return [...document.querySelectorAll('.wire-group')].map((each) => each.dataset.from + ' ' + each.dataset.to)")

    def test_ports_are_connected_by_dragging_and_disconnected(self):
        self.open(text=APART)
        page = self.page
        page.view("diagram")
        self.assertEqual(self.wires(), [])
        keys = page.keys().move_to_element(self.port("controller.out")).click_and_hold()
        keys.move_by_offset(-40, 10).perform()
        self.assertEqual(page.js("return [...document.querySelectorAll('.port.fits')].map((each) => each.dataset.port)"),
                         ["mouse.target_velocity_in"])
        page.keys().move_to_element(self.port("mouse.target_velocity_in")).release().perform()
        rig.wait_until(lambda: self.wires() == ["controller.out mouse.target_velocity_in"], "the connection is drawn")
        page.view("world")
        page.choose(".world select", "robot 0")
        rig.wait_until(lambda: page.pose()[0] > 0.03, "the robot drives")
        page.view("diagram")
        page.js("document.querySelector('.wire-group').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
        page.press("Disconnect")
        rig.wait_until(lambda: self.wires() == [], "the connection is gone")

    def test_ports_are_connected_by_keys(self):
        self.open(text=APART)
        self.page.view("diagram")
        for port in ("mouse.ir_sensor_out", "controller.in"):
            self.page.js("document.querySelector(`[data-port='${arguments[0]}']`).focus()", port)
            self.page.keys().send_keys("\ue007").perform()
        rig.wait_until(lambda: self.wires() == ["mouse.ir_sensor_out controller.in"], "the connection is drawn")

    def test_a_new_behaviour_is_written_and_added_and_the_system_saved(self):
        system = self.open(text=APART.replace('script = "robot_controller", config = { speed_x = 0.1 }', 'script = "quiet"'),
                           scripts={"quiet": 'output("out", "TimedVelocity2D", "nothing")\n'})
        page = self.page
        page.view("diagram")
        page.press("Add…")
        page.find(".add-form input[aria-label='name']").send_keys("follower")
        page.press("+ in-port")
        page.find(".add-form fieldset .row input").send_keys("light")
        page.js("[...document.querySelectorAll('.add-form label')].find((each) => each.textContent === 'on_activated').click()")
        page.press("Add")
        page.until("document.querySelector('.node[data-component=follower]') !== null", "it is in the diagram")
        with open(os.path.join(system.folder, "behaviors", "follower.lua")) as file:
            self.assertRegex(file.read(), r'input\("light", "\w+", [^\n]*\)\n\nfunction on_activated\(\)')
        page.press("Add…")
        page.press("Add")
        page.until("document.querySelector('.add-form .error').textContent.length > 0", "it can't be there twice")
        page.press("Close")
        page.press("Save…")
        page.answer("Save", os.path.join(system.folder, "kept.lua"))
        rig.wait_until(lambda: os.path.exists(os.path.join(system.folder, "kept.lua")), "the system is saved")

    def test_a_component_is_deactivated_and_activated(self):
        self.open(WALL)
        page = self.page
        page.view("diagram")
        state = "document.querySelector('.node[data-component=controller]').classList.contains('%s')"
        page.find('.node[data-component="controller"] .title').click()
        page.until(state % "active", "it is active")
        page.js("[...document.querySelectorAll('.chosen button')].find((each) => each.textContent === 'Deactivate').click()")
        page.until(state % "inactive", "it is inactive")
        page.js("[...document.querySelectorAll('.chosen button')].find((each) => each.textContent === 'Activate').click()")
        page.until(state % "active", "it is active again")

    def test_hovering_shows_a_ports_value(self):
        self.open(text=APART)
        self.page.view("diagram")
        self.page.keys().move_to_element(self.port("controller.out")).perform()
        self.page.until("/vx = 0\\.1/.test(document.querySelector('.diagram .tip').textContent)",
                        lambda: "the value is shown, not " + self.page.text(".diagram .tip"))

    def test_other_hosts_are_seen_and_their_ports_connected(self):
        follower = self.open(text=FOLLOWER)
        page = self.page
        page.view("diagram")
        self.assertEqual(self.wires(), ["late/driver.out mouse.target_velocity_in"])
        self.assertIn("waits", page.find(".wire-group").get_attribute("class"))
        self.assertIn("waits", page.find('[data-component="late/driver"]').get_attribute("class"))
        self.assertIn("which waits", page.find(".wire-group").get_attribute("aria-label"))
        leader = self.system(text=LEADER, runtime=follower.folder)  # the secret of the same user
        page.until("document.querySelector('[data-component=\"ev3/vehicle\"]') !== null", "the other host's robot is shown")
        page.drawn()
        page.keys().move_to_element(self.port("ev3/vehicle.current_vel")).click_and_hold().move_by_offset(20, 10).perform()
        self.assertEqual(page.js("return [...document.querySelectorAll('.port.fits')].map((each) => each.dataset.port)"),
                         ["mouse.target_velocity_in"])
        page.keys().move_to_element(self.port("mouse.target_velocity_in")).release().perform()
        rig.wait_until(lambda: "ev3/vehicle.current_vel mouse.target_velocity_in" in self.wires(), "the connection is drawn")
        wire = '.wire-group[data-from="ev3/vehicle.current_vel"]'
        page.until("!document.querySelector('%s').classList.contains('waits')" % wire, "it waits for nobody")
        page.view("world")
        page.choose(".world select", "robot 0")
        rig.wait_until(lambda: page.pose()[0] > 0.03, "the robot follows")
        page.view("diagram")
        leader.end()
        page.until("document.querySelector('%s').classList.contains('waits')" % wire, "it waits for the host that has gone")
        page.until("document.querySelector('[data-component=\"ev3/driver\"]') === null", "what nobody waits for is shown no longer")
        self.assertEqual(page.errors(), [])

    def test_an_error_is_shown_where_it_happened(self):
        clumsy = 'local function half(of)\n  return error("oh no")\nend\nfunction on_execute()\n  half(7)\nend\n'
        self.open(text='behavior "clumsy" { script = "clumsy" }', scripts={"clumsy": clumsy})
        page = self.page
        page.view("diagram")
        page.until("document.querySelector('.node.error text.error')?.textContent.includes('clumsy.lua:2')", "the box says where")
        page.find(".node .title").click()
        self.assertIn("oh no", page.text(".chosen code.error"))
        self.assertRegex(page.text(".chosen .frames"), r"clumsy.lua:5")
        self.assertRegex(page.text(".chosen .frames"), r"of = 7")
        page.press("Explain")
        page.until("document.querySelector('.explain .when')?.textContent.startsWith('clumsy at 0.00 s')", "the execution that failed is explained")
        self.assertRegex(page.text(".explain .frames"), r"of = 7")
        page.view("diagram")
        for each in ("Reset", "Activate"):
            page.until("[...document.querySelectorAll('.chosen button')].find((each) => each.textContent === %r && !each.disabled)" % each,
                       "it can be told: " + each).click()
        page.view("log")
        page.until("document.querySelector('.log .entry.error')?.textContent.includes('oh no')", "the log has it, too")


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
