"""The playground in a real browser: the engine of build/web/site in the page, from a folder that a plain server gives.
Usage: playground_test.py NEZUMI [TEST...]"""

import functools
import http.server
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zipfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

BUILT = os.path.join(rig.ROOT, "build/web/site")


class Server:
    """A static server of the folder, which keeps the paths it was asked for. `others`: further files by their paths."""

    def __init__(self, others=None):
        self.asked = asked = []
        others = others or {}

        class Handler(http.server.SimpleHTTPRequestHandler):
            extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm"}

            def do_GET(self):
                asked.append(self.path)
                if self.path not in others:
                    return super().do_GET()
                self.send_response(200)
                self.send_header("Content-Type", self.guess_type(self.path))
                self.end_headers()
                self.wfile.write(others[self.path].encode())

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=BUILT))
        self.url = "http://127.0.0.1:%d/" % self.server.server_address[1]
        self.thread = threading.Thread(target=self.server.serve_forever)
        self.thread.start()

    def close(self):
        self.server.shutdown()
        self.thread.join()
        self.server.server_close()


class PlaygroundCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server()
        cls.page = rig.Page()
        cls.driver = cls.page.driver

    @classmethod
    def tearDownClass(cls):
        cls.page.close()
        cls.server.close()

    def js(self, code, *arguments):
        return self.driver.execute_script(code, *arguments)

    def open(self, fragment):
        self.driver.get("about:blank")
        self.driver.execute_cdp_cmd("Storage.clearDataForOrigin", {"origin": self.server.url[:-1], "storageTypes": "local_storage,indexeddb"})
        self.driver.get(self.server.url + fragment)

    def wait(self, code, what, within=rig.PATIENCE):
        return rig.wait_until(lambda: self.js("return " + code), what, within)

    def text(self):
        return self.js("return document.body.innerText")

    def ready(self):
        self.wait("document.querySelector('.dot.open') !== null", lambda: "the engine has answered; it shows %r" % self.text()[:300])

    def run_system(self, name):
        self.open("#run=" + name)
        self.ready()
        self.wait("/[1-9]\\.\\d\\d s/.test(document.body.innerText)", "time passes")

    def console(self, line):
        field = self.driver.find_element("css selector", ".console input, .console textarea")
        if not field.is_displayed():  # pages from files share what they remember of the last view
            self.page.view("console")
        field.send_keys(line + "\n")

    def shows(self, text):
        """The console has answered with a line of this."""
        self.wait("[...document.querySelectorAll('.console .output pre')].some((each) => each.textContent.includes(%r)"
                  " && !each.textContent.includes('print('))" % text, lambda: "it shows %r; it shows %r" % (text, self.text()[-600:]))

    def told(self, part):
        self.wait("document.querySelector('.editor .told').textContent.includes(%r)" % part,
                  lambda: "it tells %r; it tells %r" % (part, self.page.text(".editor .told")))

    def edit(self, file, old, new):
        self.page.view("editor")
        self.wait("document.querySelector('.editor .tools h2')?.textContent === %r" % file, "the behaviour that runs is open")
        self.js("""const editor = document.querySelector(".CodeMirror").CodeMirror;
                   editor.setValue(editor.getValue().replace(arguments[0], arguments[1]));
                   editor.focus();""", old, new)
        self.driver.switch_to.active_element.send_keys("\ue009" + "s")

    def in_page(self, code):
        return self.driver.execute_async_script("const done = arguments[arguments.length - 1]; (async () => {" + code + "})().then(done, (no) => done(String(no)))")


