"""Runs a solver that was written for the simulator mms: its lines on standard output are answered, and what it orders is
driven by a mouse with true dynamics. `nezumi mms` starts this program with its options as one JSON object.

The protocol is that of https://github.com/mackorone/mms, in its README."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "python"))
import nezumi  # noqa: E402

STEPS = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))  # eighths from east
SIDES = {"n": 2, "e": 0, "s": 6, "w": 4}
COLORS = "kbacgorwyBCAGRY"
LONGEST_TEXT = 10
LONGEST_MOVE = 20.0  # [s] for one that does not come to its end, and for each half cell a second more
COUNTED = {"moveForward", "moveForwardHalf"} | {
    "wall" + side for side in ("Front", "Right", "Left", "Back", "FrontRight", "FrontLeft", "BackRight", "BackLeft")}
LOOKS = {"wallFront": 0, "wallFrontLeft": 1, "wallLeft": 2, "wallBackLeft": 3, "wallBack": 4, "wallBackRight": 5,
         "wallRight": 6, "wallFrontRight": 7}
TURNS = {"turnRight": -2, "turnRight90": -2, "turnLeft": 2, "turnLeft90": 2, "turnRight45": -1, "turnLeft45": 1}
PENALTY = 15  # of a reset, in effective distance
UNSOLVED = 2000


class Over(Exception):
    """The run can't go on; the text says why."""


def whole(text):
    """A number as mms reads it: 0 for anything else."""
    try:
        return int(text)
    except ValueError:
        return 0


class FileWalls:
    """Walls as the maze's file has them: what the simulator mms answers."""

    def __init__(self, text):
        self._cells = {}
        for line in text.splitlines():
            x, y, north, east, south, west = (int(word) for word in line.split())
            self._cells[x, y] = {0: east, 2: north, 4: west, 6: south}
        self.width = 1 + max(x for x, _ in self._cells)
        self.height = 1 + max(y for _, y in self._cells)

    def cell(self, x, y, side):
        cell = self._cells.get((x, y))
        return bool(cell and cell[side])


