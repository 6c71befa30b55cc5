"""The browser's page of a running system, in a real browser. Usage: page_test.py NEZUMI [TEST...]"""

import csv
import io
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig
from rig import APART, WALL


class Smoke(rig.PageCase):
    """What must work before anything else."""

    def test_a_person_sees_the_robot_drive_stops_it_by_the_space_bar_and_lets_it_go_on(self):
        # However slow the machine is, no wall stops it first.
        self.open(text=APART + 'connect("controller.out", "mouse.target_velocity_in")\n')
        page = self.page
        self.assertEqual(page.text("h1"), "tried")
        page.choose(".world select", "robot 0")
        before = page.pose()[0]
        rig.wait_until(lambda: page.pose()[0] > before + 0.02, "the robot drives")
        page.find("body").send_keys(" ")
        page.until("document.body.classList.contains('stopped')", "the page says that it is stopped")
        self.stands()
        stopped_at = page.pose()[0]
        page.press("Re-arm")
        rig.wait_until(lambda: page.pose()[0] > stopped_at + 0.02, "the robot drives on")
        self.assertEqual(page.errors(), [])

    def test_messages_of_the_engine_are_read_as_they_were_written(self):
        self.open(WALL)
        self.check_modules("modules_test.js", 20)

    def test_each_text_is_there_in_both_languages_and_only_there(self):
        self.open(WALL)
        self.check_modules("texts_test.js", 250)


class Japanese(rig.PageCase):
    """Who reads Japanese sees the page in Japanese."""

    language = "ja,en"

    def test_the_language_is_that_of_the_browser_until_another_one_is_chosen(self):
        self.open(WALL)
        page = self.page
        self.assertEqual(page.js("return document.documentElement.lang"), "ja")
        self.assertEqual(page.text(".stop"), "■停止")
        self.assertEqual([each.text for each in page.all(".stage > .tabs .tab")], ["ワールド", "システム", "グラフ", "エディタ"])
        self.assertEqual(page.js("return document.querySelector('.world canvas').getAttribute('aria-label')")[:9], "上から見たワールド")
        page.press("English")
        page.until("document.querySelector('.dot.open') && document.querySelector('.stop')?.textContent === '■Stop'", "it is in English")
        page.driver.refresh()
        page.ready()
        self.assertEqual(page.text(".stop"), "■Stop")
        self.assertEqual(page.js("return document.documentElement.lang"), "en")
        page.press("日本語")
        page.until("document.querySelector('.dot.open') && document.querySelector('.stop')?.textContent === '■停止'", "it is in Japanese again")
        self.assertEqual(page.errors(), [])

    def test_no_view_shows_an_english_word_that_is_not_a_name(self):
        self.open(WALL)
        page = self.page
        names = {"nezumi", "Lua", "CSV", "SVG", "English", "Enter", "Esc", "Shift", "Tab", "Page", "Down", "wall", "stop", "run", "record", "journal", "mcap"}
        for view in ("world", "diagram", "plots", "scenarios", "drive", "parameters", "cameras", "explain", "console"):
            page.view(view)
            shown = page.js("""return [...document.querySelectorAll('body > header button, body > header [title]:not(h1), .tab, .tools button, .view:not([hidden]) > .hint, .view:not([hidden]) .empty')]
              .filter((each) => each.offsetParent && !each.querySelector('input, select'))
              .map((each) => each.textContent + ' ' + each.title + ' ' + (each.getAttribute('aria-label') ?? ''))""")
            words = {word for text in shown for word in re.findall(r"[A-Za-z]{3,}", text)}
            self.assertLessEqual(words, names, view)


