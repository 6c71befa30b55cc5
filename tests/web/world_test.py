"""What the world's picture shows, and what a hand does there, in a real browser. Usage: world_test.py NEZUMI [TEST...]"""

import os
import shutil
import socket
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig


class Shown(rig.PageCase):
    """The picture."""

    def test_the_picture_on_the_floor_is_drawn(self):
        self.open("behaviors/systems/line_follower.lua")
        self.page.until("document.querySelector('canvas').dataset.floor === 'shown'", "the floor's picture has come")
        self.assertEqual(self.page.errors(), [])

    def test_the_link_for_looking_lets_nobody_steer(self):
        system = self.open("behaviors/systems/stop_at_wall.lua")
        token = self.page.js("return new Promise((done) => { Object.defineProperty(navigator, 'clipboard',"
                             " { value: { writeText: async (text) => done(text) } });"
                             " document.querySelector('header .share').click(); })")
        self.assertNotIn(system.url.split("#")[1], token)
        other = rig.Page()
        self.addCleanup(other.close)
        other.open(token)
        other.until("document.body.classList.contains('view-only')", "it is told that it may look only")
        other.find("body").send_keys(" ")
        other.drawn()
        self.assertFalse(self.page.js("return document.body.classList.contains('stopped')"))


STANDING = """
arena { size = { 2, 2 }, box { at = { 0.5, 0, 0.05 }, size = { 0.2, 0.2, 0.1 } } }
robot "mouse" { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
"""


class Hands(rig.PageCase):
    """What stands in the arena, by hand."""

    def drag_box(self, by):
        """From where the box stands, seen from above: the arena of 2 m fills the picture's height."""
        self.page.press("Top")
        self.page.drawn()
        box = self.page.js("const b = document.querySelector('.world canvas').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]")
        start = self.page.js("return document.querySelector('canvas').dataset.chosen?.split(',').map(Number)")
        at = (box[0] + start[0], box[1] + start[1])
        keys = self.page.keys()
        keys.w3c_actions.pointer_action.move_to_location(round(at[0]), round(at[1]))
        keys.w3c_actions.pointer_action.pointer_down()
        for part in (0.3, 0.7, 1):
            keys.w3c_actions.pointer_action.move_to_location(round(at[0] + by[0] * part), round(at[1] + by[1] * part))
        keys.w3c_actions.pointer_action.pointer_up()
        keys.w3c_actions.perform()

    def test_a_box_is_dragged_elsewhere(self):
        self.open(text=STANDING)
        self.page.choose_text(".world select", "box 1")
        self.assertAlmostEqual(self.page.pose()[0], 0.5, delta=0.001)
        self.drag_box((0, 100))
        rig.wait_until(lambda: self.page.pose()[1] < -0.1, "the box is farther south")
        self.page.view("log")
        self.assertIn("move thing", self.page.text(".log .lines"))

    def test_a_box_is_moved_by_keys_and_no_farther_than_it_can_be(self):
        self.open(text=STANDING)
        self.page.choose_text(".world select", "box 1")
        canvas = self.page.find(".world canvas")
        canvas.send_keys("\ue012" * 3)  # to the left
        rig.wait_until(lambda: abs(self.page.pose()[0] - 0.44) < 0.005, "it is 6 cm nearer")
        for _ in range(20):
            canvas.send_keys("\ue012")
        self.page.until("document.querySelector('.notices')?.textContent.includes(\"overlaps robot 'mouse'\")", "it says why not")
        self.assertGreater(self.page.pose()[0], 0.14)

    def test_the_values_of_sensors_are_at_their_rays(self):
        self.open(text=STANDING)
        self.page.until("[...document.querySelectorAll('.labels .ray')].some((each) => / cm · \\d/.test(each.textContent))", "a value is shown")


    def test_the_points_where_a_robot_touches_a_wall_are_drawn(self):
        self.open(text=STANDING + """
            behavior "controller" { script = "pusher" }
            connect("controller.out", "mouse.target_velocity_in")""",
                  scripts={"pusher": """local out = output("out", "TimedVelocity2D")
                      function on_execute() out:write { vx = 0.2 } end"""})
        self.page.choose(".world select", "robot 0")
        self.page.until("Number(document.querySelector('canvas').dataset.contacts) > 0", "points are drawn")
        self.assertIn("touching box 1", self.page.text(".world .readout"))

    def test_what_a_hand_has_moved_is_saved_where_it_is(self):
        system = self.open(text=STANDING)
        self.page.choose_text(".world select", "box 1")
        self.page.find(".world canvas").send_keys("\ue014" * 2)  # to the right
        rig.wait_until(lambda: abs(self.page.pose()[0] - 0.54) < 0.005, "it is 4 cm farther")
        self.page.view("diagram")
        kept = os.path.join(system.folder, "kept.lua")
        self.page.press("Save…")
        self.page.answer("Save", kept)
        rig.wait_until(lambda: os.path.exists(kept), "the system is saved")
        with open(kept) as file:
            self.assertRegex(file.read(), r"box \{[^\n]*at = \{ 0\.54")


