"""The tables of a sheet: where cells say which ports they are linked with.

A table begins with the cells `Port` and `State` beside each other, and goes down to the first row without a port. Right
of `State` are the values; headings there, as far as they go, say how many columns, and which field each is.
"""

import re

from values import Wrong, message_of

PORT, STATE, LINK = "Port", "State", "nezumi"
MOST_COLUMNS = 64  # of values, where no headings say how many
WATCH, LOG, PLAY = "watch", "log", "play"  # words before a port
USUAL_ROWS, MOST_ROWS = 1000, 10000  # of a log
USUAL_PERIOD = 0.1  # [s] of simulated time between two rows that are played
OPTIONS = {
    LOG: "every 0.5 s, rows 1000",
    PLAY: "every 0.5 s, repeating",
}


class Row:
    """A row of a table: a port, and the cells of its values."""

    def __init__(self, sheet, row, column, text, headings, limit):
        self.sheet, self.row, self.column = sheet, row, column
        self.headings, self.limit = headings, limit
        self.problem = None
        found = re.fullmatch(r"(?:(watch|log|play)\s+)?([A-Za-z_]\w*\.[A-Za-z_]\w*)(\s.*)?", text.strip(), re.ASCII)
        self.word = found[1] if found else None
        self.path = found[2] if found else None
        self.every, self.rows, self.repeats = None, USUAL_ROWS, False
        if found:
            self._read_options((found[3] or "").strip())
        else:
            self.problem = "expected a port, such as mouse.ir_sensor_out"

    def __eq__(self, other):
        return vars(self) == vars(other)

    @property
    def values_column(self):
        return self.column + 2

    @property
    def grows(self):
        """It takes all rows below it."""
        return self.word in (LOG, PLAY)

    def columns(self, kind, message):
        """(column, part) of each of its values."""
        if self.headings:
            parts = kind.columns(self.headings)
        else:
            parts = kind.parts(self.limit if message is None else min(self.limit, kind.length(message)))
        return [(self.values_column + i, part) for i, part in enumerate(parts) if part is not None]

    def _read_options(self, text):
        while text and not self.problem:
            found = re.match(r"(?:every\s+(\d*\.?\d+)\s*s|rows\s+(\d{1,9})|(repeating))(?:[\s,]+|$)", text, re.ASCII)
            period, rows, repeats = found.groups() if found else (None, None, None)
            if self.grows and period and float(period) > 0:
                self.every = float(period)
            elif self.word == LOG and rows and 1 <= int(rows) <= MOST_ROWS:
                self.rows = int(rows)
            elif self.word == PLAY and repeats:
                self.repeats = True
            else:
                self.problem = "expected %s, got '%s'" % (OPTIONS.get(self.word, "only a port"), text[:40])
                return
            text = text[found.end() :]


def rows_of(sheet, data):
    """All rows of the tables in a sheet's data, and whether the sheet tells of the link itself: A1 asks for it, B1 is
    for the answer."""
    rows = []
    for at, line in enumerate(data):
        if PORT not in line:
            continue
        begins = [c for c in range(len(line) - 1) if line[c] == PORT and line[c + 1] == STATE]
        for begin, next_begin in zip(begins, begins[1:] + [None]):
            rows += _rows_below(sheet, data, at, begin, next_begin)
    return rows, bool(data) and data[0][0] == LINK


def _rows_below(sheet, data, heading_row, begin, next_begin):
    line = data[heading_row]
    headings = []
    for cell in line[begin + 2 : next_begin]:
        if cell == "" or cell is None:
            break
        headings.append(cell if isinstance(cell, str) else "%g" % cell)
    limit = MOST_COLUMNS if next_begin is None else next_begin - begin - 2
    rows = []
    for at in range(heading_row + 1, len(data)):
        cell = data[at][begin]
        if cell == "" or cell == PORT:
            break
        text = cell if isinstance(cell, str) else "?"
        row = Row(sheet, at, begin, text, headings, limit)
        if rows and rows[-1].grows:
            row.word, row.problem = None, "the port above takes these rows: give this one a table of its own"
        rows.append(row)
    return rows


def address(row, column):
    """The name of a cell: (0, 0) is A1."""
    letters = ""
    column += 1
    while column > 0:
        column, letter = divmod(column - 1, 26)
        letters = chr(ord("A") + letter) + letters
    return letters + str(row + 1)


class Linked:
    """A row together with what the system says of its port: what it is fed, and what its cells are to show."""

    def __init__(self, row):
        self.row = row
        self.state = row.problem
        self.feeds = None
        self.shows = None  # [(column, value)]

    def read(self, line, seen, types, taken):
        """Before a refresh: takes from the cells what the port is fed, when it is an in-port. `taken` are the ports
        that rows above feed."""
        row = self.row
        if row.word == WATCH or not self.takes(seen, types, taken):
            return
        try:
            cells = [
                (address(row.row, column), part, line[column] if column < len(line) else "")
                for column, part in row.columns(types[seen["type"]], None)
            ]
            self.feeds = message_in(cells)
        except Wrong as wrong:
            self.state = str(wrong)

    def takes(self, seen, types, taken):
        """Whether it is this row that feeds its port, an in-port; the state says why not."""
        row = self.row
        if row.problem or not seen or seen.get("direction") != "in":
            return False
        if row.path in taken:
            self.state = "%s feeds it already" % taken[row.path]
            return False
        taken[row.path] = address(row.row, row.column)
        if types[seen["type"]].has_bytes:
            self.state = "bytes do not come from cells"
            return False
        return True

    def show(self, seen, types):
        """After a refresh: what state and values are to show."""
        row = self.row
        if self.state:
            return
        if "type" not in seen:
            self.state = seen.get("error", "no answer")
            return
        if seen["direction"] == "in" and not row.word == WATCH:
            self.state = self._state_of_feeding(seen)
            return
        kind = types[seen["type"]]
        try:
            columns = row.columns(kind, seen["value"])
        except Wrong as wrong:
            self.state = str(wrong)
            return
        self.shows = [(column, part.of(seen["value"]) if seen["came"] else None) for column, part in columns]
        self.state = _state_of_watching(seen, kind, len(columns))

    def _state_of_feeding(self, seen):
        if self.feeds is None and not seen.get("error") and not seen["override"]:
            return "not fed"
        return state_of_fed(seen, "sent" if seen.get("once") else "fed")


def message_in(cells):
    """The message of cells, as `message_of`; a formula that has none is an error."""
    for where, _, content in cells:
        if content is None:
            raise Wrong("%s: its formula gives an error" % where)
    return message_of(cells)


def state_of_fed(seen, state):
    """The state of an in-port that gets values of cells, unless something is wrong."""
    if seen.get("error"):
        return seen["error"]
    if seen["override"]:
        return "%s in the console: release it there" % seen["override"]
    return state + (", beside " + ", ".join(seen["peers"]) if seen["peers"] and state != "sent" else "")


def state_of_shown(seen):
    """The state of a port that is looked at."""
    if not seen["came"]:
        return "nothing has come yet"
    state = "silent since %.1f s" % seen["tm"] if seen["stale"] else "live"
    return state + (", " + seen["override"] if seen["override"] else "")


def _state_of_watching(seen, kind, columns):
    state = state_of_shown(seen)
    length = kind.length(seen["value"])
    if seen["came"] and kind.is_sequence and columns < length:
        state += ", %d of %d" % (columns, length)
    return state