class Words(rig.PageCase):
    """Parameters, console, log, plots."""

    def field(self):
        return self.page.find("input.number[aria-label='controller.speed_x']")

    def test_a_parameter_is_set_within_its_bounds_marked_and_put_back(self):
        self.open(WALL)
        page = self.page
        page.view("parameters")
        field = self.field()
        field.clear()
        field.send_keys("0.25\n")
        page.until("document.querySelector('.parameter.changed .name')?.textContent === 'speed_x'", "it is marked")
        self.assertEqual(self.said("controller.config.speed_x"), "0.25")
        page.view("parameters")
        field.clear()
        field.send_keys("9\n")
        self.assertEqual(field.get_attribute("aria-invalid"), "true")
        self.assertEqual(self.said("controller.config.speed_x"), "0.25")
        page.js("document.querySelector('.parameter .back').click()")
        rig.wait_until(lambda: self.said("controller.config.speed_x") == "0.1", "it is put back to what the file says")
        page.view("parameters")
        page.until("document.querySelector('.parameter.changed') === null", "nothing is marked any more")

    def test_a_slider_moves_by_its_step(self):
        self.open(WALL)
        self.page.view("parameters")
        self.page.find("input[type=range][aria-label='controller.speed_x']").send_keys("\ue014")
        rig.wait_until(lambda: self.said("controller.config.speed_x") == "0.11", "it is one step more")

    def said(self, line):
        """What the console answers."""
        page = self.page
        page.view("console")
        page.press("Clear")
        page.find(".console textarea").send_keys(line + "\n")
        return rig.wait_until(lambda: page.text(".console .output pre:not(.asked, .hint)"), "'%s' is answered" % line)

    def test_the_console_completes_recalls_and_explains(self):
        self.open(WALL)
        page = self.page
        self.assertEqual(self.said("1 + 1"), "2")
        self.assertIn("unknown name 'nobody'", self.said("nobody"))
        line = page.find(".console textarea")
        line.send_keys("contr\t")
        page.until("document.querySelector('.console textarea').value === 'controller'", "the name is completed")
        line.send_keys("\ue003" * 10 + "\ue013")
        page.until("document.querySelector('.console textarea').value === 'nobody'", "the last line is recalled")
        line.send_keys("\ue003" * 6 + "for i = 1, 2 do\nprint(i)\nend\n")
        page.until("document.querySelector('.console .output').textContent.includes('end')", "several lines are one input")

    def test_the_log_is_searched_and_filtered(self):
        careful = 'input("in", "TimedShortSeq")\nfunction on_activated()\n  log.warn("mind the wall")\nend\n'
        self.open(text='behavior "careful" { script = "careful", active = false }', scripts={"careful": careful})
        page = self.page
        page.view("console")
        page.find(".console textarea").send_keys("careful:activate()\n")
        page.view("log")
        page.until("document.querySelector('.log .lines').textContent.includes('mind the wall')", "the line is there")
        page.choose(".log select", "warn")
        self.assertEqual([each.text.split()[-1] for each in page.all(".log .entry:not([hidden])")], ["wall"])
        page.find(".log input").send_keys("nothing like this")
        self.assertEqual(page.all(".log .entry:not([hidden])"), [])

    def test_fields_are_plotted_paused_and_saved(self):
        self.open(text=APART + 'connect("controller.out", "mouse.target_velocity_in")\n')  # no wall stops it first
        page = self.page
        page.view("plots")
        page.plot("controller.out", "vx", "va")
        page.until("document.querySelectorAll('.plots canvas').length > 0", "it is drawn")
        time.sleep(1)
        page.js("URL.createObjectURL = (blob) => (blob.text().then((text) => { window.saved = text; }), 'about:blank');"
                "HTMLAnchorElement.prototype.click = () => {};")
        page.press("CSV")
        saved = page.until("window.saved", "it is saved")
        rows = list(csv.reader(io.StringIO(saved)))
        self.assertEqual(rows[0], ["time", "controller.out.vx", "controller.out.va"])
        self.assertGreater(len(rows), 10)
        self.assertIn("0.1", [row[1] for row in rows])
        page.js("window.saved = ''")
        page.press("SVG")
        self.assertTrue(page.until("window.saved", "the drawing is saved").startswith("<svg"))
        self.assertEqual(page.errors(), [])


    def test_a_port_is_found_by_parts_of_its_name(self):
        self.open(WALL)
        page = self.page
        page.view("plots")
        page.find(".plots input[type=search]").send_keys("mouse vel")
        page.until("document.querySelector('.tree [data-key^=\"mouse.current_velocity_out\"]') !== null", "such ports are offered")
        self.assertEqual([each for each in page.offered() if each not in ("mouse", "mouse.truth") and not re.match(r"mouse\..*vel", each)], [])
        page.find(".plots input[type=search]").send_keys("\b" * 9)
        page.until("document.querySelector('.tree [data-key=\"controller\"]') !== null", "all are offered again")


    def test_ports_with_data_are_offered_first(self):
        self.open(text=APART)
        page = self.page
        page.view("plots")
        page.unfold("mouse", "mouse.ir_sensor_out")
        page.until("document.querySelector('.tree [data-key=\"mouse.ir_sensor_out [1]\"]') !== null", "its numbers are there")
        offered = page.offered()
        self.assertEqual([each.split(" ")[1] for each in offered if each.startswith("mouse.ir_sensor_out ")], ["[1]", "[2]", "[3]", "[4]"])
        self.assertIn("no data yet", offered["mouse.target_velocity_in"])
        self.assertNotIn("no data yet", offered["mouse.ir_sensor_out"])
        page.plot("mouse.target_velocity_in", "vx")  # may come later
        self.assertLess(list(offered).index("mouse.ir_sensor_out"), list(offered).index("mouse.target_velocity_in"))

    def test_the_tree_of_values_is_used_by_keys(self):
        self.open(WALL)
        page = self.page
        page.view("plots")
        page.unfold("mouse")
        page.js("document.querySelector('.tree .row[tabindex=\"0\"]').focus()")
        keys = page.keys()
        for _ in range(30):
            at = page.js("return document.activeElement.dataset.key")
            if at == "mouse.ir_sensor_out":
                break
            keys.send_keys("\ue015").perform()  # down
            keys.reset_actions()
        keys.send_keys("\ue014\ue014\ue015\ue007").perform()  # open, in, down, Enter
        page.until("document.querySelector('.legend').textContent.includes('mouse.ir_sensor_out[2]')", "it is plotted")
        keys.reset_actions()
        keys.send_keys("\ue007").perform()
        page.until("document.querySelector('.legend').textContent === ''", "it is plotted no longer")

    def test_what_was_before_a_value_was_chosen_is_drawn_at_once(self):
        self.open(text=APART + 'connect("controller.out", "mouse.target_velocity_in")\n')
        page = self.page
        page.until("parseFloat(document.querySelector('.clock').textContent) > 4", "time has passed")
        page.press("Pause")
        page.view("plots")
        page.plot("mouse.truth", "pose.position.x")
        page.plot("mouse.ir_sensor_out", "[2]")
        page.plot("controller.out", "vx")
        page.until("document.querySelectorAll('.plots canvas').length > 0", "it is drawn, although time stands")
        page.picture("plot_history")
        page.js("URL.createObjectURL = (blob) => (blob.text().then((text) => { window.saved = text; }), 'about:blank');"
                "HTMLAnchorElement.prototype.click = () => {};")
        page.press("CSV")
        rows = list(csv.DictReader(io.StringIO(page.until("window.saved", "it is saved"))))
        for name in ("mouse.truth.pose.position.x", "mouse.ir_sensor_out[2]", "controller.out.vx"):
            of_it = [(float(row["time"]), float(row[name])) for row in rows if row[name]]
            self.assertLess(of_it[0][0], 0.5, name)
            self.assertGreater(len(of_it), 40, name)
        places = [float(row["mouse.truth.pose.position.x"]) for row in rows if row["mouse.truth.pose.position.x"]]
        self.assertLess(places[0], 0.05)
        self.assertGreater(places[-1], 0.3)
        page.plot("mouse.truth", "velocity.vx")  # which nobody had asked for, so that it is not remembered
        page.press("From the start")
        page.js("window.rows = () => { [...document.querySelectorAll('.plots button')].find((each) => each.textContent === 'CSV').click();"
                "return window.saved.trim().split('\\n').slice(1).filter((row) => !row.endsWith(',')); };")
        page.until("window.rows().length > 40", "its values since the start are there")
        page.until("parseFloat(window.rows()[0]) < 0.5", "also those of the first ticks")
        self.assertEqual(page.errors(), [])


