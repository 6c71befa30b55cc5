"""Scenarios in the browser's page. Usage: scenarios_test.py NEZUMI [TEST...]"""

import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig
from rig import APART

GOOD = """scenario("moves off", function(s)
  local world = s:load("tried")
  s:never("touches anything", function() return world.mouse.collided end)
  s:run(1)
end)
"""
BAD = """scenario("stays near", function(s)
  local world = s:load("tried")
  s:always("is near", function() return world.mouse.truth.pose.position.x < 0.05 end)
  s:run(3)
end)
"""
LONG = """scenario("drives", function(s)
  s:load("tried")
  s:run(10)
end)
"""
KEEPER = """local out = output("out", "TimedVelocity2D")
function on_execute() out:write { vx = 0.1 } end
"""
MEASURED = """scenario("is fast", { sweep = { speed = { 0.1, 0.2 } } }, function(s, p)
  local world = s:load("tried")
  world.controller.config.speed_x = p.speed
  s:run(1)
  s:measure("distance", world.mouse.truth.pose.position.x, "m")
end)
"""
DRIVES = APART + 'connect("controller.out", "mouse.target_velocity_in")\n'


class Scenarios(rig.PageCase):
    def begin(self, **files):
        system = self.system(text=DRIVES)
        os.mkdir(os.path.join(system.folder, "tests"))
        for name, text in files.items():
            with open(os.path.join(system.folder, "tests", name + "_test.lua"), "w") as out:
                out.write(text)
        with open(os.path.join(system.folder, "behaviors", "tried.lua"), "w") as out:
            out.write(DRIVES)
        self.page.open(system.url)
        self.addCleanup(self.page.driver.get, "about:blank")
        self.page.view("scenarios")
        return system

    def state(self, name):
        return self.page.js("return document.querySelector(`.scenario[data-name='${arguments[0]}']`)?.className.split(' ')[1]", name)

    def test_scenarios_are_listed_run_and_shown_with_their_margins(self):
        self.begin(good=GOOD, bad=BAD)
        page = self.page
        page.until("document.querySelectorAll('.scenario').length === 2", "both are listed")
        page.press("Run all")
        rig.wait_until(lambda: self.state("moves off") == "passed" and self.state("stays near") == "failed", "both have run", 60)
        page.until("document.querySelector('.scenarios .tools .hint').textContent === '1 passed, 1 failed'", "it is counted")
        self.assertIn("never 'touches anything'", page.text(".scenario.passed pre"))
        self.assertIn("always 'is near' held until", page.text(".scenario.failed summary"))
        self.assertEqual(page.js("return document.querySelector('.group .tab[data-view=scenarios] .badge').textContent"), "1")
        page.find(".scenario.failed .place").click()
        page.until("document.querySelector('.editor .tools h2')?.textContent === 'bad_test.lua'", "the scenario is open in the editor")
        self.assertEqual(page.errors(), [])

    def test_lines_that_no_scenario_ran_are_marked_in_the_editor(self):
        system = self.begin(good=GOOD)
        page = self.page
        with open(os.path.join(system.folder, "behaviors", "keeper.lua"), "w") as out:
            out.write(KEEPER + "function on_deactivated()\n  out:write {}\nend\nfunction on_reset()\n  state.n = 0\nend\n")
        with open(os.path.join(system.folder, "tests", "keeper_test.lua"), "w") as out:
            out.write('scenario("keeps", function(s)\n  s:behavior "keeper" { script = "keeper" }\n  s:run(1)\nend)\n')
        page.until("document.querySelectorAll('.scenario').length > 0", "they are listed")
        page.press("Run all")
        page.until("/^\\d+ passed/.test(document.querySelector('.scenarios .tools .hint').textContent)", "they have run", 60)
        page.view("editor")
        page.js("[...document.querySelectorAll('.files button, .desk button')].find((each) => each.textContent.includes('keeper.lua')).click()")
        marked = ("const text = document.querySelector('.CodeMirror')?.CodeMirror; const lines = [];"
                  "text?.eachLine((line) => { if (line.gutterMarkers?.['gutter-coverage']) lines.push(text.getLineNumber(line) + 1); }); return lines")
        rig.wait_until(lambda: page.js(marked) == [4, 7], "the lines are marked: %s" % page.js(marked), 10)
        self.assertEqual(page.errors(), [])

    def test_one_scenario_is_run_alone(self):
        self.begin(good=GOOD, bad=BAD)
        page = self.page
        page.until("document.querySelector('.scenario') !== null", "they are listed")
        page.find("[aria-label='Run moves off']").click()
        rig.wait_until(lambda: self.state("moves off") == "passed", "it has run", 60)
        self.assertEqual(self.state("stays near"), "")

    def test_a_failed_run_is_opened_where_it_failed(self):
        self.begin(bad=BAD)
        page = self.page
        page.until("document.querySelector('.scenario') !== null", "it is listed")
        page.press("Run all")
        rig.wait_until(lambda: self.state("stays near") == "failed", "it has run", 60)
        with page.opened(lambda: page.press("Open")):
            page.until("document.querySelector('.late')?.textContent === 'paused'", "it is paused", 60)
            page.until("parseFloat(document.querySelector('.clock').textContent) > 0.3", "it is where it failed")

    def test_a_scenario_is_watched_while_it_runs(self):
        self.begin(long=LONG)
        page = self.page
        page.until("document.querySelector('.scenario') !== null", "it is listed")
        time = lambda: float(page.text(".clock").split()[0])
        with page.opened(lambda: page.find("[aria-label^='Watch drives']").click()):
            page.until("document.querySelector('header .kind')?.textContent === 'simulated · a scenario runs'", "it says what it is", 60)
            page.until("parseFloat(document.querySelector('.clock').textContent) > 0.3", "time passes")
            self.assertLess(time(), 8, "it runs at the speed of the clock")
            page.press("Pause")
            page.until("document.querySelector('.late').textContent === 'paused'", "it is paused")
            before = time()
            page.press("Step")
            page.until("parseFloat(document.querySelector('.clock').textContent) > %r" % before, "one tick more")
            self.assertAlmostEqual(time(), before + 0.01, places=2)
            # Everything else is only looked at.
            for hidden in (".stop", ".time .wide", ".share"):
                self.assertFalse(page.find("header " + hidden).is_displayed(), hidden)
            page.find(".world canvas").send_keys(" ")
            self.assertFalse(page.js("return document.body.classList.contains('stopped')"))
            canvas = page.find(".world canvas")
            view = canvas.screenshot_as_png
            page.keys().move_to_element_with_offset(canvas, 200, 100).click_and_hold().move_by_offset(90, 30).release().perform()
            page.drawn()
            self.assertTrue(canvas.screenshot_as_png != view, "the view turns")
            page.picture("watched")
            page.find(".run.acts").send_keys("\ue007")  # Enter
            page.choose("header select[aria-label=Speed]", "max")
            page.until("[...document.querySelectorAll('.notice.good')].some((each) => each.textContent === 'passed after 10.00 s')", "it says how it ended")
            page.until("Math.abs(parseFloat(document.querySelector('.clock').textContent) - 10) < 0.01", "the clock shows the end")
            self.assertEqual(page.errors(), [])

    def test_a_watched_scenario_cannot_be_changed_and_its_failure_is_told(self):
        self.begin(bad=BAD)
        page = self.page
        page.until("document.querySelector('.scenario') !== null", "it is listed")
        with page.opened(lambda: page.find("[aria-label^='Watch stays near']").click()):
            page.until("document.querySelector('.notice.error')?.textContent.includes('always \\'is near\\' held until')", "the failure is told", 60)
            answer = page.driver.execute_async_script("""const done = arguments[0];
                const socket = new WebSocket(`ws://${location.host}/ws`, ["nezumi", `token.${sessionStorage.getItem("nezumi.token")}`]);
                socket.onopen = () => ["stop", "rearm"].forEach((each, id) => socket.send(JSON.stringify({ do: each, id })));
                const got = [];
                socket.onmessage = ({ data }) => {
                  if (typeof data === "string" && JSON.parse(data).is === "answer") got.push(JSON.parse(data).text);
                  if (got.length === 2) done(got);
                };""")
            self.assertEqual(answer, ["a scenario that is watched can't be changed"] * 2)

    def test_a_wrong_scenario_file_is_told(self):
        self.begin(wrong="scenaro('x')\n")
        self.page.until("document.querySelector('.scenarios .error')?.textContent.includes('scenaro')", "the reason is shown")

    def test_a_behaviour_is_judged_by_a_recording_again_at_each_save(self):
        system = self.begin()
        page = self.page
        behavior = os.path.join(system.folder, "behaviors", "keeper.lua")
        with open(behavior, "w") as out:
            out.write(KEEPER)
        with open(os.path.join(system.folder, "kept.lua"), "w") as out:
            out.write('behavior "keeper" { script = "keeper" }\n')
        subprocess.run([self.nezumi, "run", "kept.lua", "--headless", "--speed", "max", "--duration", "1", "--record", "drive.mcap"],
                       cwd=system.folder, check=True, capture_output=True)
        page.find(".judge summary").click()
        page.until("document.querySelector('.judge select')?.value === 'drive.mcap'", "the recording is offered")
        page.choose(".judge [aria-label=Behaviour]", "behaviors/keeper.lua")
        page.find(".judge [type=checkbox]").click()
        page.press("Judge")
        page.until("document.querySelector('.judge .told').textContent.startsWith('equal: what keeper writes in 1 s')", "it is equal", 60)
        page.until("document.querySelector('.judge .plot').naturalWidth > 100", "both curves are drawn")
        self.assertEqual(page.js("return document.querySelector('.judge .told').classList.contains('error')"), False)
        page.view("editor")
        page.until("document.querySelector('.editor [data-file=\"behaviors/keeper.lua\"]') !== null", "the file is listed")
        page.find('.editor [data-file="behaviors/keeper.lua"]').click()
        page.until("document.querySelector('.CodeMirror')?.CodeMirror.getValue().includes('vx = 0.1')", "its text is open")
        page.js("const text = document.querySelector('.CodeMirror').CodeMirror; text.focus();"
                "text.setValue(text.getValue().replace('vx = 0.1', 'vx = 0.2'))")
        page.driver.switch_to.active_element.send_keys("\ue009s")
        page.view("scenarios")
        page.until("document.querySelector('.judge .told').textContent.startsWith('different in 100 of 100 ticks')", "it was judged again", 60)
        self.assertEqual(page.errors(), [])

    def test_measures_of_a_sweep_are_shown_as_plots(self):
        system = self.begin(fast=MEASURED)
        page = self.page
        page.press("Run all")
        page.until("document.querySelector('.measures img')?.complete", "the plot is shown", 60)
        self.assertEqual(page.text(".measures summary"), "1 plot of measures")
        self.assertIn("distance", page.find(".measures img").get_attribute("alt"))
        self.assertGreater(page.js("return document.querySelector('.measures img').naturalWidth"), 100)
        lines = page.js("return [...document.querySelectorAll('.scenario pre')].map((each) => each.textContent).join()")
        self.assertNotIn("2 runs", lines)  # what is said of all runs is not said of the last one
        self.assertEqual(os.listdir(os.path.join(system.folder)).count("nezumi-test"), 0)
        self.assertEqual(page.errors(), [])


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