class Running(PlaygroundCase):
    """A shipped system runs, is changed and broken, in the same page as a served one."""

    def test_a_system_runs_and_the_console_sees_it(self):
        self.run_system("left_hand")
        self.console("print(1 + 1, mouse.truth.pose.heading ~= nil)")
        self.shows("2\ttrue")
        self.console("run(1) print('later')")
        self.shows("later")

    def test_nothing_is_loaded_once_it_runs(self):
        self.run_system("left_hand")
        before = len(self.server.asked)
        for view in ("plots", "diagram", "editor", "explain", "parameters", "world"):
            self.page.view(view)
        self.console("print('still ' .. 'here')")
        self.shows("still here")
        self.assertEqual(self.server.asked[before:], [])
        self.assertEqual(self.page.errors(), [])

    def test_a_saved_behaviour_runs_anew_and_is_kept_in_this_browser(self):
        self.run_system("left_hand")
        self.edit("left_hand.lua", "function on_execute()", "function on_execute()\n  probe('mine', 42)")
        self.told("version 2 runs (solver)")
        self.console("print('probe ' .. solver.probes.mine.value)")
        self.shows("probe 42")
        self.wait("location.hash.startsWith('#project=')", "it is a project of its own")
        time.sleep(1)
        self.driver.refresh()
        self.ready()
        self.console("print('again ' .. solver.probes.mine.value)")
        self.shows("again 42")

    def test_a_loop_without_end_is_ended_and_the_version_before_goes_on(self):
        self.run_system("left_hand")
        self.edit("left_hand.lua", "function on_execute()", "function on_execute()\n  while true do end")
        self.wait("/endless loop/.test(document.body.innerText)", "the message names the loop")
        self.console("print('goes on ' .. tostring(solver.error == nil))")
        self.shows("goes on true")

    def test_time_is_rewound_and_a_line_is_explained(self):
        self.run_system("left_hand")
        self.console("pause() rewind(1) print('back ' .. (now() < 100 and 'then' or ''))")
        self.shows("back then")
        self.console("explain(solver) step()")
        self.wait("/left_hand.lua:\\d+/.test(document.body.innerText)", "lines are explained")


    def test_a_line_that_waits_lets_the_page_work_and_is_ended(self):
        self.run_system("left_hand")
        self.console("for i = 1, 1000 do run(1) end print('never')")
        self.wait("document.querySelector('.console button.stop, .console .line button:nth-of-type(2)')", "the console is there")
        self.page.view("plots")
        self.page.view("editor")
        self.wait("document.querySelector('.editor .tools h2')?.textContent.endsWith('.lua')", "the editor has its answer meanwhile")
        before = self.js("return Number(document.querySelector('.clock').textContent.split(' ')[0])")
        self.wait("Number(document.querySelector('.clock').textContent.split(' ')[0]) > %f" % (before + 0.5), "time passes")
        area = self.driver.find_element("css selector", ".console textarea")
        area.send_keys("\ue009c")
        self.shows("interrupted")
        self.console("run(0.1) print('after ' .. 1)")
        self.shows("after 1")


class Scenarios(PlaygroundCase):
    """Scenarios and checks, in workers of their own."""

    MINE = """{ "behaviors/systems/mine.lua": 'robot "mouse" { model = "raspimouse" }\\nbehavior "it" { script = "it" }\\nconnect("it.out", "mouse.target_velocity_in")\\n',
      "behaviors/it.lua": 'local out = output("out", "TimedVelocity2D")\\nfunction on_execute() out:write { vx = 0.1 } end\\n',
      "tests/it_test.lua": 'scenario("moves", function(s)\\n  local world = s:load "systems/mine"\\n  s:run(1)\\n  s:always("near", function() return world.mouse.truth.pose.position.x < 0.2 end)\\n  s:run(0.5)\\nend)\\nscenario("fails", function(s)\\n  local world = s:load "systems/mine"\\n  s:always("near", function() return world.mouse.truth.pose.position.x < 0.05 end)\\n  s:run(3)\\nend)\\nscenario("has no end", { timeout = 1e6 }, function(s)\\n  s:load "systems/mine"\\n  s:run(9e5)\\nend)\\n' }"""

    def begin(self):
        self.open("")
        self.wait("document.querySelectorAll('main.gallery li').length > 15", "the gallery is there")
        link = self.in_page("const { to_fragment } = await import('./project_link.js'); return to_fragment({ name: 'mine', system: 'behaviors/systems/mine.lua', files: %s });" % self.MINE)
        self.open(link)
        self.ready()

    def state(self, name):
        return self.js("return document.querySelector(`.scenario[data-name='${arguments[0]}']`)?.className.split(' ')[1]", name)

    def run_one(self, name):
        self.js("document.querySelector(`.scenario[data-name='${arguments[0]}'] .run-one`).click()", name)

    def test_they_are_listed_run_and_ended_while_the_page_goes_on(self):
        self.begin()
        self.page.view("scenarios")
        self.wait("document.querySelectorAll('.scenario').length === 3", lambda: "they are listed; it shows %r" % self.text()[-400:])
        self.run_one("moves")
        rig.wait_until(lambda: self.state("moves") == "passed", lambda: "it passes; it shows %r" % self.text()[-400:])
        self.wait("!document.querySelector('.run-one').disabled", "the next may run")
        self.run_one("fails")
        rig.wait_until(lambda: self.state("fails") == "failed", "it fails")
        self.assertIn("always 'near' held until", self.page.text(".scenario.failed summary"))
        self.assertEqual(self.page.all(".scenario.failed > button:not(.place, .run-one)"), [], "no folder is kept that could be opened")
        self.wait("!document.querySelector('.run-one').disabled", "the next may run")
        self.run_one("has no end")
        before = self.js("return Number(document.querySelector('.clock').textContent.split(' ')[0])")
        self.wait("Number(document.querySelector('.clock').textContent.split(' ')[0]) > %f" % (before + 1), "the page's engine goes on")
        self.page.press("Stop these")
        self.wait("!document.querySelector('.run-one').disabled", "it is ended")
        self.run_one("moves")
        rig.wait_until(lambda: self.state("moves") == "passed", "another one runs after it")
        self.assertEqual(self.page.errors(), [])

    def test_mistakes_are_found_while_typing(self):
        self.begin()
        self.page.view("editor")
        self.wait("document.querySelector('.editor .tools h2')?.textContent === 'it.lua'", "the behaviour is open")
        self.js("const text = document.querySelector('.CodeMirror').CodeMirror; text.setValue(text.getValue().replace('TimedVelocity2D', 'TimedVelocity2'))")
        self.wait("/TimedVelocity2'/.test(document.querySelector('.findings').textContent)", lambda: "it is found; it shows %r" % self.page.text(".findings"))
        self.assertIn("did you mean 'TimedVelocity2D'?", self.page.text(".findings"))
        self.js("const text = document.querySelector('.CodeMirror').CodeMirror; text.setValue(text.getValue().replace(/TimedVelocity2'/, 'TimedVelocity2D').replace(\"'TimedVelocity2\\\"\", '').replace('\"TimedVelocity2\"', '\"TimedVelocity2D\"'))")
        self.wait("document.querySelector('.findings').hidden", lambda: "nothing is found any more; it shows %r" % self.page.text(".findings"))