class Explain(rig.PageCase):
    """One execution, from the sensor to the wheels."""

    def test_of_what_is_in_error_the_execution_that_failed_is_explained(self):
        self.open(text=STANDING + """
            behavior "well" { script = "well" }
            behavior "clumsy" { script = "clumsy" }""",
                  scripts={"well": 'output("out", "TimedVelocity2D")\nfunction on_execute() end\n',
                           "clumsy": 'input("in", "TimedShortSeq")\nfunction on_execute()\n  error("oh no")\nend\n'})
        page = self.page
        page.view("explain")
        page.choose_text(".explain select", "well")
        page.until("document.querySelectorAll('.explain .step').length >= 3", "the one that is well is explained")
        page.choose_text(".explain select", "clumsy")
        page.until("document.querySelector('.explain .when')?.textContent.startsWith('clumsy at 0.00 s')", "the failed one is explained")
        self.assertIn('error("oh no")', page.text(".explain .lua"))
        self.assertIn("clumsy.lua:3: oh no", page.text(".explain .chain"))

    def test_where_time_stands_the_execution_before_it_is_explained_after_steps_and_seeks_too(self):
        self.open("behaviors/systems/stop_at_wall.lua")
        page = self.page
        page.view("explain")
        page.press("Pause")
        page.choose(".world select", "robot 0")
        tick = "Number(document.querySelector('.explain .when')?.textContent.split(' ').pop())"
        rig.wait_until(lambda: page.js("return %s" % tick) > 0, "an execution is shown")
        page.until("%s === Math.round(100 * Number(document.querySelector('.timeline input').value)) - 1" % tick, "it is the last one")
        before = page.js("return %s" % tick)
        page.press("Step")
        page.until("%s === %d" % (tick, before + 1), "it is that of the step")
        page.js("const slider = document.querySelector('.timeline input'); slider.value = 0.1; slider.dispatchEvent(new Event('input')); slider.dispatchEvent(new Event('change'));")
        page.until("%s === 9" % tick, "it is that of the past")
        self.assertEqual(page.errors(), [])

    def test_choosing_a_robot_explains_what_drives_it(self):
        self.open("behaviors/systems/stop_at_wall.lua")
        page = self.page
        page.view("explain")
        page.choose(".world select", "robot 0")
        page.until("document.querySelectorAll('.explain .step').length === 5", "the chain is shown")
        self.assertIn("mouse.ir_sensor_out", page.text(".explain .inputs"))
        self.assertIn("robot_controller.lua", page.text(".explain .lua .file"))
        self.assertIn("mouse.target_velocity_in", page.text(".explain .outputs"))
        self.assertIn("left", page.text(".explain .wheels"))
        before = page.text(".explain .when")
        page.press("Repeat")
        rig.wait_until(lambda: page.text(".explain .when") != before, "it looks again")
        self.assertEqual(page.errors(), [])