class Messages(rig.PageCase):
    """Types that files define."""

    def test_values_of_a_type_that_a_file_defines_are_shown_and_plotted(self):
        obstacle = """return message "Obstacle" {
  { "distance", "double", unit = "m" },
  { "colour", { "red", "green", "blue" } },
  { "corners", "Point2D[]" },
  { "box", "double[3]" },
  { "big", "longlong" },
}"""
        seer = """local seen = output("seen", "Obstacle", "")
function on_execute()
  seen:write { distance = now(), colour = "green", corners = { { x = 1, y = 2 } }, box = { 4, 5, 6 }, big = (1 << 60) + 1 }
end"""
        self.open(text='behavior "seer" { script = "seer" }', scripts={"seer": seer, "messages/obstacle": obstacle})
        page = self.page
        page.view("plots")
        page.plot("seer.seen", "distance")
        offered = page.offered()
        for field in ("corners[1].y", "box[3]"):
            self.assertIn("seer.seen " + field, offered)
        page.until("document.querySelectorAll('.plots canvas').length > 0", "it is drawn")
        page.view("diagram")
        page.js("document.querySelector('[data-port=\"seer.seen\"]').dispatchEvent(new MouseEvent('pointerenter', { bubbles: true }));"
                "document.querySelector('[data-port=\"seer.seen\"]').focus()")
        page.until("document.querySelector('#view-diagram').textContent.includes('green')", "the value is shown")
        self.assertIn("1152921504606846977", page.text("#view-diagram"))
        self.assertEqual(page.errors(), [])


