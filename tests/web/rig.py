"""A running system and a real browser before its page, handled as a person would."""

import contextlib
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CHROMIUM = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-quic", "--hide-scrollbars"]
PATIENCE = 20  # s, for what a busy machine does

# Systems that several files try.
WALL = "behaviors/systems/stop_at_wall.lua"
APART = """
robot    "mouse"      { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
behavior "controller" { script = "robot_controller", config = { speed_x = 0.1 } }
"""


def why_not():
    """What is missing for these tests, or None."""
    for program, package in (("chromium", "chromium"), ("chromedriver", "chromium-driver")):
        if not shutil.which(program):
            return package + " is not installed"
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "python3-selenium is not installed"
    for library in ("three/three.module.js", "dygraphs/dygraph.min.js", "codemirror/lib/codemirror.js"):
        if not os.path.exists("/usr/share/javascript/" + library):
            return "libjs-" + library.split("/")[0] + " is not installed"
    return None


def wait_until(holds, what, within=PATIENCE):
    """What `holds` gives once it is true. `what` says what was waited for."""
    end = time.monotonic() + within
    while True:
        result = holds()
        if result:
            return result
        if time.monotonic() > end:
            raise AssertionError("waited %g s until %s" % (within, what() if callable(what) else what))
        time.sleep(0.03)