class Guide(PlaygroundCase):
    """The tutorial in the page: what is typed is checked."""

    def save(self, text):
        self.js("""const editor = document.querySelector(".CodeMirror").CodeMirror;
                   editor.setValue(arguments[0]);
                   editor.focus();""", text)
        self.driver.switch_to.active_element.send_keys("\ue009" + "s")
        self.wait("document.querySelector('.editor .primary').disabled", "it is saved")
        time.sleep(0.5)  # the page is told of saved files a few times a second

    def open_file(self, file):
        self.page.view("editor")
        self.wait("document.querySelector(`.files [data-file='%s']`) !== null" % file, "the file is listed")
        self.js("document.querySelector(`.files [data-file='${arguments[0]}']`).click()", file)
        self.wait("document.querySelector(`.files [data-file='%s'][aria-current]`) !== null" % file, "it is open")

    def check(self, result):
        self.js("document.querySelector('.check-step').click()")
        self.wait("document.querySelector('.guide [role=status]').className === %r" % result,
                  lambda: "the step is %s; it shows %r" % (result, self.page.text(".guide [role=status]")), 60)
        return self.page.text(".guide [role=status]")

    def typed(self):
        return self.page.text(".guide pre")

    def next(self, title):
        self.page.press("Next step")
        self.assertEqual(self.page.text(".guide h2"), title)

    def test_four_steps_lead_to_a_tested_behaviour(self):
        self.open("#guide")
        self.ready()
        self.wait("document.querySelector('.guide h2')?.textContent === 'A behaviour'", "the first step is shown")
        self.check("wrong")
        behavior = self.typed()
        self.open_file("behaviors/keep_distance.lua")
        self.save(behavior)
        self.assertIn("distnace", self.check("wrong"))
        behavior = behavior.replace("distnace", "distance")
        self.save(behavior)
        self.check("good")
        self.next("A system")
        self.check("wrong")
        system = self.typed()
        self.open_file("behaviors/systems/keep_distance.lua")
        self.save(system)
        self.check("good")
        self.next("Change it while it runs")
        time.sleep(1)
        self.page.press("Begin again")
        self.wait("/^[01]\\.\\d\\d s/.test(document.querySelector('.clock').textContent) && document.querySelector('.dot.open') !== null", "the engine has begun again")
        self.console("run(0.1) print('x ' .. (mouse.truth.velocity.vx > 0.01 and 'drives' or 'stands'))")
        self.shows("x drives")
        self.assertIn("0.8", self.check("wrong"))
        self.open_file("behaviors/keep_distance.lua")
        self.save(behavior.replace('"gain", 1.0', '"gain", 0.8'))
        self.check("good")
        self.next("A test")
        self.assertIn("no scenario", self.check("wrong"))
        test = self.typed()
        self.page.press("New…")
        self.page.answer("Make", "tests/keep_distance_test.lua")
        self.wait("document.querySelector(`.files [data-file='tests/keep_distance_test.lua'][aria-current]`) !== null", "the new file is open")
        self.save('scenario("runs", function(s)\n  s:load "systems/keep_distance"\n  s:run(1)\nend)\n')
        self.assertIn("gain of 0.1", self.check("wrong"))
        self.save(test)
        self.check("good")
        self.page.press("Next step")
        self.assertIn("All done", self.page.text(".guide"))
        self.driver.refresh()
        self.ready()
        self.wait("document.querySelector('.guide')?.textContent.includes('All done')", "the step is kept in this browser")
        self.assertEqual(self.page.errors(), [])

    def test_the_examples_of_the_documentation_have_no_mistakes(self):
        self.open("")
        self.wait("document.querySelectorAll('main.gallery a[href^=\"#example=\"]').length > 5", "they are listed")
        wrong = self.in_page("""
          const docs = await (await fetch("docs.json")).json();
          const { Helpers } = await import("./helpers.js");
          const wrong = {};
          for (const [name, { files }] of Object.entries(docs.examples)) {
            let answer;
            const answered = new Promise((resolve) => (answer = resolve));
            const helpers = new Helpers(() => new Worker("helper_worker.js"), () => files, answer);
            helpers.start = { module: await WebAssembly.compileStreaming(fetch("nezumi.wasm")), shipped: await (await fetch("files.json")).json() };
            const { systems_in } = await import("./project_files.js");
            const file = systems_in(files)[0];
            helpers.takes(JSON.stringify({ do: "edit", what: "check", file, text: files[file], id: 1 }));
            const { ok, text, findings } = await answered;
            helpers.end();
            if (!ok || findings.length > 0) wrong[name] = text || findings.map(({ message }) => message);
          }
          return wrong;""")
        self.assertEqual(wrong, {})