class Listening(rig.PageCase):
    """The page by TLS, as other computers get it."""

    def test_a_browser_that_was_warned_of_the_certificate_and_goes_on_sees_and_steers(self):
        system = self.system(WALL, options=("--listen", "127.0.0.1"))
        self.assertTrue(system.url.startswith("https://"))
        self.addCleanup(self.page.driver.get, "about:blank")
        page = self.page
        page.driver.get(system.url)
        self.assertIn("ERR_CERT_AUTHORITY_INVALID", page.text("body"))
        page.find("#details-button").click()
        page.find("#proceed-link").click()
        page.ready()
        page.find("body").send_keys(" ")
        page.until("document.body.classList.contains('stopped')", "the page says that it is stopped")


class Systems(rig.PageCase):
    """Several systems on a machine."""

    def test_the_systems_of_the_machine_are_listed_and_lead_to_their_pages(self):
        first = self.open(WALL)
        second = self.system("behaviors/systems/line_follower.lua", runtime=first.folder)
        self.page.find(".systems summary").click()
        self.page.until("document.querySelectorAll('.systems a').length === 1", "the other is listed")
        self.assertEqual(self.page.text(".systems a"), "line_follower")
        self.assertEqual(self.page.js("return document.querySelector('.systems a').href"), second.url)
        self.assertEqual(self.page.text(".systems b"), "stop_at_wall")


class Members(rig.PageCase):
    """Numbers that no port carries."""

    def test_a_robots_truth_is_plotted(self):
        self.open(WALL)
        page = self.page
        page.view("plots")
        page.plot("mouse.truth", "pose.position.x")
        page.until("document.querySelectorAll('.plots canvas').length > 0", "it is drawn")
        self.assertIn("mouse.truth.pose.position.x", page.text(".legend"))
        self.assertEqual(page.errors(), [])


class Cameras(rig.PageCase):
    """What cameras see."""

    def test_pictures_of_a_camera_are_shown_while_they_are_looked_at(self):
        self.open("behaviors/systems/follow_marker.lua")
        page = self.page
        page.view("cameras")
        page.until("document.querySelector('.pictures img')?.naturalWidth === 640", "a picture is shown")
        caption = page.text(".pictures figcaption")
        self.assertRegex(caption, r"eye\.out640 × 480")
        page.until("document.querySelector('.pictures figcaption').textContent !== %r" % caption, "another one follows")