class System:
    """`nezumi run` of a file, or of a text with scripts of its own: { name: text }; `runtime`: the folder of another run of
    the same user."""

    def __init__(self, nezumi, file=None, text=None, scripts=None, options=(), runtime=None, command="run"):
        self.folder = tempfile.mkdtemp(prefix="nezumi-web-")
        if text is not None:
            os.mkdir(os.path.join(self.folder, "behaviors"))
            file = os.path.join(self.folder, "tried.lua")
            with open(file, "w") as out:
                out.write(text)
            for name, script in (scripts or {}).items():
                os.makedirs(os.path.dirname(os.path.join(self.folder, "behaviors", name)), exist_ok=True)
                with open(os.path.join(self.folder, "behaviors", name + ".lua"), "w") as out:
                    out.write(script)
        home = runtime or self.folder
        environment = dict(os.environ, XDG_RUNTIME_DIR=home, XDG_STATE_HOME=home)
        self.reader = None
        self.process = subprocess.Popen([nezumi, command, file, *options], cwd=ROOT, env=environment, stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        too_late = threading.Timer(PATIENCE, self.process.kill)
        too_late.start()
        self.said = []
        for line in self.process.stdout:
            self.said.append(line)
            found = re.search(r"https?://127\.0\.0\.1:(\d+)/#\S+", line)
            if found:
                self.url, self.port = found.group(0), int(found.group(1))
            if found or "no page" in line:
                break
        too_late.cancel()
        if not hasattr(self, "url"):
            self.end()
            raise AssertionError("it said no address, but: " + "".join(self.said))
        self.reader = threading.Thread(target=self.said.extend, args=[self.process.stdout])
        self.reader.start()

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        if self.reader:
            self.reader.join()
        self.process.stdout.close()
        shutil.rmtree(self.folder, ignore_errors=True)


class Page:
    """A browser's window. `language`: what its person prefers."""

    def __init__(self, size=(1500, 950), language="en-US"):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service

        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        self.profile = tempfile.mkdtemp(prefix="nezumi-browser-")
        for each in CHROMIUM + ["--user-data-dir=" + self.profile, "--window-size=%d,%d" % size]:
            options.add_argument(each)
        options.add_experimental_option("prefs", {"intl.accept_languages": language})
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
        self.driver.set_script_timeout(PATIENCE)
        self.resize(*size)

    def close(self):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def resize(self, width, height, dark=False):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})

    def open(self, url):
        """The page of a run, once it shows where its robots are."""
        self.driver.get("about:blank")
        self.driver.execute_cdp_cmd("Storage.clearDataForOrigin", {  # what another run's page was left at
            "origin": url.split("/#")[0], "storageTypes": "local_storage"})
        self.driver.get(url)
        self.ready()

    def ready(self):
        wait_until(lambda: self.js("return document.title.includes('nezumi') && document.querySelector('.dot.open') !== null"
                                   " && document.querySelector('main') !== null"),
                   lambda: "the page is connected; it shows %r" % self.driver.find_element("tag name", "body").text[:300])
        wait_until(lambda: self.js("return Number(document.querySelector('canvas').dataset.calls) > 0"
                                   " || document.querySelector('.world').hidden"), "the world is drawn")

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def find(self, selector):
        return self.driver.find_element("css selector", selector)

    def all(self, selector):
        return self.driver.find_elements("css selector", selector)

    def text(self, selector):
        return self.js("return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def until(self, script, what, within=PATIENCE):
        return wait_until(lambda: self.js("return " + script), what, within)

    def view(self, name):
        self.js("""const tab = () => [...document.querySelectorAll(`[data-view=${arguments[0]}]`)].find((each) => each.offsetParent);
                   if (!tab()) document.querySelector(".more > summary").click();
                   tab().click()""", name)
        self.drawn()

    def press(self, name):
        """The button of this name that is seen."""
        button = self.until("[...document.querySelectorAll('button')].find((each) => each.offsetParent && !each.disabled && "
                            "each.textContent.trim() === %r)" % name, "there is a button '%s'" % name)
        button.click()

    def answer(self, yes, text=None):
        """What the page asks for, over everything but the emergency stop."""
        self.until("document.querySelector('.ask') !== null", "it asks")
        if text is not None:
            field = self.find(".ask input")
            field.clear()
            field.send_keys(text)
        button = self.find(".ask button[type=submit]")
        assert button.text == yes, button.text
        button.click()

    @contextlib.contextmanager
    def opened(self, act):
        """The tab that `act` opens, until the end of the block."""
        first = self.driver.current_window_handle
        act()
        wait_until(lambda: len(self.driver.window_handles) == 2, "a tab is there")
        self.driver.switch_to.window(next(each for each in self.driver.window_handles if each != first))
        try:
            self.until("location.hostname === '127.0.0.1'", "its address came", 60)
            self.ready()
            yield
        finally:
            self.driver.close()
            self.driver.switch_to.window(first)

    def unfold(self, *keys):
        """Opens these rows of the tree of plots, one within the other."""
        for key in keys:
            row = '.tree .row[data-key="%s"]' % key
            self.until("document.querySelector(%r)?.hasAttribute('aria-expanded')" % row, "the tree has numbers of " + key)
            self.js("const row = document.querySelector(arguments[0]); if (row.ariaExpanded === 'false') row.click()", row)

    def plot(self, port, *paths):
        """Chooses these numbers of a port for a plot; without any, the port's only one."""
        self.unfold(port.rsplit(".", 1)[0], *([port] if paths else []))
        for key in ["%s %s" % (port, path) for path in paths] or [port]:
            row = '.tree .row[data-key="%s"]' % key
            self.until("document.querySelector(%r)" % row, "it is offered: " + key)
            self.js("document.querySelector(arguments[0]).click()", row)
            self.until("document.querySelector(%r).ariaChecked === 'true'" % row, "it is chosen: " + key)

    def offered(self):
        """The rows of the tree of plots in sight: { key: text }."""
        return self.js("return Object.fromEntries([...document.querySelectorAll('.tree .row')].map((each) => [each.dataset.key, each.textContent]))")

    def picture(self, name):
        """Keeps what is seen now in the folder NEZUMI_PICTURES, if that is set."""
        folder = os.environ.get("NEZUMI_PICTURES")
        if folder:
            self.driver.save_screenshot(os.path.join(folder, name + ".png"))

    def choose(self, selector, value):
        from selenium.webdriver.support.ui import Select

        Select(self.find(selector)).select_by_value(value)

    def drawn(self):
        """Waits until what was asked for before is on the screen."""
        self.driver.execute_async_script("const done = arguments[0];"
                                         "requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def choose_text(self, selector, text):
        from selenium.webdriver.support.ui import Select

        Select(self.find(selector)).select_by_visible_text(text)

    def keys(self):
        from selenium.webdriver.common.action_chains import ActionChains

        return ActionChains(self.driver, duration=40)

    def pose(self):
        """Of what is chosen in the world: x, y [m], heading [degrees]."""
        text = wait_until(lambda: self.text(".world .readout"), "the chosen robot's pose is shown")
        return [float(each) for each in re.findall(r"-?\d+\.\d+", text)[:3]]

    def errors(self):
        """What the browser's console has complained about since the last call."""
        return [each["message"] for each in self.driver.get_log("browser")
                if each["level"] == "SEVERE" and "WebSocket connection" not in each["message"]
                and "ERR_CONNECTION_REFUSED" not in each["message"]
                and "'beforeunload'" not in each["message"]]  # asked when a test leaves a page with unsaved text


class PageCase(unittest.TestCase):
    """One browser for all tests of a class; each has a run of its own."""

    nezumi = None
    size = (1500, 950)
    language = "en-US"

    @classmethod
    def setUpClass(cls):
        cls.page = Page(cls.size, cls.language)
        cls.addClassCleanup(cls.page.close)

    def system(self, *arguments, **named):
        system = System(self.nezumi, *arguments, **named)
        self.addCleanup(system.end)
        return system

    def open(self, *arguments, **named):
        """A run and its page."""
        system = self.system(*arguments, **named)
        self.page.open(system.url)
        self.addCleanup(self.page.driver.get, "about:blank")
        return system

    def check_modules(self, name, least):
        """Runs the checks of a file beside this one within the page; there are at least so many."""
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), name)) as file:
            checks = file.read()
        result = self.page.driver.execute_async_script(
            "const done = arguments[arguments.length - 1];"
            "(async () => {" + checks + "})().then((count) => done({ count }), (wrong) => done({ wrong: String(wrong.stack) }))")
        self.assertNotIn("wrong", result)
        self.assertGreaterEqual(result["count"], least)

    def stands(self, page=None):
        """Nothing moves any more."""
        page = page or self.page

        def is_still():
            before = page.pose()
            time.sleep(0.4)
            return math.dist(before[:2], page.pose()[:2]) < 0.002
        wait_until(is_still, "the robot stands")


def main(module):
    """Usage: FILE NEZUMI [TEST...]"""
    missing = why_not()
    if missing:
        print("SKIPPED: the browser's page was not tried in a real browser: %s" % missing)
        return 0
    PageCase.nezumi = os.path.abspath(sys.argv.pop(1))
    unittest.main(module, verbosity=2)
