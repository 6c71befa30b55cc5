"""The playground in a real browser: the engine of build/web in the page, from a folder that a plain server gives.
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

BUILT = os.path.join(rig.ROOT, "build/web")


class Server:
    """A static server of the folder, which keeps the paths it was asked for."""

    def __init__(self):
        self.asked = asked = []

        class Handler(http.server.SimpleHTTPRequestHandler):
            extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm"}

            def do_GET(self):
                asked.append(self.path)
                super().do_GET()

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
        self.driver.find_element("css selector", ".console input, .console textarea").send_keys(line + "\n")

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

    def test_a_shared_run_plays_explains_and_goes_on_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            journal, page = os.path.join(folder, "run.journal"), os.path.join(folder, "run.html")
            subprocess.run([rig.PageCase.nezumi, "run", "stop_at_wall", "--headless", "--speed", "max", "--duration", "3", "--journal", journal],
                           cwd=rig.ROOT, check=True, capture_output=True, timeout=60)
            subprocess.run([rig.PageCase.nezumi, "share", journal, "-o", page], cwd=rig.ROOT, check=True, timeout=60)
            self.assertLess(os.path.getsize(page), 3_000_000)
            self.driver.get("file://" + page)
            self.ready()
            self.console("print('at ' .. now())")
            self.shows("at 3.0")
            self.console("rewind(2) print('then ' .. now())")
            self.shows("then 1.0")
            self.console("controller.config.speed_x = 0.3 resume() run(1) print('on ' .. controller.config.speed_x)")
            self.shows("on 0.3")


if __name__ == "__main__":
    if not os.path.exists(os.path.join(BUILT, "run.html")):
        print("SKIPPED: the engine for web pages is not built (.ci/web)")
        sys.exit(0)
    sys.exit(rig.main(__name__))
