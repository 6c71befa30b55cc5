"""The protocol of the simulator mms: what is answered, and a solver that drives a mouse through a maze.

    mms_test.py NEZUMI"""

import os
import re
import socket
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "../../..")
sys.path.insert(0, os.path.join(ROOT, "bindings/agent"))
import mms_protocol as mms  # noqa: E402

NEZUMI = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 and os.path.exists(sys.argv[1]) else "nezumi"
SOLVER = [sys.executable, os.path.join(HERE, "mms_solver.py")]

# o---o---o---o
# |           |
# o   o---o   o
# |   |       |
# o---o---o---o
NUMBERS = """0 0 0 1 1 1
0 1 1 0 0 1
1 0 1 0 1 1
1 1 1 0 1 0
2 0 0 1 1 0
2 1 1 1 0 0
"""


class FakeMouse:
    def __init__(self):
        self.x, self.y, self.look, self.time, self.reset_seen = 1, 1, 2, 0.0, False
        self.driven = []

    def drive(self, halves):
        right, up = mms.STEPS[self.look]
        self.x, self.y = self.x + halves * right, self.y + halves * up
        self.time += halves
        self.driven.append(halves)
        return True

    def turn(self, eighths):
        self.look = (self.look + eighths) % 8
        return True

    def was_reset(self):
        return self.reset_seen

    def home(self):
        self.x, self.y, self.look, self.reset_seen = 1, 1, 2, False

    def now(self):
        return self.time


class ProtocolTest(unittest.TestCase):
    def setUp(self):
        self.mouse = FakeMouse()
        self.game = mms.Game(self.mouse, mms.FileWalls(NUMBERS), {(2, 1)})

    def say(self, *lines):
        return [self.game.answer(line) for line in lines]

    def test_the_size_and_the_walls_of_the_cell_are_answered(self):
        self.assertEqual(self.say("mazeWidth", "mazeHeight"), ["3", "2"])
        self.assertEqual(self.say("wallFront", "wallRight", "wallLeft", "wallBack"), ["false", "true", "true", "true"])
        self.assertEqual(self.say("wallFrontRight", "wallFrontLeft", "wallBackRight", "wallBackLeft"), ["true"] * 4)

    def test_walls_are_seen_so_many_half_steps_away(self):
        self.assertEqual(self.say("wallFront 1", "wallFront 2", "wallFront 3", "wallFront 9", "wallFront 0"),
                         ["false", "false", "true", "true", "false"])

    def test_a_move_into_a_wall_crashes_and_one_too_long_crashes_where_it_ends(self):
        self.assertEqual(self.say("moveForward 0", "moveForward -1", "moveForward x"), ["crash"] * 3)
        self.assertEqual(self.mouse.driven, [])
        self.assertEqual(self.say("moveForward 5", "moveForward"), ["crash", "crash"])
        self.assertEqual((self.mouse.driven, self.mouse.x, self.mouse.y), ([2], 1, 3))

    def test_half_steps_and_turns_of_45_degrees_lead_along_diagonals(self):
        self.assertEqual(self.say("moveForwardHalf", "turnRight45", "wallFront"), ["ack", "ack", "false"])
        self.assertEqual(self.say("turnLeft45", "moveForwardHalf", "turnRight"), ["ack"] * 3)
        self.assertEqual(self.say("moveForwardHalf 3", "turnRight45", "wallFront", "moveForwardHalf"),
                         ["ack", "ack", "false", "ack"])
        self.assertEqual((self.mouse.x, self.mouse.y, self.mouse.look), (5, 2, 7))
        self.assertEqual(self.say("turnLeft90", "turnRight90", "turnLeft"), ["ack"] * 3)

    def test_on_a_border_posts_stand_to_both_sides(self):
        self.say("moveForwardHalf")
        self.assertEqual(self.say("wallLeft", "wallRight", "wallFront", "wallBack"), ["true", "true", "false", "false"])

    def test_marks_have_no_answer_and_wrong_lines_none_either(self):
        self.assertEqual(self.say("setWall 0 0 w", "clearWall 0 0 w", "setColor 0 1 r", "clearColor 0 1", "clearAllColor",
                                  "setText 0 1 a b", "clearText 0 1", "clearAllText"), [""] * 8)
        for line in ("setWall 0 0 x", "setWall 0 0", "setWall a 0 n", "setColor 0 0 z", "setColor 0 0 rr", "setText 0",
                     "clearAllText 1", "hello", "", "turnLeft 2", "mazeWidth 1", "getStat", "getStat x", "wallFront 1 2"):
            self.assertIsNone(self.game.answer(line), line)
        self.say("setWall 9 9 n", "setText 9 9 x", "setColor -1 0 r")  # outside

    def test_marks_are_drawn(self):
        self.say("setWall 0 0 e", "setText 0 0 too long a text", "setText 2 1 a\tb", "setColor 1 1 G", "setWall 1 1 n",
                 "clearWall 1 0 w", "setWall 0 1 w")
        drawing = self.game.marks.drawing().splitlines()
        self.assertEqual(drawing[0], "o          o----------o          o")
        self.assertEqual(drawing[1], "|               G         a?b")
        self.assertEqual(drawing[3], " too long a")

    def test_statistics_are_those_of_the_protocol(self):
        self.assertEqual(self.say("getStat total-distance", "getStat best-run-turns", "getStat score"), ["0", "-1", "2000"])
        self.say("moveForward", "turnRight", "moveForward 2")
        self.assertEqual(self.say("getStat total-distance", "getStat total-turns", "getStat best-run-distance",
                                  "getStat best-run-effective-distance", "getStat score"), ["3", "1", "3", "3", "4.4"])
        self.assertEqual(self.game.times, [6.0])
        self.assertEqual(self.say("ackReset", "moveForward", "getStat current-run-effective-distance"),
                         ["ack", "ack", "16"])
        stats = mms.Stats()
        stats.move(5)
        self.assertEqual((stats.get("total-distance"), stats.get("total-effective-distance")), ("5", "3.5"))

    def test_the_reset_button_is_seen_until_it_is_acknowledged(self):
        self.mouse.reset_seen = True
        self.assertEqual(self.say("wasReset", "wasReset", "ackReset", "wasReset"), ["true", "true", "ack", "false"])