class Past(rig.PageCase):
    """Going back by the time line."""

    def go_to(self, seconds):
        self.page.js("const slider = document.querySelector('.timeline input'); slider.value = %r;"
                     "slider.dispatchEvent(new Event('input')); slider.dispatchEvent(new Event('change'))" % seconds)

    def test_the_slider_goes_back_and_a_change_there_begins_a_branch(self):
        self.open(WALL)
        page = self.page
        clock = "parseFloat(document.querySelector('.clock').textContent)"
        page.until(clock + " > 1.5", "some time has passed")
        self.go_to(0.5)
        page.until("!document.querySelector('.timeline .is-past').hidden", "the page says that this is a past")
        page.until(clock + " === 0.5", "the clock shows the past")
        self.assertTrue(page.js("return document.querySelector('.timeline select').hidden"))
        page.find(".timeline button").click()
        page.until("document.querySelector('.timeline .is-past').hidden", "the end of the branch is there")
        page.until(clock + " > 1.5", "the clock shows the end")
        end = page.js("return " + clock)
        self.go_to(0.5)
        page.until("!document.querySelector('.timeline .is-past').hidden", "the page says that this is a past")
        page.view("parameters")
        number = page.find("input.number[aria-label='controller.speed_x']")
        number.clear()
        number.send_keys("0.2\n")
        page.until("!document.querySelector('.timeline select').hidden", "there are two branches")
        self.assertEqual(page.js("return document.querySelector('.timeline select').value"), "branch 1")
        page.until(clock + " === 0.5", "the clock shows the branch")
        page.js("const select = document.querySelector('.timeline select'); select.value = 'main';"
                "select.dispatchEvent(new Event('change'))")
        page.until(clock + " === %r" % end, "the end of main is there")

    def test_while_the_slider_is_moved_the_log_is_that_of_then(self):
        self.open(text="""
robot "mouse" { model = "raspimouse" }
behavior "teller" { script = "teller" }
""", scripts={"teller": "task('tell', function() log.info('early') wait(1) log.info('late') end)\n"})
        page = self.page
        page.view("log")
        page.until("document.querySelector('.log .lines').textContent.includes('late')", "both lines are there")
        slide = ("const slider = document.querySelector('.timeline input'); slider.dispatchEvent(new Event('pointerdown'));"
                 "slider.value = 0.5; slider.dispatchEvent(new Event('input'))")
        pale = "[...document.querySelectorAll('.entry.later .text')].map((each) => each.textContent).join()"
        page.js(slide)  # what is remembered comes after this
        # The browser's own line may stand before or after it.
        rig.wait_until(lambda: "late" in page.js(slide + "; return " + pale), "what came later is pale")
        self.assertNotIn("early", page.js("return " + pale))
        page.js("const slider = document.querySelector('.timeline input'); slider.dispatchEvent(new Event('change'))")
        page.until(pale + " === ''", "the system is there: nothing is pale")

    def test_what_happened_is_marked_and_the_other_branch_is_drawn_pale(self):
        self.open(WALL)
        page = self.page
        page.view("parameters")
        clock = "parseFloat(document.querySelector('.clock').textContent)"
        page.until(clock + " > 1", "some time has passed")
        number = page.find("input.number[aria-label='controller.speed_x']")
        number.clear()
        number.send_keys("0.15\n")
        page.until("document.querySelector('.mark.act')", "the change is marked")
        self.assertIn("set parameter by browser", page.js("return document.querySelector('.mark.act').title"))
        page.until(clock + " > 3", "some time has passed")
        self.go_to(0.5)
        page.until("document.querySelector('.stage-box canvas').dataset.ways === 'true'", "what follows is drawn")
        self.assertEqual(page.js("return document.querySelector('.stage-box canvas').dataset.ghosts"), "0")
        number = page.find("input.number[aria-label='controller.speed_x']")
        number.clear()
        number.send_keys("0.05\n")
        page.until("document.querySelector('.stage-box canvas').dataset.ghosts === '1'", "the robot of main is drawn pale")
        # By the keyboard: to the mark before, which the branch has too.
        slider = "document.querySelector('.timeline input')"
        page.until("document.querySelector('.mark')", "the branch has marks")
        page.js(slider + ".focus(); " + slider + ".value = " + slider + ".max;" + slider +
                ".dispatchEvent(new KeyboardEvent('keydown', { key: 'PageDown' }))")
        page.until(clock + " === 0.5", "the mark is gone to")

    def test_while_the_slider_is_dragged_the_remembered_places_are_shown(self):
        self.open(WALL)
        page = self.page
        clock = "parseFloat(document.querySelector('.clock').textContent)"
        page.until(clock + " > 2", "some time has passed")
        page.view("world")
        page.js("const select = document.querySelector('select[aria-label=Select]'); select.value = 'robot 0';"
                "select.dispatchEvent(new Event('change'))")
        x = "parseFloat(document.querySelector('.readout').textContent.split(' ')[1])"
        page.until(x + " > 0.1", "the robot has moved")
        drag = ("const slider = document.querySelector('.timeline input');"
                "slider.dispatchEvent(new PointerEvent('pointerdown')); slider.value = 0.2; slider.dispatchEvent(new Event('input'))")
        page.js(drag)
        page.until(x + " < 0.1", "the robot is where it was")
        before = page.js("return " + clock)
        page.until(clock + " > %r" % (before + 0.3), "time passes: nothing was computed")
        page.until(x + " < 0.1", "the robot is where it was")
        page.js("const slider = document.querySelector('.timeline input'); slider.dispatchEvent(new Event('change'))")
        page.until(clock + " === 0.2", "the past is gone to when the slider is let go")

    def test_while_the_slider_is_dragged_a_ports_value_is_that_of_then(self):
        self.open(text='robot "mouse" { model = "raspimouse" }\nbehavior "teller" { script = "teller" }',
                  scripts={"teller": 'local out = output("out", "TimedVelocity2D")\nfunction on_execute() out:write { vx = now() } end\n'})
        page = self.page
        page.view("diagram")
        page.until("parseFloat(document.querySelector('.clock').textContent) > 1.5", "some time has passed")
        page.js("document.querySelector('[data-port=\"teller.out\"]').dispatchEvent(new PointerEvent('pointerenter'))")
        tip = "document.querySelector('.diagram .tip').textContent"
        page.until("/vx = [1-9]/.test(%s)" % tip, "the present value is shown")
        page.js("const slider = document.querySelector('.timeline input'); slider.dispatchEvent(new PointerEvent('pointerdown'));"
                "slider.value = 0.5; slider.dispatchEvent(new Event('input'))")
        page.until("/vx = 0.49/.test(%s)" % tip, lambda: "the value of then is shown, not " + page.text(".diagram .tip"))
        page.js("document.querySelector('.timeline input').dispatchEvent(new Event('change'))")
        page.until("parseFloat(document.querySelector('.clock').textContent) === 0.5", "the past is gone to")
        page.until("/vx = 0.49/.test(%s)" % tip, "it has the same value")

    def test_a_failed_scenario_shows_its_conditions_as_rows_that_lead_to_their_times(self):
        with tempfile.TemporaryDirectory() as folder:
            scenario = os.path.join(folder, "it_test.lua")
            with open(scenario, "w") as out:
                out.write(FAILS)
            subprocess.run([self.nezumi, "test", scenario, "--output", folder], cwd=rig.ROOT, capture_output=True)
            self.open(os.path.join(folder, "it_test-it"), command="open")
            page = self.page
            page.until("document.querySelectorAll('.conditions li').length === 2", "both conditions have a row")
            self.assertIn("never 'touches'", page.text(".conditions li:first-child"))
            self.assertEqual(page.js("return document.querySelectorAll('.conditions .failed').length"), 1)
            clock = "parseFloat(document.querySelector('.clock').textContent)"
            time = page.js("return document.querySelector('.conditions .failed').textContent.match(/at ([0-9.]+) s/)[1]")
            page.find(".conditions .failed button").click()
            page.until(clock + " === " + time, "the row leads there")