class Devices(rig.PageCase):
    """Lights, buttons, and names at the edge."""

    BLINKER = """local leds, tone = output("leds", "TimedBooleanSeq"), output("tone", "TimedShort")
local switches = input("switches", "TimedBooleanSeq")
function on_execute()
  local pressed = switches:read()
  leds:write { pressed[1] or false, pressed[2] or false, pressed[3] or false, true }
  tone:write(440)
end
"""
    TEXT = """robot "mouse" { model = "raspimouse" }
robot "other" { model = "raspimouse", pose = { x = 1.5 } }
behavior "blinker" { script = "blinker" }
connect("mouse.switch3bit_out", "blinker.switches")
connect("blinker.leds", "mouse.led4bit_in")
connect("blinker.tone", "mouse.buzzer_hz_in")
"""

    def test_lights_are_shown_and_buttons_are_pressed(self):
        from selenium.webdriver.common.action_chains import ActionChains

        self.open(text=self.TEXT, scripts={"blinker": self.BLINKER})
        page = self.page
        page.choose(".world .tools select", "robot 0")
        page.until("document.querySelectorAll('.devices .led').length === 4", "four lights are there")
        lights = "[...document.querySelectorAll('.devices .led')].map((each) => each.classList.contains('on')).join()"
        page.until(lights + " === 'false,false,false,true'", "they are as written")
        page.until("document.querySelector('.devices').textContent.includes('440 Hz')", "the tone is shown")
        button = page.find(".devices button:nth-child(2)")
        ActionChains(page.driver).click_and_hold(button).perform()
        page.until(lights + " === 'false,true,false,true'", "the button is pressed")
        ActionChains(page.driver).release().perform()
        page.until(lights + " === 'false,false,false,true'", "it is released")
        self.assertEqual(page.errors(), [])

    PAINTER = """local lcd, leds = output("lcd", "CameraImage"), output("leds", "TimedBooleanSeq")
local touch = input("touch", "TimedBooleanSeq")
function on_execute()
  local pressed = touch:read()
  leds:write { pressed[1] or false, false, pressed[2] or false, true }
  lcd:write { width = 2, height = 1, bpp = 8, format = "gray8", pixels = pressed[1] and "\\255\\255" or "\\0\\255" }
end
"""
    BRICK = """robot "ev3" { model = "ev3" }
behavior "painter" { script = "painter" }
connect("ev3.touch", "painter.touch")
connect("painter.leds", "ev3.leds")
connect("painter.lcd", "ev3.lcd")
"""
    SHADE = """(() => { const image = document.querySelector('.devices .screen');
      if (!image.naturalWidth) return '';
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [2, 1];
      canvas.getContext('2d').drawImage(image, 0, 0);
      return [...canvas.getContext('2d').getImageData(0, 0, 2, 1).data].filter((_, i) => i % 4 === 0).map((each) => (each > 128 ? 'white' : 'black')).join(); })()"""

    def test_the_screen_of_an_ev3_is_shown_and_its_keys_are_pressed(self):
        from selenium.webdriver.common.action_chains import ActionChains

        self.open(text=self.BRICK, scripts={"painter": self.PAINTER})
        page = self.page
        page.until(self.SHADE + " === 'black,white'", "the screen shows the picture")
        page.until("document.querySelectorAll('.devices .led').length === 4", "four lights are there")
        names = [each.text for each in page.all(".devices button")]
        self.assertEqual(sorted(names), ["key_back", "key_down", "key_enter", "key_left", "key_right", "key_up", "left", "right"])
        page.picture("ev3_devices")
        ActionChains(page.driver).click_and_hold(page.all(".devices button")[names.index("right")]).perform()
        page.until(self.SHADE + " === 'white,white'", "it shows another one while the sensor is pressed")
        page.until("document.querySelector('.devices .led').classList.contains('on')", "the light is on")
        ActionChains(page.driver).release().perform()
        self.assertEqual(page.errors(), [])

    def test_the_battery_of_a_real_ev3_is_shown_and_red_while_it_is_too_low(self):
        fake = os.path.join(os.path.dirname(self.nezumi), "fake_ev3")
        if not os.access("/dev/fuse", os.W_OK) or not os.path.exists(fake):
            self.skipTest("there is no FUSE here, or no fake_ev3")
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        nodes, door = os.path.join(folder, "nodes"), os.path.join(folder, "socket")
        os.mkdir(nodes)
        brick = subprocess.Popen([fake, nodes, door, os.path.join(rig.ROOT, "engine/robots/ev3.lua")], stdout=subprocess.PIPE)
        self.addCleanup(lambda: (brick.terminate(), brick.wait(), brick.stdout.close()))
        brick.stdout.read(1)
        talk = socket.socket(socket.AF_UNIX)
        self.addCleanup(talk.close)
        talk.connect(door)
        self.open(text='robot "ev3" { model = "ev3" }\n', options=["--hw", "--dev-root", nodes + "/dev", "--sys-root", nodes + "/sys"])
        page = self.page
        shown = "document.querySelector('.devices .battery')"
        page.until(shown + "?.textContent === 'Battery 7.9 V'", "its voltage is shown")
        self.assertFalse(page.js("return %s.classList.contains('low')" % shown))
        plain = page.js("return getComputedStyle(%s).color" % shown)
        talk.sendall(b"battery 6100000\n")
        page.until(shown + ".textContent === 'Battery 6.1 V: too low, the robot stands'", "it is too low")
        self.assertNotEqual(page.js("return getComputedStyle(%s).color" % shown), plain)
        page.picture("ev3_battery")
        talk.sendall(b"battery 7900000\n")
        page.until(shown + ".textContent === 'Battery 7.9 V'", "it is charged")
        self.assertEqual(page.js("return getComputedStyle(%s).color" % shown), plain)
        self.open(text='robot "ev3" { model = "ev3" }\n')
        page.until("!document.querySelector('.devices').hidden", "its devices are there")
        self.assertIsNone(page.js("return " + shown))
        self.assertEqual(page.errors(), [])

    def test_robots_have_the_colours_of_their_trails(self):
        self.open(text="".join('robot "m%d" { model = "raspimouse", pose = { y = %g } }\n' % (i, i * 0.2) for i in range(3)))
        page = self.page
        for each in ("Rays", "Trails", "Names", "Top"):
            page.press(each)
        page.drawn()
        count = page.driver.execute_async_script("""const [picture, done] = arguments;
            const image = new Image();
            image.onload = () => {
              const canvas = document.createElement('canvas');
              [canvas.width, canvas.height] = [image.width, image.height];
              const pen = canvas.getContext('2d');
              pen.drawImage(image, 0, 0);
              const box = document.querySelector('.world canvas').getBoundingClientRect();
              const { data } = pen.getImageData(box.left, box.top, box.width, box.height);
              let green = 0;
              for (let i = 0; i < data.length; i += 4) if (data[i + 1] > 60 && data[i + 1] > 1.6 * data[i] && data[i + 1] > 1.6 * data[i + 2]) ++green;
              done(green);
            };
            image.src = 'data:image/png;base64,' + picture;""", page.driver.get_screenshot_as_base64())
        self.assertGreater(count, 30, "the third robot is green")
        page.picture("robots_colours")

    def test_a_robot_out_of_sight_has_its_name_at_the_edge(self):
        self.open(text=self.TEXT, scripts={"blinker": self.BLINKER})
        page = self.page
        self.assertEqual(page.all(".labels .name.far"), [])
        page.choose(".world .tools select", "robot 0")
        for _ in range(10):
            page.find(".world canvas").send_keys("+")
        page.until("[...document.querySelectorAll('.labels .name.far:not([hidden])')].some((each) => /^[←→↑↓] other$/.test(each.textContent))", "its name is at the edge")


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
