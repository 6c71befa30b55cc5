"""The protocol of the simulator mms, a line at a time: queries of walls, movements, marks, resets, statistics. It is that of
https://github.com/mackorone/mms, in its README."""

STEPS = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))  # eighths from east
SIDES = {"n": 2, "e": 0, "s": 6, "w": 4}
COLORS = "kbacgorwyBCAGRY"
LONGEST_TEXT = 10
COUNTED = {"moveForward", "moveForwardHalf"} | {
    "wall" + side for side in ("Front", "Right", "Left", "Back", "FrontRight", "FrontLeft", "BackRight", "BackLeft")}
LOOKS = {"wallFront": 0, "wallFrontLeft": 1, "wallLeft": 2, "wallBackLeft": 3, "wallBack": 4, "wallBackRight": 5,
         "wallRight": 6, "wallFrontRight": 7}
TURNS = {"turnRight": -2, "turnRight90": -2, "turnLeft": 2, "turnLeft90": 2, "turnRight45": -1, "turnLeft45": 1}
PENALTY = 15  # of a reset, in effective distance
UNSOLVED = 2000


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


class Game:
    """One line of the solver after the other."""

    def __init__(self, mouse, walls, goals):
        self._mouse, self._walls, self._goals = mouse, walls, goals
        self.stats, self.marks = Stats(), Marks(walls)
        self.times = []  # [s] from leaving the start to a goal
        self._left = None

    def answer(self, line):
        """The answer; "" for none, None if it is not a command."""
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