FAILS = """
scenario("it", function(s)
  s:load "systems/stop_at_wall.lua"
  s:never("touches", function() return s.mouse.collided end)
  s:always("is slow", function() return s.mouse.truth.velocity.vx < 0.05 end)
  s:run(3)
end)
"""


class Troubles(rig.PageCase):
    """What goes wrong is seen from every view."""

    SCRIPT = 'local out = output("out", "TimedVelocity2D")\nparam("fails", false)\nfunction on_execute()\n' \
             '  if config.fails then error("no way") end\n  out:write { vx = 0 }\nend\n'
    SYSTEM = 'robot "mouse" { model = "raspimouse" }\nbehavior "guide" { script = "guide" }\nconnect("guide.out", "mouse.target_velocity_in")\n'

    def test_an_error_is_in_the_bar_at_the_tabs_in_a_notice_and_at_its_robot(self):
        self.open(text=self.SYSTEM, scripts={"guide": self.SCRIPT})
        page = self.page
        page.view("world")
        self.assertFalse(page.find("button.troubles").is_displayed())
        time.sleep(1.1)  # lines of the log in the first second make no notices
        page.find(".console textarea").send_keys("guide.config.fails = true\n")
        page.until("document.querySelector('button.troubles').offsetParent !== null", "the bar counts it")
        self.assertEqual(page.find("button.troubles").text, "1 error")
        self.assertIn("guide.lua:4", page.find("button.troubles").get_attribute("title"))
        page.until("[...document.querySelectorAll('.notice.error')].some((each) => each.textContent.includes('guide.lua:4'))", "a notice")
        for tab in ("diagram", "log"):
            self.assertEqual(page.js("return document.querySelector(`.group .tab[data-view=${arguments[0]}] .badge`).textContent", tab), "1")
        page.until("[...document.querySelectorAll('.labels .name.bad')].some((each) => each.textContent === 'mouse !')", "the robot has a sign")
        page.find("button.troubles").click()
        page.until("document.querySelector('#view-log').offsetParent !== null", "the log is shown")
        self.assertIsNone(page.js("return document.querySelector('.group .tab[data-view=log] .badge')"))

    def test_a_version_that_runs_is_said(self):
        system = self.open(text=self.SYSTEM, scripts={"guide": self.SCRIPT})
        with open(os.path.join(system.folder, "behaviors", "guide.lua"), "a") as out:
            out.write("-- the same\n")
        self.page.until("[...document.querySelectorAll('.notice.good')].some((each) => each.textContent.includes('Version 2 runs: guide.'))",
                        "the new version is said")