class Projects(PlaygroundCase):
    """What is exported, imported, and given in a link."""

    def test_an_exported_project_runs_natively_and_is_opened_again(self):
        self.run_system("stop_at_wall")
        packed = self.in_page("""const { write_zip } = await import("./zip.js");
          const { shipped_project } = await import("./shipped.js");
          const shipped = await (await fetch("files.json")).json();
          const { files } = shipped_project(shipped, "stop_at_wall");
          return [...new Uint8Array(await (await write_zip(files)).arrayBuffer())];""")
        with tempfile.TemporaryDirectory() as folder:
            archive = os.path.join(folder, "project.zip")
            with open(archive, "wb") as out:
                out.write(bytes(packed))
            with zipfile.ZipFile(archive) as opened:
                self.assertIsNone(opened.testzip())
                opened.extractall(folder)
            ran = subprocess.run([rig.PageCase.nezumi, "run", "behaviors/systems/stop_at_wall.lua", "--headless", "--speed", "max", "--duration", "2",
                                  "--trace-hash"], cwd=folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            self.open("")
            self.wait("document.querySelector('input[type=file]') !== null", "the gallery is there")
            self.driver.find_element("css selector", "input[type=file]").send_keys(archive)
            self.wait("location.hash.startsWith('#project=')", "it is opened")
            self.ready()
            self.console("print('name ' .. controller.name)")
            self.shows("name controller")

    def test_a_link_holds_a_project_and_nothing_of_it_is_trusted(self):
        self.open("")
        self.wait("document.querySelectorAll('main.gallery li').length > 15", "the gallery is there")
        link = self.in_page("""const { to_fragment } = await import("./project_link.js");
          return to_fragment({ name: "mine", system: "behaviors/systems/mine.lua", files: { "behaviors/systems/mine.lua":
            'robot "mouse" { model = "raspimouse" }\\nbehavior "it" { script = "it" }\\n', "behaviors/it.lua": 'function on_execute() probe("seen", 7) end' } });""")
        self.assertLess(len(link), 600)
        self.open(link)
        self.ready()
        self.console("print('seen ' .. it.probes.seen.value)")
        self.shows("seen 7")
        for files in ("{ '../evil.lua': '' }", "{ '/etc/x.lua': '' }", "{ 'a/../../b.lua': '' }", "{ 'x.js': '' }", "{}"):
            wrong = self.in_page("const { checked_files } = await import('./project_files.js'); try { checked_files(%s); return 'taken'; } catch (no) { return no.message; }" % files)
            self.assertNotEqual(wrong, "taken", files)
        too_long = self.in_page("const { to_fragment } = await import('./project_link.js'); try { await to_fragment({ name: 'x', system: 'a.lua',"
                                " files: { 'a.lua': 'x'.repeat(9000) } }); return 'taken'; } catch (no) { return no.message; }")
        self.assertIn("9000 > 8192", too_long)

    def test_the_gallery_is_in_both_languages_and_says_what_needs_a_camera(self):
        self.open("")
        self.wait("document.querySelectorAll('main.gallery li').length > 15", "the systems are listed")
        self.assertIn("follow_marker", self.text())
        self.assertEqual(self.js("return document.querySelector('a[href=\"#run=follow_marker\"]')"), None)


class Shared(PlaygroundCase):
    """`nezumi share`: a run in one file."""

    def share(self, folder, system, seconds, *options, size):
        journal, page = os.path.join(folder, "run.journal"), os.path.join(folder, "run.html")
        subprocess.run([rig.PageCase.nezumi, "run", system, "--headless", "--speed", "max", "--duration", str(seconds), "--journal", journal],
                       cwd=rig.ROOT, check=True, capture_output=True, timeout=240)
        subprocess.run([rig.PageCase.nezumi, "share", journal, "-o", page, *options], cwd=rig.ROOT, check=True, timeout=240)
        self.assertLess(os.path.getsize(page), size)
        self.driver.get("file://" + page)
        self.ready()

    def test_a_shared_run_plays_explains_and_goes_on_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            self.share(folder, "stop_at_wall", 3, size=3_300_000)
            self.console("print('at ' .. now())")
            self.shows("at 3.0")
            self.console("rewind(2) print('then ' .. now())")
            self.shows("then 1.0")
            self.console("controller.config.speed_x = 0.3 resume() run(1) print('on ' .. controller.config.speed_x)")
            self.shows("on 0.3")

    def drag_to(self, time):
        self.js("""const slider = document.querySelector(".timeline input");
                   slider.dispatchEvent(new Event("pointerdown"));
                   slider.value = arguments[0];
                   slider.dispatchEvent(new Event("input"));""", time)

    def test_a_light_run_plays_at_any_speed_and_plots_without_an_engine(self):
        with tempfile.TemporaryDirectory() as folder:
            self.share(folder, "stop_at_wall", 10, "--light", size=800_000)
            self.wait("document.querySelector('.clock').textContent > '0.2'", "it plays")
            self.page.choose_text(".world select", "mouse")
            self.page.press("Pause")
            self.drag_to(4)
            time.sleep(0.5)
            looked = self.page.pose()
            self.js("document.querySelector('.timeline input').dispatchEvent(new Event('change'))")
            self.wait("document.querySelector('.clock').textContent.startsWith('4.00')", "it is there")
            time.sleep(0.5)
            self.assertAlmostEqual(self.page.pose()[0], looked[0], delta=0.002, msg="what is seen while the slider is dragged is what was")
            self.assertGreater(looked[0], 0.1)
            self.page.choose("select[aria-label='Speed']", "10")
            self.page.press("Run")
            begun = time.monotonic()
            self.wait("document.querySelector('.clock').textContent.startsWith('10.00')", "it plays to its end")
            self.assertLess(time.monotonic() - begun, 5, "ten times as fast")
            self.page.view("plots")
            self.page.plot("controller.out", "vx")
            self.wait("document.querySelector('.plots canvas') !== null", "it is drawn")
            self.wait("/^-?\\d/.test(document.querySelector('.plots .chip b').textContent)", "its value at this time is told")
            self.assertFalse(self.page.find(".stop").is_displayed(), "nothing can be stopped")
            self.assertEqual(self.page.errors(), [])

    def test_a_light_run_of_many_robots_stays_small(self):
        with tempfile.TemporaryDirectory() as folder:
            self.share(folder, "swarm", 60, "--light", size=800_000)
            self.wait("document.querySelector('.clock').textContent > '0.2'", "it plays")
            self.assertGreater(self.js("return document.querySelectorAll('.world select option').length"), 5)


if __name__ == "__main__":
    if not os.path.exists(os.path.join(BUILT, "run.html")):
        print("SKIPPED: the engine for web pages is not built (.ci/web)")
        sys.exit(0)
    sys.exit(rig.main(__name__))
