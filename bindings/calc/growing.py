"""Tables whose rows move in time: a log gets a row for each message, and rows are played into a port one by one."""

import re

from tables import MOST_COLUMNS, USUAL_PERIOD, address, message_in, state_of_fed, state_of_shown
from values import Wrong

TIME = "time"
EARLIER = "its cells hold other rows: empty them to begin"


def key_of(row):
    """A row that is another, or says something else, begins again."""
    return tuple(sorted((name, repr(value)) for name, value in vars(row).items() if name != "headings"))


def _is_time(heading):
    return re.sub(r"\s*[\[(].*$", "", heading).strip().lower() == TIME


def _parts(row, kind, count):
    """The part of each column; TIME for that of the time, None for a column of something else."""
    if not row.headings:
        return [TIME] + kind.parts(min(row.limit - 1, count))
    rest = iter(kind.columns([heading for heading in row.headings if not _is_time(heading)]))
    return [TIME if _is_time(heading) else next(rest, None) for heading in row.headings]


def _cells(data, at, row, width):
    """The cells of the values in this row of the sheet."""
    line = data[at] if at < len(data) else ()
    columns = range(row.values_column, row.values_column + width)
    return [line[column] if column < len(line) else "" for column in columns]


class Log:
    """The messages of a port, the latest `rows` of them, one below the other."""

    def __init__(self, row):
        self.row = row
        self.state = None
        self._lines = []  # of values
        self._since = None  # [s] the stamp of the latest; None: begins
        self._waits = True  # for its cells to be empty
        self._changes = []  # lines to write, as Sheets.write takes them

    def look(self, data):
        """Before a refresh: begins again where its cells were emptied. Returns what to ask for."""
        is_empty = all(cell == "" for cell in _cells(data, self.row.row, self.row, self._width()))
        if self._waits:
            self._waits = not is_empty
        elif self._lines and is_empty:
            self._begin()
        return None if self._waits else {"since": self._since, "every": self.row.every, "most": self.row.rows}

    def take(self, seen, kind, now):
        """After a refresh: the messages that came."""
        if self._waits or "type" not in seen:
            self.state = EARLIER if self._waits else seen.get("error", "no answer")
            return
        if kind.has_bytes:
            self.state = "bytes are not logged"
            return
        samples = seen.get("samples")
        if self._since is not None and now < self._since:
            self._begin()  # the system did
        elif self._since is None:
            self._since = now - 1e-9  # a message of just now counts
        elif samples:
            try:
                self._add(samples, kind)
            except Wrong as wrong:
                self.state = str(wrong)
                return
        self.state = "%s, %d row%s" % (state_of_shown(seen), len(self._lines), "" if len(self._lines) == 1 else "s")

    def changes(self):
        """What there is to write, once."""
        changes, self._changes = self._changes, []
        return changes

    def _add(self, samples, kind):
        labels = samples["labels"]
        places = [self._place(part, labels) for part in _parts(self.row, kind, len(labels))]
        new = [
            [None if place is None or place >= len(line) else line[place] for place in places]
            for line in samples["rows"]
            if line[0] > self._since
        ]
        if not new:
            return
        self._since = samples["rows"][-1][0]
        before = len(self._lines)
        self._lines = (self._lines + new)[-self.row.rows :]
        first = before if before + len(new) <= self.row.rows else 0  # else all of them have moved
        for i in range(first, len(self._lines)):
            self._write(i, self._lines[i])

    @staticmethod
    def _place(part, labels):
        """Where a part is in a sample: first its stamp, then a value for each label."""
        if part is None:
            return None
        if part == TIME:
            return 0
        if part.label in labels:
            return labels.index(part.label) + 1
        return 1 if part.label == "" and len(labels) == 1 else None

    def _begin(self):
        for i in range(len(self._lines)):
            self._write(i, [None] * self._width())
        self._lines, self._since = [], None

    def _width(self):
        if self.row.headings:
            return len(self.row.headings)
        return max((len(line) for line in self._lines), default=min(self.row.limit, MOST_COLUMNS))

    def _write(self, line, values):
        self._changes.append((self.row.sheet, self.row.row + line, self.row.values_column, values))


class Play:
    """The rows of a table, fed into a port one after the other."""

    def __init__(self, row):
        self.row = row
        self.state = None
        self._began = None  # [s]
        self._next = 0  # the row that is due next, counted on when they repeat
        self._due = []
        self._count = 0

    def look(self, data, kind, now):
        """Before a refresh: the messages that are due at `now`, at least the present one; none when all were played."""
        self.state, self._due = None, []
        try:
            times, rows = self._rows(data, kind)
        except Wrong as wrong:
            self.state = str(wrong)
            return []
        self._count = len(rows)
        if not rows or now is None:
            self.state = None if rows else "not fed"
            return []
        if self._began is None or now < self._began:
            self._began, self._next = now, 0
        period = times[-1] + (times[-1] - times[-2] if len(times) > 1 else self.row.every or USUAL_PERIOD)
        turns, elapsed = divmod(now - self._began + 1e-9, period)
        if turns >= 1 and not self.row.repeats:
            due = len(rows)
            is_over = self._next >= due
        else:
            due = int(turns) * len(rows) + sum(1 for time in times if time <= elapsed)
            is_over = False
        self._due = list(range(max(self._next, due - len(rows)), due)) or ([] if is_over else [due - 1])
        return [rows[i % len(rows)] for i in self._due if i >= 0]

    def sent(self):
        """The messages of `look` went out."""
        if self._due:
            self._next = self._due[-1] + 1

    def show(self, seen):
        """After a refresh."""
        if self.state is None:
            played = "played, %d rows" % self._count if self._count else "not fed"
            state = "row %d of %d" % (self._due[-1] % self._count + 1, self._count) if self._due else played
            self.state = state_of_fed(seen, state) if "type" in seen else seen.get("error", "no answer")

    def _rows(self, data, kind):
        parts = _parts(self.row, kind, MOST_COLUMNS) if self.row.headings else kind.parts(self.row.limit)
        times, rows = [], []
        for at in range(self.row.row, len(data)):
            cells = _cells(data, at, self.row, len(parts))
            where = [address(at, self.row.values_column + i) for i in range(len(parts))]
            message = message_in([each for each in zip(where, parts, cells) if each[1] not in (None, TIME)])
            if message is None:
                break
            time = len(rows) * (self.row.every or USUAL_PERIOD)
            if TIME in parts and self.row.every is None:
                place = parts.index(TIME)
                time = cells[place]
                if not isinstance(time, float) or (times and time <= times[-1]):
                    raise Wrong("%s: expected a time, later than in the row above" % where[place])
            times.append(time)
            rows.append(message)
        return [time - times[0] for time in times], rows