class Space(rig.PageCase):
    def test_the_console_has_one_line_until_it_is_used_and_borders_are_dragged(self):
        from selenium.webdriver.common.action_chains import ActionChains

        self.open(WALL)
        page = self.page
        height = "return document.querySelector('.group.dock').offsetHeight"
        small = page.js(height)
        self.assertLess(small, 120)
        page.find(".console textarea").click()
        page.until("document.querySelector('.group.dock').offsetHeight > 150", "it grows when it is used")
        used = page.js(height)
        border = page.find(".split.dock")
        ActionChains(page.driver).drag_and_drop_by_offset(border, 0, -100).perform()
        self.assertAlmostEqual(page.js(height), used + 100, delta=12)
        border.send_keys("\ue015")
        self.assertAlmostEqual(page.js(height), used + 76, delta=12)
        ActionChains(page.driver).double_click(border).perform()
        self.assertAlmostEqual(page.js(height), used, delta=2)

    def test_the_picture_keeps_its_size_when_the_pointer_is_over_a_robot(self):
        from selenium.webdriver.common.action_chains import ActionChains

        self.open(text=APART)  # its robot stands
        page = self.page
        size = "const box = document.querySelector('.world canvas').getBoundingClientRect(); return [box.width, box.height]"
        before = page.js(size)
        page.choose(".world select", "robot 0")
        pixel = page.until("document.querySelector('.world canvas').dataset.chosen", "the robot is chosen")
        x, y = (float(each) for each in pixel.split(","))
        canvas = page.find(".world canvas")
        ActionChains(page.driver).move_to_element_with_offset(canvas, x - before[0] / 2, y - before[1] / 2).perform()
        page.until("document.querySelector('.world canvas.pointing') !== null", "the pointer is over the robot")
        self.assertEqual(page.js(size), before)


