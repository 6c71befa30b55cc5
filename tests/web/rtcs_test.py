"""RTCs of other programs in the diagram, in a real browser. Usage: rtcs_test.py NEZUMI [TEST...]"""

import os
import shutil
import socket
import subprocess
import sys
import tempfile
import threading

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

SYSTEM = """robot "mouse" { model = "raspimouse" }
rtm { export = "mouse", nameserver = "localhost:%d" }
%s"""


class Program:
    """A program that is told lines and prints lines."""

    def __init__(self, *words):
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.lines = []
        self.reader = threading.Thread(target=lambda: self.lines.extend(iter(self.process.stdout.readline, "")))
        self.reader.start()

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def heard(self, begin):
        return rig.wait_until(lambda: next((each.strip() for each in self.lines if each.startswith(begin)), None),
                              lambda: "%r is heard, not only %r" % (begin, self.lines))

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.reader.join()
        self.process.stdin.close()
        self.process.stdout.close()


def start_names():
    """A name service: the program, its port and its folder."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    folder = tempfile.mkdtemp(prefix="nezumi-names-")
    names = Program("omniNames", "-start", str(port), "-datadir", folder, "-ORBendPoint", "giop:tcp:127.0.0.1:%d" % port)
    rig.wait_until(lambda: any("Checkpointing completed" in each for each in names.lines), "the name service runs")
    return names, port, folder


def start_rtc(nezumi, port_number, *words):
    """A fake RTC: its name, port, type and direction."""
    rtc = Program(os.path.join(os.path.dirname(nezumi), "fake_rtc"), "localhost:%d" % port_number, *words)
    rtc.heard("ready")
    return rtc


class Rtcs(rig.PageCase):
    """RTCs in the diagram."""

    def setUp(self):
        names, self.port_number, folder = start_names()
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        self.addCleanup(names.kill)

    def rtc(self, *words):
        rtc = start_rtc(self.nezumi, self.port_number, *words)
        self.addCleanup(rtc.kill)
        return rtc

    def open_diagram(self, more=""):
        self.open(text=SYSTEM % (self.port_number, more))
        self.page.view("diagram")

    def node(self, name):
        return ".node[data-component=\"rtm:%s\"]" % name

    def until_state(self, name, state):
        self.page.until("document.querySelector('%s')?.classList.contains('%s')" % (self.node(name), state), "%s is %s" % (name, state))

    def wires(self):
        return self.page.js("return [...document.querySelectorAll('.wire-group')].map((each) => each.dataset.from + ' ' + each.dataset.to)")

    def until_wires(self, *wanted):
        rig.wait_until(lambda: sorted(self.wires()) == sorted(wanted), lambda: "the connections are %s, not %s" % (wanted, self.wires()))

    def drag(self, one, other):
        reach = '.port[data-port="%s"] .reach'
        self.page.drawn()
        self.page.keys().move_to_element(self.page.find(reach % one)).click_and_hold().move_by_offset(20, 10).perform()
        fitting = self.page.js("return [...document.querySelectorAll('.port.fits')].map((each) => each.dataset.port)")
        self.page.keys().move_to_element(self.page.find(reach % other)).release().perform()
        return fitting

    def choose(self, name):
        self.page.js("document.querySelector(`%s .title`).focus()" % self.node(name))

    def press(self, text):
        self.page.until("[...document.querySelectorAll('.chosen button')].some((each) => each.textContent === '%s' && !each.disabled)" % text,
                        "the button %s can be pressed" % text)
        self.page.js("[...document.querySelectorAll('.chosen button')].find((each) => each.textContent === arguments[0]).click()", text)

    def test_rtcs_are_shown_with_ports_and_connected_by_dragging(self):
        drives = self.rtc("Drives0", "out", "TimedVelocity2D", "out")
        self.rtc("Other0", "out", "TimedLong", "out")
        self.open_diagram()
        self.until_state("Drives0", "inactive")
        self.until_state("Other0", "inactive")
        self.assertEqual(self.page.all(".node[data-component='rtm:mouse0']"), [])  # it is the robot
        fitting = self.drag("rtm:Drives0.out", "mouse.target_velocity_in")
        self.assertEqual(fitting, ["mouse.target_velocity_in"])
        self.until_wires("rtm:Drives0.out mouse.target_velocity_in")
        drives.say("profiles mouse0 target_velocity_in")
        self.assertNotEqual(drives.heard("profiles"), "profiles")
        wire = ".wire-group[data-from='rtm:Drives0.out']"
        self.page.js("document.querySelector(`%s`).dispatchEvent(new MouseEvent('click', { bubbles: true }))" % wire)
        self.press("Disconnect")
        self.until_wires()
        self.assertEqual(self.page.errors(), [])

    def test_two_other_rtcs_are_connected_and_what_tools_connect_is_drawn(self):
        out = self.rtc("Out0", "out", "TimedLong", "out")
        self.rtc("In0", "in", "TimedLong", "in")
        self.open_diagram()
        self.until_state("Out0", "inactive")
        self.until_state("In0", "inactive")
        self.assertEqual(self.drag("rtm:Out0.out", "rtm:In0.in"), ["rtm:In0.in"])
        self.until_wires("rtm:Out0.out rtm:In0.in")
        self.page.js("document.querySelector('.wire-group').dispatchEvent(new MouseEvent('click', { bubbles: true }))")
        self.press("Disconnect")
        self.until_wires()
        out.say("link Out0 out In0 in")
        self.assertEqual(out.heard("linked"), "linked 0")
        self.until_wires("rtm:Out0.out rtm:In0.in")
        out.say("unlink In0 in")
        self.until_wires()

    def test_an_rtc_is_activated_deactivated_and_reset(self):
        peer = self.rtc("Peer0", "out", "TimedLong", "out")
        self.open_diagram()
        self.until_state("Peer0", "inactive")
        self.choose("Peer0")
        self.press("Activate")
        peer.heard("activated")
        self.until_state("Peer0", "active")
        self.press("Deactivate")
        self.until_state("Peer0", "inactive")
        peer.say("fail")
        self.until_state("Peer0", "error")
        self.press("Reset")
        self.until_state("Peer0", "inactive")
        self.press("Exit")
        self.page.until("document.querySelector('dialog.ask') !== null", "it asks")
        self.page.js("[...document.querySelectorAll('dialog.ask button')].find((each) => each.textContent === 'Exit').click()")
        peer.heard("exits")

    def test_the_configuration_of_an_rtc_is_set_by_its_widgets(self):
        peer = self.rtc("Peer0", "out", "TimedLong", "out")
        self.open_diagram()
        self.until_state("Peer0", "inactive")
        self.choose("Peer0")
        page = self.page
        page.until("document.querySelector('.rtc-card .slider input[type=range]')?.max === '2'", "it has a slider with its bounds")
        field = page.find(".rtc-card input.number")
        self.assertEqual(field.get_attribute("value"), "0.5")
        field.clear()
        field.send_keys("0.75\n")
        self.assertEqual(peer.heard("uses"), "uses default speed=0.75")
        page.choose(".rtc-card select", "fast")
        peer.heard("uses fast")
        page.until("document.querySelector('.rtc-card input.number').value === '1'", "the set's value is shown")

    def test_the_name_of_one_that_crashed_is_removed_and_connections_wait(self):
        peer = self.rtc("Peer0", "out", "TimedVelocity2D", "out")
        self.open_diagram('connect("rtm:Late0.out", "mouse.target_velocity_in")\n')
        self.until_state("Late0", "missing")
        self.assertEqual(self.wires(), ["rtm:Late0.out mouse.target_velocity_in"])
        self.assertIn("waits", self.page.find(".wire-group").get_attribute("class"))
        self.until_state("Peer0", "inactive")
        peer.kill()
        self.until_state("Peer0", "gone")
        self.choose("Peer0")
        self.press("Remove its name")
        self.page.until("document.querySelector('%s') === null" % self.node("Peer0"), "its name is gone")
        self.rtc("Late0", "out", "TimedVelocity2D", "out")
        self.until_state("Late0", "inactive")
        self.page.until("!document.querySelector('.wire-group').classList.contains('waits')", "the connection is made")


def why_not(nezumi):
    if not shutil.which("omniNames"):
        return "omniorb-nameserver is not installed"
    if not os.path.exists(os.path.join(os.path.dirname(os.path.abspath(nezumi)), "fake_rtc")):
        return "nezumi was built without omniORB"
    return None


if __name__ == "__main__":
    missing = why_not(sys.argv[1])
    if missing:
        print("SKIPPED: RTCs were not tried in a real browser: %s" % missing)
        sys.exit(0)
    sys.exit(rig.main(__name__))
