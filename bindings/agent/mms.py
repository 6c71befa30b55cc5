"""Runs a solver that was written for the simulator mms: its lines on standard output are answered, and what it orders is
driven by a mouse with true dynamics. `nezumi mms` starts this program with its options as one JSON object."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

from client import nezumi
from mms_protocol import STEPS, FileWalls, Game, SeenWalls

LONGEST_MOVE = 20.0  # [s] for one that does not come to its end, and for each half cell a second more


class Over(Exception):
    """The run can't go on; the text says why."""


class Mouse:
    """The mouse of the running system: where the solver believes it to be, and how it gets elsewhere."""

    def __init__(self, console, paced, is_real):
        self._console, self._paced, self._is_real = console, paced, is_real
        self.x, self.y, self.look = 1, 1, 2  # in half cells; eighths from east
        console.run("function mms_wait(ticks)\n"
                    "  for _ = 1, ticks, 2 do\n"
                    "    if not driver.state.busy or driver.status ~= \"ACTIVE\" then return true end\n"
                    "    step(2)\n"
                    "  end\n"
                    "  return not driver.state.busy\n"
                    "end")
        self._rate = 100
        self._wait(LONGEST_MOVE)

    def _wait(self, seconds):
        """True when the movement is over, False when it does not come to its end."""
        if not self._paced:
            ended = self._console.eval("mms_wait(%d)" % (seconds * self._rate), timeout=120)
        else:
            end = self.now() + seconds  # of the run's time, which stands while it is paused
            while not (ended := self._console.eval("not driver.state.busy or driver.status ~= \"ACTIVE\"")):
                if self.now() > end:
                    break
                time.sleep(0.01)
        error = self._console.eval("driver.error")
        if error:
            raise Over("the mouse's behaviour has failed: %s" % error)
        return bool(ended)

    def drive(self, halves):
        self._console.run("driver:drive(%d)" % halves)
        right, up = STEPS[self.look]
        self.x, self.y = self.x + halves * right, self.y + halves * up
        return self._wait(LONGEST_MOVE + halves)

    def turn(self, eighths):
        self._console.run("driver:turn(%d)" % eighths)
        self.look = (self.look + eighths) % 8
        return self._wait(LONGEST_MOVE)

    def was_reset(self):
        return bool(self._console.eval("driver.state.was_reset == true"))

    def home(self):
        if self._is_real:
            print("Set the mouse down at the start, then press Enter here.", file=sys.stderr, flush=True)
            sys.stdin.readline()
        else:
            self._console.run("teleport(\"mouse\", { x = 0, y = 0, heading = math.pi / 2 })")
        self._console.run("driver:home()")
        self.x, self.y, self.look = 1, 1, 2
        self._wait(LONGEST_MOVE)

    def now(self):
        return self._console.eval("now()")


def goals_of(text, walls):
    """The cells that the file marks, else those in the middle."""
    rows = text.splitlines()
    marked = {(column, walls.height - 1 - line // 2) for line in range(1, len(rows), 2)
              for column in range(walls.width) if rows[line][4 * column + 2] == "G"}
    middle = {(x, y) for x in {(walls.width - 1) // 2, walls.width // 2}
              for y in {(walls.height - 1) // 2, walls.height // 2}}
    return marked or middle


def told(program, *words):
    """What nezumi prints. Its error is the end."""
    done = subprocess.run([program, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise Over(done.stderr.strip().removeprefix("nezumi: "))
    return done.stdout


def started(options):
    """The console of the running system, and whether its time is the clock's."""
    words = ["--set", "maze=" + os.path.abspath(options["maze"]), "--set", "robot=" + options["robot"],
             "--set", "thickness=%g" % options["thickness"], *options["run"]]
    if not options["paced"]:
        return nezumi.start(options["system"], *words, program=options["program"], timeout=30)
    process = subprocess.Popen([options["program"], "run", options["system"], *words], stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL)
    end = time.monotonic() + 30
    while process.poll() is None and time.monotonic() < end:
        if any(each.process == process.pid for each in nezumi.systems()):
            console = nezumi.attach(process.pid)
            console.process = process
            return console
        time.sleep(0.02)
    if process.poll() is None:
        process.terminate()
    raise Over("the run did not begin")  # it has said why


def watch_reset(console_of):
    """Enter in the terminal is the reset button of mms."""
    def watch():
        while sys.stdin.readline():
            try:
                with nezumi.attach(console_of) as console:
                    console.run("driver:press_reset()")
            except nezumi.Error:
                return
    threading.Thread(target=watch, daemon=True).start()


def play(options):
    program = options["program"]
    walls = FileWalls(told(program, "maze", options["maze"], "--as", "num"))
    goals = goals_of(told(program, "maze", options["maze"], "--as", "txt"), walls)
    console = started(options)
    solver = None
    try:
        mouse = Mouse(console, options["paced"], options["real"])
        game = Game(mouse, SeenWalls(walls, console) if options["sensors"] else walls, goals)
        try:
            solver = subprocess.Popen(options["solver"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                      errors="replace", bufsize=1)
        except OSError as wrong:
            raise Over("%s can't be started: %s" % (options["solver"][0], wrong.strerror)) from None
        if options["paced"] and not options["real"] and sys.stdin.isatty():
            watch_reset(console.process.pid)
        refused = set()
        for line in solver.stdout:
            line = line.rstrip("\r\n")
            answer = game.answer(line)
            if answer is None and line.strip() and line not in refused and len(refused) < 20:
                refused.add(line)
                print("nezumi: mms: no command, ignored: %.200s" % ascii(line), file=sys.stderr)
            if answer:
                try:
                    solver.stdin.write(answer + "\n")
                    solver.stdin.flush()
                except BrokenPipeError:
                    break
        status = solver.wait()
        summary(game, mouse, status, options)
        return 0 if status == 0 and game.times else 1
    finally:
        if solver and solver.poll() is None:
            solver.kill()
            solver.wait()
        process = getattr(console, "process", None)
        console.close()
        if process is not None:
            process.send_signal(signal.SIGINT)
            process.wait()


def summary(game, mouse, status, options):
    if options["marks"]:
        print(game.marks.drawing())
    print("solver ended with status %d after %.2f s" % (status, mouse.now()))
    print("runs to the goal [s]: %s" % (", ".join("%.2f" % seconds for seconds in game.times) or "none"))
    stats = game.stats
    print("distance %g, turns %d, effective distance %g, score %g"
          % (stats.total[0], stats.total[1], stats.total[2], stats.score()))


def main():
    try:
        return play(json.loads(sys.argv[1]))
    except (Over, nezumi.Error) as wrong:
        print("nezumi: mms: %s" % " ".join(str(wrong).split()), file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 1


if __name__ == "__main__":
    sys.exit(main())
