"""The playground in a real browser: the engine of build/web in the page, from a folder that a plain server gives."""

import functools
import http.server
import os
import sys
import threading
import unittest

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
        self.driver.get(self.server.url + fragment)

    def wait(self, code, what, within=rig.PATIENCE):
        return rig.wait_until(lambda: self.js("return " + code), what, within)

    def text(self):
        return self.js("return document.body.innerText")


class Running(PlaygroundCase):
    """A shipped system runs, is changed and broken, in the same page as a served one."""

    def console(self, line):
        field = self.driver.find_element("css selector", ".console input")
        field.send_keys(line + "\n")

    def test_a_system_runs_and_the_console_sees_it(self):
        self.open("#run=left_hand")
        self.wait("document.querySelector('.dot.open') !== null", "the engine has answered")
        self.wait("/[1-9]\\.\\d\\d s/.test(document.body.innerText)", "time passes")
        self.console("print(1 + 1, mouse.truth.pose.x ~= nil)")
        self.wait("/2\\s+true/.test(document.body.innerText)", "the console answers")

    def test_nothing_is_loaded_once_it_runs(self):
        self.open("#run=left_hand")
        self.wait("document.querySelector('.dot.open') !== null", "the engine has answered")
        self.wait("/[1-9]\\.\\d\\d s/.test(document.body.innerText)", "time passes")
        before = len(self.server.asked)
        for view in ("plots", "diagram", "editor", "explain", "parameters", "world"):
            self.page.view(view)
        self.console("mouse:stop()")
        self.wait("/[3-9]\\.\\d\\d s/.test(document.body.innerText)", "time has passed")
        self.assertEqual(self.server.asked[before:], [])


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