class RunTest(unittest.TestCase):
    def run_mms(self, *words, maze="behaviors/mazes/first.txt", solver=SOLVER):
        return subprocess.run([NEZUMI, "mms", "--maze", maze, *words, "--", *solver], cwd=ROOT, capture_output=True,
                              text=True, timeout=300)

    def test_a_solver_drives_the_mouse_to_the_middle(self):
        done = self.run_mms("--speed", "max", "--marks")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"solver ended with status 0 after \d+\.\d\d s\nruns to the goal \[s\]: \d+\.\d\d\n")
        self.assertIn("o---o", done.stdout)
        self.assertRegex(done.stderr, r"score \d+")

    def test_the_same_run_takes_the_same_time(self):
        self.assertEqual(self.run_mms("--speed", "max").stdout, self.run_mms("--speed", "max").stdout)

    def test_the_mouse_s_own_sensors_tell_the_same_walls(self):
        self.assertEqual(self.run_mms("--speed", "max", "--sensors").stdout, self.run_mms("--speed", "max").stdout)

    def test_a_reset_sets_the_mouse_down_at_the_start(self):
        done = self.run_mms("--speed", "max", solver=[*SOLVER, "reset"])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"runs to the goal \[s\]: \d+\.\d\d, \d+\.\d\d\n")

    def test_by_the_clock_the_mouse_drives_as_fast_as_it_is_told(self):
        done = self.run_mms("--speed", "20", "--no-web")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_what_is_wrong_is_told_in_one_line(self):
        def told(done):
            self.assertEqual(done.returncode, 2)
            return done.stderr
        self.assertEqual(told(self.run_mms(maze="none.txt")), "nezumi: mms: there is no file none.txt\n")
        self.assertRegex(told(self.run_mms("--speed", "max", solver=["./none"])),
                         r"^nezumi: mms: \./none can't be started: No such file or directory\n$")
        with tempfile.TemporaryDirectory() as folder:
            wrong = os.path.join(folder, "m.txt")
            with open(wrong, "w") as file:
                file.write("o---o\n|   |\n")
            self.assertRegex(told(self.run_mms(maze=wrong)), r"^nezumi: mms: .*m\.txt: expected 2 rows for each cell")
        self.assertEqual(told(self.run_mms("--hw", "--speed", "max")),
                         "nezumi: mms: --speed works only with a simulated mouse: leave out --speed or --hw\n")

    def test_a_solver_that_ends_at_once_has_not_been_at_the_goal(self):
        done = self.run_mms("--speed", "max", solver=["true"])
        self.assertEqual((done.returncode, re.findall("goal .*", done.stdout)), (1, ["goal [s]: none"]))

    def test_lines_that_are_no_commands_are_told_once(self):
        done = self.run_mms("--speed", "max", solver=["printf", "hello\\nhello\\n\\033[2J\\n"])
        self.assertEqual(done.stderr.splitlines(), ["nezumi: mms: no command, ignored: 'hello'",
                                                    "nezumi: mms: no command, ignored: '\\x1b[2J'"])


class HardwareTest(unittest.TestCase):
    def test_the_real_mouse_finds_its_way_by_its_sensors(self):
        fake = os.path.join(os.path.dirname(NEZUMI), "fake_mouse")
        if not os.path.exists(fake):
            self.skipTest("fake_mouse is not built beside nezumi")
        with tempfile.TemporaryDirectory() as folder:
            nodes, maze = os.path.join(folder, "nodes"), os.path.join(folder, "m.txt")
            os.mkdir(nodes)
            with open(maze, "w") as file:
                file.write("o---o---o---o\n|           |\no   o---o   o\n|   | G     |\no   o---o   o\n"
                           "| S |       |\no---o---o---o\n")
            mouse = subprocess.Popen([fake, nodes, folder + "/socket", ROOT + "/engine/robots/raspimouse.lua", maze],
                                     stdout=subprocess.PIPE, text=True)
            try:
                if mouse.stdout.readline() != "ready\n":
                    self.skipTest("the fake nodes could not be mounted: is FUSE to be had here?")
                with socket.socket(socket.AF_UNIX) as control:
                    control.connect(folder + "/socket")
                    with control.makefile("rw") as lines:
                        lines.write("place 0 0 1.5707963\n")
                        lines.flush()
                        lines.readline()
                done = subprocess.run([NEZUMI, "mms", "--maze", maze, "--hw", "--dev-root", nodes, "--no-web", "--", *SOLVER],
                                      cwd=ROOT, capture_output=True, text=True, timeout=120)
            finally:
                mouse.terminate()
                mouse.wait()
                mouse.stdout.close()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"runs to the goal \[s\]: \d+\.\d\d\ndistance 6, ")


if __name__ == "__main__":
    unittest.main()
