"""The playground in Firefox: its engine compiles WebAssembly in another way, and the numbers are the same.
Usage: firefox_test.py NEZUMI [TEST...]"""

import os
import shutil
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig
from firefox import Firefox
from playground_test import BUILT, Server

# A worker that runs a system as bindings/wasm/node does, in a page of its own.
WORKER = """importScripts("nezumi.js", "engine_files.js");
onmessage = async ({ data: { files, system } }) => {
  const lines = [];
  const engine = await nezumi_engine({ noInitialRun: true, print: (line) => lines.push(line), printErr: (line) => lines.push(line) });
  write_files(engine, "/share/nezumi", files);
  engine.FS.chdir("/share/nezumi");
  engine.callMain(["run", system, "--headless", "--speed", "max", "--duration", "2", "--trace-hash"]);
  postMessage(lines.at(-1));
};
"""


def golden():
    with open(os.path.join(rig.ROOT, "tests/golden/hashes.txt")) as file:
        return dict(line.split() for line in file)


class InFirefox(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server({"/hashes.html": "<!doctype html><title>hashes</title>", "/hashes.js": WORKER})
        cls.addClassCleanup(cls.server.close)
        cls.browser = Firefox()
        cls.addClassCleanup(cls.browser.close)

    def wait(self, code, what, within=rig.PATIENCE):
        return rig.wait_until(lambda: self.browser.js("return " + code), what, within)

    def test_the_traces_of_all_systems_are_those_of_the_program(self):
        self.browser.open(self.server.url + "hashes.html")
        found = self.browser.wait_for("""
          const files = await (await fetch("files.json")).json();
          const hash_of = (name) => new Promise((resolve) => {
            const worker = new Worker("hashes.js");
            worker.onmessage = ({ data }) => { worker.terminate(); resolve(data); };
            worker.postMessage({ files, system: `behaviors/systems/${name}.lua` });
          });
          const found = {};
          for (const name of args[0]) found[name] = (await hash_of(name)).split(" ").at(-1);
          return found;""", sorted(golden()))
        self.assertEqual(found, golden())

    def test_a_robot_moves_in_the_page(self):
        self.browser.open(self.server.url + "#run=left_hand")
        self.wait("document.querySelector('.dot.open') !== null", "the engine has answered", 60)
        self.wait("/[1-9]\\.\\d\\d s/.test(document.body.innerText)", "time passes", 60)
        self.browser.js("""const area = document.querySelector(".console textarea");
                           area.value = "print('moved ' .. tostring(math.abs(mouse.truth.velocity.vx) + math.abs(mouse.truth.velocity.va) > 0.01))";
                           area.dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));""")
        self.wait("[...document.querySelectorAll('.console .output pre')].some((each) => each.textContent === 'moved true')",
                  lambda: "the robot moves; it shows %r" % self.browser.js("return document.querySelector('.console').innerText"))


if __name__ == "__main__":
    if not os.path.exists(os.path.join(BUILT, "run.html")):
        print("SKIPPED: the engine for web pages is not built (.ci/web)")
        sys.exit(0)
    if not shutil.which("firefox-esr"):
        print("SKIPPED: the playground was not tried in Firefox: firefox-esr is not installed")
        sys.exit(0)
    sys.argv.pop(1)
    unittest.main(verbosity=2)