class Connection(rig.PageCase):
    """Reloading, losing, coming back; looking only."""

    def test_a_reloaded_page_is_still_let_in(self):
        system = self.open(WALL)
        self.assertNotIn("#", self.page.js("return location.href"))
        self.page.driver.refresh()
        self.page.ready()
        self.assertEqual(self.page.text("h1"), "stop_at_wall")
        self.assertNotIn(system.url.split("#")[1], self.page.js("return document.documentElement.outerHTML"))

    def test_the_page_says_that_the_engine_is_gone_and_that_another_one_came(self):
        system = self.open(WALL)
        page = self.page
        system.end()
        page.until("document.body.classList.contains('offline')", "the page says that it is alone")
        self.assertIn("Connection lost", page.text(".notices"))
        again = self.system(WALL, options=["--port", str(system.port)])
        self.assertEqual(again.port, system.port)
        page.until("document.querySelector('.notices').textContent.includes('was restarted and does not know this page')", "the page says so")
        page.open(again.url)
        self.assertFalse(page.js("return document.body.classList.contains('offline')"))

    def test_an_engine_that_says_nothing_any_more_is_noticed_and_found_again(self):
        system = self.open(WALL)
        page = self.page
        system.process.send_signal(signal.SIGSTOP)
        page.until("document.body.classList.contains('offline')", "the page says that it is alone")
        system.process.send_signal(signal.SIGCONT)
        page.until("!document.body.classList.contains('offline')", "the page is connected again")
        before = page.text(".clock")
        page.until("document.querySelector('.clock').textContent !== %r" % before, "time is shown again")

    def test_the_space_bar_stops_wherever_no_text_is_typed(self):
        self.open(WALL)
        page = self.page
        stopped = "document.body.classList.contains('stopped')"
        page.find(".console textarea").send_keys("controller ")
        page.view("parameters")
        page.find("input.number[aria-label='controller.stop_d']").send_keys(" ")
        time.sleep(0.5)
        self.assertFalse(page.js("return " + stopped))
        self.assertEqual(page.js("return document.querySelector('.console textarea').value"), "controller ")
        button = page.find(".world .toggle")
        page.js("arguments[0].focus()", button)
        button.send_keys(" ")
        page.until(stopped, "the robots are stopped")
        self.assertEqual(button.get_attribute("aria-pressed"), "false")

    def test_the_emergency_stop_is_in_reach_whatever_is_asked(self):
        self.open(WALL)
        page = self.page
        page.press("Restart")
        page.until("document.querySelector('.ask')", "it asks")
        page.find("button.stop").click()
        page.until("document.body.classList.contains('stopped')", "the page says that it is stopped")
        page.press("Cancel")
        page.view("diagram")
        page.press("Add…")
        page.press("Re-arm")
        page.until("!document.body.classList.contains('stopped')", "the robots may move again")
        page.find("button.stop").click()
        page.until("document.body.classList.contains('stopped')", "the page says that it is stopped, beside the form")

    def test_time_is_paused_stepped_and_begun_anew(self):
        self.open(WALL)
        page = self.page
        seconds = lambda: float(page.text(".clock").split()[0])
        page.press("Pause")
        page.until("document.querySelector('.late').textContent === 'paused'", "time stands")
        time.sleep(0.3)
        before = seconds()
        page.press("Step")
        rig.wait_until(lambda: math.isclose(seconds(), before + 0.01, abs_tol=0.0051), lambda: "%g is one tick more than %g" % (seconds(), before))
        page.press("Run")
        rig.wait_until(lambda: seconds() > before + 0.2, "time passes")
        page.press("Restart")
        page.answer("Restart")
        rig.wait_until(lambda: seconds() < before + 0.2, "time begins again")

    def test_colours_are_light_or_dark_as_the_computer_has_them_until_somebody_chooses(self):
        self.open(WALL)
        page = self.page
        self.addCleanup(page.resize, *self.size)
        is_dark = "getComputedStyle(document.documentElement).colorScheme === 'dark'"
        page.until("!(" + is_dark + ")", "light colours")
        light = page.driver.execute_script("return getComputedStyle(document.body).backgroundColor")
        page.resize(1280, 800, dark=True)
        page.until(is_dark, "the computer's dark colours")
        self.assertNotEqual(page.driver.execute_script("return getComputedStyle(document.body).backgroundColor"), light)
        page.find("button.theme").click()  # from automatic to light
        page.until("!(" + is_dark + ")", "light colours by choice")
        page.resize(1280, 800)
        page.find("button.theme").click()
        page.until(is_dark, "dark colours by choice")

    def test_a_phone_shows_everything_within_its_width(self):
        self.open(WALL)
        page = self.page
        self.addCleanup(page.resize, *self.size)
        page.resize(390, 844)
        for view in ("world", "diagram", "plots", "drive", "parameters", "cameras", "console", "log"):
            page.view(view)
            self.assertEqual(page.js("return document.documentElement.scrollWidth"), 390, view)
            stop = page.js("const box = document.querySelector('.stop').getBoundingClientRect(); return [box.left, box.right]")
            self.assertTrue(0 <= stop[0] < stop[1] <= 390, (view, stop))
            self.assertTrue(page.js("return document.querySelector(`#view-${arguments[0]}`).offsetHeight > 250", view), view)


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