class SeenWalls:
    """Walls as the mouse's sensors have seen them; one that it has not come to yet is none."""

    def __init__(self, walls, console):
        self.width, self.height, self._console = walls.width, walls.height, console

    def cell(self, x, y, side):
        if not (0 <= x < self.width and 0 <= y < self.height):
            return False
        return bool(self._console.eval("driver:walls(%d, %d)" % (x + 1, y + 1))[side // 2])


def is_wall(walls, x, y, look):
    """Whether something stands half a step from a place in half cells: odd are the middles of cells, even the borders."""
    if x % 2 and y % 2:
        return True if look % 2 else walls.cell(x // 2, y // 2, look)
    if look % 2 == 0:
        # On a border a post stands to both sides, and the middle of a cell lies ahead and behind.
        return look in ((2, 6) if x % 2 == 0 else (0, 4))
    right, up = STEPS[look]
    if x % 2 == 0:  # the wall between this cell and the one above or below
        return walls.cell(x // 2 - (right < 0), y // 2, 2 if up > 0 else 6)
    return walls.cell(x // 2, y // 2 - (up < 0), 0 if right > 0 else 4)


class Stats:
    """Distances in cells and turns, as the README of mms says."""

    def __init__(self):
        self.total = [0.0, 0, 0.0]  # distance, turns, effective distance
        self.current = [0.0, 0, 0.0]
        self.best = None
        self._penalty = 0
        self._runs = False

    def _add(self, place, amount):
        self.total[place] += amount
        if self._runs:
            self.current[place] += amount

    def move(self, cells):
        self._add(0, cells)
        self._add(2, cells / 2 + 1 if cells > 2 else cells)

    def turn(self):
        self._add(1, 1)

    def leaves_start(self):
        self.current = [0.0, 0, float(self._penalty)]
        self.total[2] += self._penalty
        self._penalty, self._runs = 0, True

    def reaches_goal(self):
        if self._runs and (self.best is None or self.current[1] + self.current[2] < self.best[1] + self.best[2]):
            self.best = list(self.current)
        self._runs = False

    def reset(self):
        self._penalty, self._runs = PENALTY, False

    def ends(self):
        self._runs = False

    def score(self):
        if self.best is None:
            return float(UNSOLVED)
        return self.best[1] + self.best[2] + 0.1 * (self.total[1] + self.total[2])

    def get(self, name):
        """The answer to getStat; None if there is no such value."""
        if name == "score":
            return "%g" % self.score()
        for begin, values in (("total-", self.total), ("best-run-", self.best), ("current-run-", self.current)):
            for place, end in enumerate(("distance", "turns", "effective-distance")):
                if name == begin + end:
                    return "-1" if values is None else "%g" % values[2] if place == 2 else "%d" % values[place]
        return None


class Marks:
    """What the solver shows: walls, colours and texts of cells."""

    def __init__(self, walls):
        self._maze, self.walls, self.colors, self.texts = walls, set(), {}, {}
        self.changed = False

    def has(self, x, y):
        return 0 <= x < self._maze.width and 0 <= y < self._maze.height

    def wall(self, x, y, side, stands):
        if self.has(x, y):
            right, up = STEPS[SIDES[side]]
            for each in ((x, y, SIDES[side]), (x + right, y + up, (SIDES[side] + 4) % 8)):
                (self.walls.add if stands else self.walls.discard)(each)

    def drawing(self):
        """The walls and texts as lines; a colour without a text is its letter."""
        width = max([3] + [len(text) for text in self.texts.values()])
        lines = []
        for y in range(self._maze.height - 1, -1, -1):
            cells = range(self._maze.width)
            lines.append("o" + "o".join(("-" if (x, y, 2) in self.walls else " ") * width for x in cells) + "o")
            line = "|" if (0, y, 4) in self.walls else " "
            for x in cells:
                line += self.texts.get((x, y), self.colors.get((x, y), "")).center(width)
                line += "|" if (x, y, 0) in self.walls else " "
            lines.append(line)
        lines.append("o" + "o".join(("-" if (x, 0, 6) in self.walls else " ") * width for x in cells) + "o")
        return "\n".join(line.rstrip() for line in lines)


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


class Game:
    """One line of the solver after the other."""

    def __init__(self, mouse, walls, goals):
        self._mouse, self._walls, self._goals = mouse, walls, goals
        self.stats, self.marks = Stats(), Marks(walls)
        self.times = []  # [s] from leaving the start to a goal
        self._left = None

    def answer(self, line):
        """The answer; "" for none, None if it is no command."""
        words = line.split()
        name = words[0] if words else ""
        if name in ("setWall", "clearWall", "setColor", "clearColor", "clearAllColor", "setText", "clearText",
                    "clearAllText"):
            return self._mark(name, words, line)
        if len(words) > 2 or (len(words) == 2 and name not in COUNTED and name != "getStat"):
            return None
        count = whole(words[1]) if len(words) == 2 else 1
        if name in LOOKS:
            return self._told(self._ahead((self._mouse.look + LOOKS[name]) % 8, count))
        if name in ("moveForward", "moveForwardHalf"):
            return self._move(count * 2 if name == "moveForward" else count, name == "moveForward")
        if name in TURNS:
            self.stats.turn()
            return "ack" if self._mouse.turn(TURNS[name]) else "crash"
        if name == "getStat":
            return self.stats.get(words[1]) if len(words) == 2 else None
        if name == "ackReset":
            self._mouse.home()
            self.stats.reset()
            self._left = None
            return "ack"
        simple = {"mazeWidth": lambda: str(self._walls.width), "mazeHeight": lambda: str(self._walls.height),
                  "wasReset": lambda: self._told(self._mouse.was_reset())}
        return simple[name]() if name in simple else None

    @staticmethod
    def _told(value):
        return "true" if value else "false"

    def _ahead(self, look, halves):
        """Whether a wall stands so many half steps away, or nearer."""
        right, up = STEPS[look]
        x, y = self._mouse.x, self._mouse.y
        for step in range(max(halves, 1)):
            if is_wall(self._walls, x + step * right, y + step * up, look):
                return True
        return False

    def _cell(self):
        # On the outer border it is the cell within.
        return (min(self._mouse.x // 2, self._walls.width - 1), min(self._mouse.y // 2, self._walls.height - 1))

    def _move(self, halves, is_whole):
        if halves < 1 or self._ahead(self._mouse.look, 1):
            return "crash"
        free = 1
        while free < halves and not self._ahead(self._mouse.look, free + 1):
            free += 1
        if self._cell() == (0, 0):
            self.stats.leaves_start()
            self._left = self._mouse.now()
        self.stats.move(halves / 2)
        arrived = self._mouse.drive(free)
        if self._cell() in self._goals:
            self.stats.reaches_goal()
            if self._left is not None:
                self.times.append(self._mouse.now() - self._left)
            self._left = None
        elif self._cell() == (0, 0):
            self.stats.ends()
        return "ack" if arrived and free == halves else "crash"

    def _mark(self, name, words, line):
        marks = self.marks
        if name.startswith("clearAll"):
            if len(words) != 1:
                return None
            (marks.colors if name == "clearAllColor" else marks.texts).clear()
            return ""
        count = {"setWall": 4, "clearWall": 4, "setColor": 4, "clearColor": 3, "clearText": 3}.get(name, 0)
        if len(words) < 3 or (count and len(words) != count):
            return None
        try:
            x, y = int(words[1]), int(words[2])
        except ValueError:
            return None
        if name in ("setWall", "clearWall"):
            if words[3] not in SIDES:
                return None
            marks.wall(x, y, words[3], name == "setWall")
        elif name == "setColor":
            if words[3] not in COLORS or len(words[3]) != 1:
                return None
            if marks.has(x, y):
                marks.colors[x, y] = words[3]
        elif name == "setText":
            text = (line.split(" ", 3) + [""])[3][:LONGEST_TEXT]
            if marks.has(x, y):
                marks.texts[x, y] = "".join(sign if " " <= sign <= "~" else "?" for sign in text)
        else:
            (marks.colors if name == "clearColor" else marks.texts).pop((x, y), None)
        marks.changed = True
        return ""


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
