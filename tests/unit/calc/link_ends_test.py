"""How the spreadsheet's link begins and ends, with the real LibreOffice Calc. Usage: link_ends_test.py NEZUMI"""

import os
import signal
import stat
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig


class LinkEndsTest(rig.OfficeCase):
    """What becomes of sheets and robots."""

    def test_the_end_of_the_system_is_shown_and_ends_the_link(self):
        system = self.system(rig.ALONE)
        link = self.link(system, rig.CONTROLLER)
        link.shows("B6", "live")
        system.end()
        self.assertEqual(link.wait(), 0)
        for cell in ("B1", "B3", "B6"):
            self.assertEqual(link.cell(cell).getString(), system.name + " has ended")
        self.assertIn("nezumi: %s has ended\n" % system.name, link.said())

    def test_ctrl_c_ends_the_link_and_not_the_office(self):
        system = self.system(rig.ALONE)
        link = self.link(system, rig.CONTROLLER)
        link.process.send_signal(signal.SIGINT)
        self.assertEqual(link.wait(), 0)
        self.assertEqual(link.cell("B6").getString(), "the link has ended")
        self.assertEqual(system.ask("controller.status"), '"ACTIVE"')

    def test_the_robot_stops_when_the_sheet_is_closed(self):
        system, link = self.driving()
        link.document.close(True)
        self.assertEqual(link.wait(), 0)
        self.assertIn("nezumi: the sheet was closed\n", link.said())
        self.stops(system)

    def test_the_robot_stops_when_the_link_is_killed(self):
        system, link = self.driving()
        link.process.kill()
        link.wait()
        self.stops(system)

    def test_the_pipe_is_its_user_s_alone(self):
        system = self.system(rig.ALONE)
        self.link(system, rig.CONTROLLER)
        pipes = [pipe for pipe in rig.pipes() if "_nezumi-" in pipe]
        self.assertTrue(pipes)
        for pipe in pipes:
            self.assertEqual(stat.S_IMODE(os.stat(pipe).st_mode) & 0o022, 0, "who can't write can't connect")

    def driving(self):
        """A mouse that a cell drives."""
        system = self.system(rig.MOUSE)
        link = self.link(system, rig.DRIVE)
        link.put("C2", 0.1)
        rig.wait_until(lambda: system.ask("mouse.truth.velocity.vx > 0.09") == "true", link.text)
        return system, link

    def stops(self, system):
        """0.5 s of simulated time after the last message, and the way to brake."""
        at = float(system.ask("mouse.target_velocity_in.tm"))
        rig.wait_until(lambda: float(system.ask("now()")) > at + 1.5, "time passes")
        self.assertEqual(system.ask(rig.STANDS), "true")
        self.assertEqual(float(system.ask("mouse.target_velocity_in.tm")), at)


class OwnOfficeTest(unittest.TestCase):
    """Where the office begins or ends with the link."""

    def setUp(self):
        self.nezumi = rig.OfficeCase.nezumi
        self.place = rig.Place(self.nezumi)
        self.addCleanup(self.place.remove)
        self.system = rig.System(self.place, rig.MOUSE)

    def test_the_robot_stops_when_the_office_is_killed(self):
        office = rig.Office(self.place)
        link = rig.Link(office, self.system, office.write_sheet("drive.ods", rig.DRIVE))
        link.put("C2", 0.1)
        rig.wait_until(lambda: self.system.ask("mouse.truth.velocity.vx > 0.09") == "true", link.text)
        office.kill()
        self.assertEqual(link.wait(), 0)
        self.assertIn("nezumi: LibreOffice has ended\n", link.said())
        LinkEndsTest.stops(self, self.system)

    def test_without_an_office_one_is_started_and_ends_with_a_link_that_nobody_sees(self):
        link = self.place.start([self.nezumi, "calc", "--headless", "--profile", self.place.path("own")], "own")
        rig.wait_until(lambda: "is linked with" in self.place.said("own"), lambda: self.place.said("own"))
        link.terminate()
        self.assertEqual(link.wait(rig.PATIENCE), 0)
        lock = self.place.path("own", ".lock")
        rig.wait_until(lambda: not os.path.exists(lock), "the office ends")

    def test_what_is_missing_is_said_with_what_to_install(self):
        needs = "sudo apt install --no-install-recommends libreoffice-calc python3-uno\n"
        bare = dict(self.place.environment, PATH=self.place.folder)
        self.refuses([self.nezumi, "calc"], bare, "nezumi: LibreOffice Calc is not installed: " + needs)
        link = os.path.join(os.path.dirname(__file__), "../../../bindings/calc/link.py")
        words = ["/usr/bin/python3", "-BEsS", link, "--socket", "0", "--system", "it", "--rate", "10"]
        self.refuses(words, None, "nezumi: the spreadsheet link needs LibreOffice Calc: " + needs)

    def test_files_that_are_no_spreadsheet_are_refused(self):
        missing = self.place.path("none.ods")
        said = "nezumi: calc: there is no file %s: leave it out to make a new sheet\n" % missing
        self.refuses([self.nezumi, "calc", missing], None, said)
        text = self.place.write("text.ods", "\x01 no spreadsheet")
        words = [self.nezumi, "calc", "--headless", "--profile", self.place.path("own"), text]
        self.refuses(words, None, "nezumi: LibreOffice can't open %s\n" % text)

    def test_what_can_not_be_done_is_refused(self):
        rate = "nezumi: --rate: expected a number from 4 to 25, got '1'; see nezumi calc --help\n"
        self.refuses([self.nezumi, "calc", "--rate", "1"], None, rate)
        for name, near in (
            ("mouse.ir_sensor_outt", "mouse has no port 'ir_sensor_outt' (did you mean 'ir_sensor_out'?)"),
            ("moose", "there is no component 'moose' (did you mean 'mouse'?)"),
        ):
            self.refuses([self.nezumi, "calc", "--headless", "--port", name], None, "nezumi: --port: %s\n" % near)
        other = "nezumi: no system 'it' is running; running: %s (process %d)\n"
        other %= (self.system.name, self.system.process.pid)
        self.refuses([self.nezumi, "calc", "--system", "it"], None, other)
        bare = {name: value for name, value in self.place.environment.items() if not name.endswith("DISPLAY")}
        self.refuses(
            [self.nezumi, "calc"], bare, "nezumi: there is no display to show Calc on; --headless does without\n"
        )

    def refuses(self, words, environment, text):
        done = subprocess.run(
            words,
            env=environment or self.place.environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=rig.PATIENCE,
            check=False,
        )
        self.assertIn(text, done.stderr.decode())
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    rig.main()
