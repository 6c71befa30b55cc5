"""What the spreadsheet's link makes of tables that move, without an office."""

import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../bindings/calc"))
from growing import Log, Play
from tables import rows_of
from values import Type

VELOCITY = Type("TimedVelocity2D", [[name, "m/s", "number", False] for name in ("vx", "vy", "va")])
SHORTS = Type("TimedShortSeq", [["", "", "integer", True]])
LIVE = {"type": "TimedVelocity2D", "came": True, "stale": False, "override": None, "tm": 1.0}


def row_of(*lines):
    """The row of a table that is alone in its sheet."""
    width = max(len(line) for line in lines)
    rows, _ = rows_of(0, [tuple(line) + ("",) * (width - len(line)) for line in lines])
    return rows[0]


def table(port, *headings):
    return row_of(("Port", "State") + headings, (port,))


class Sheet:
    """A sheet's cells, as the link reads and writes them."""

    def __init__(self, *lines):
        self.cells = {(i, j): cell for i, line in enumerate(lines) for j, cell in enumerate(line)}

    def data(self):
        return [[self.cells.get((i, j), "") for j in range(12)] for i in range(40)]

    def write(self, changes):
        for _, row, column, values in changes:
            for j, value in enumerate(values):
                self.cells[row, column + j] = "" if value is None else value

    def column(self, column, first=1):
        values = []
        while self.cells.get((first + len(values), column), "") != "":
            values.append(self.cells[first + len(values), column])
        return values


class Run:
    """A log that is refreshed while messages come: vx is the number of the message, a hundred each second."""

    def __init__(self, port, *headings):
        self.sheet = Sheet(("Port", "State") + headings, (port,))
        self.log = Log(table(port, *headings))
        self.time = 0.0

    def refresh(self, seconds=0.1, now=None):
        wanted = self.log.look(self.sheet.data())
        begin, self.time = self.time, self.time + seconds if now is None else now
        seen = dict(LIVE)
        if wanted and wanted["since"] is not None:
            ticks = range(round(begin * 100), round(self.time * 100))
            rows = [[tick / 100, tick, 0, -tick] for tick in ticks if tick / 100 > wanted["since"]]
            seen["samples"] = {"labels": ["vx", "vy", "va"], "rows": rows[-wanted["most"] :]}
        self.log.take(seen, VELOCITY, self.time)
        self.sheet.write(self.log.changes())
        return self.log.state


class RowsTest(unittest.TestCase):
    def test_a_port_may_have_a_word_before_it_and_options_after_it(self):
        row = table("log mouse.out every 0.5 s, rows 200")
        self.assertEqual((row.word, row.path, row.every, row.rows, row.problem), ("log", "mouse.out", 0.5, 200, None))
        row = table("play mouse.in repeating every .2s")
        self.assertEqual((row.word, row.path, row.every, row.repeats), ("play", "mouse.in", 0.2, True))
        self.assertEqual(table("log mouse.out").rows, 1000)

    def test_a_wrong_option_is_told(self):
        wrong = {
            "log mouse.out each 5 s": "expected every 0.5 s, rows 1000, got 'each 5 s'",
            "log mouse.out rows 0": "expected every 0.5 s, rows 1000, got 'rows 0'",
            "log mouse.out rows 10001": "expected every 0.5 s, rows 1000, got 'rows 10001'",
            "log mouse.out repeating": "expected every 0.5 s, rows 1000, got 'repeating'",
            "play mouse.in rows 5": "expected every 0.5 s, repeating, got 'rows 5'",
            "play mouse.in every 0 s": "expected every 0.5 s, repeating, got 'every 0 s'",
            "watch mouse.in every 1 s": "expected only a port, got 'every 1 s'",
            "mouse.in rows 5": "expected only a port, got 'rows 5'",
            "follow mouse.in": "expected a port, such as mouse.ir_sensor_out",
        }
        for text, problem in wrong.items():
            self.assertEqual(table(text).problem, problem)

    def test_a_table_that_grows_has_no_port_below(self):
        rows, _ = rows_of(0, [("Port", "State"), ("a.out", ""), ("log a.out", ""), ("b.out", "")])
        self.assertEqual([row.problem for row in rows[:2]], [None, None])
        self.assertEqual(rows[2].problem, "the port above takes these rows: give this one a table of its own")


class LogTest(unittest.TestCase):
    def test_each_message_is_a_row_with_its_time(self):
        run = Run("log c.out", "time [s]", "va", "remarks", "vx [m/s]")
        self.assertEqual(run.refresh(), "live, 0 rows")
        self.assertEqual(run.refresh(), "live, 10 rows")
        self.assertEqual(run.refresh(), "live, 20 rows")
        self.assertEqual(run.sheet.column(2), [tick / 100 for tick in range(10, 30)])
        self.assertEqual(run.sheet.column(3), [-tick for tick in range(10, 30)])
        self.assertEqual(run.sheet.column(4), [])
        self.assertEqual(run.sheet.column(5), list(range(10, 30)))

    def test_without_headings_the_time_comes_first(self):
        run = Run("log c.out")
        run.refresh(), run.refresh()
        self.assertEqual([run.sheet.cells[1, column] for column in (2, 3, 4, 5)], [0.1, 10, 0, -10])

    def test_the_oldest_go_when_there_are_too_many(self):
        run = Run("log c.out rows 12", "vx")
        for _ in range(4):
            state = run.refresh()
        self.assertEqual(state, "live, 12 rows")
        self.assertEqual(run.sheet.column(2), list(range(28, 40)))

    def test_only_new_rows_are_written_until_it_is_full(self):
        run = Run("log c.out rows 25", "vx")
        run.refresh(), run.refresh()
        run.sheet.cells[2, 2] = "mine"
        run.refresh()
        self.assertEqual(run.sheet.cells[2, 2], "mine")

    def test_it_begins_anew_when_its_cells_are_emptied_or_the_system_begins_anew(self):
        run = Run("log c.out", "vx")
        run.refresh(), run.refresh()
        run.sheet.cells[1, 2] = ""
        self.assertEqual(run.refresh(), "live, 0 rows")
        self.assertEqual(run.sheet.column(2), [])
        self.assertEqual([run.sheet.cells[i, 2] for i in range(1, 11)], [""] * 10)
        run.refresh()
        self.assertEqual(run.sheet.column(2), list(range(30, 40)))
        self.assertEqual(run.refresh(now=0.0), "live, 0 rows")
        self.assertEqual(run.sheet.column(2), [])
        run.refresh(), run.refresh()
        self.assertEqual(run.sheet.column(2), list(range(10, 20)))

    def test_it_writes_over_nothing_that_was_there_before(self):
        run = Run("log c.out", "vx")
        run.sheet.cells[1, 2] = 7.0
        self.assertEqual(run.refresh(), "its cells hold other rows: empty them to begin")
        self.assertEqual(run.refresh(), "its cells hold other rows: empty them to begin")
        run.sheet.cells[1, 2] = ""
        run.refresh(), run.refresh()
        self.assertEqual(len(run.sheet.column(2)), 10)

    def test_a_slip_in_a_heading_is_told(self):
        run = Run("log c.out", "time", "vx", "vaa")
        run.refresh()
        self.assertEqual(run.refresh(), "TimedVelocity2D has no field 'vaa' (did you mean 'va'?)")

    def test_elements_have_columns(self):
        log = Log(table("log m.ir"))
        log.look(Sheet().data())
        seen = dict(LIVE, samples={"labels": ["[1]", "[2]"], "rows": [[0.5, 7, 8]]})
        log.take(seen, SHORTS, 0.1), log.take(seen, SHORTS, 0.6)
        self.assertEqual(log.changes(), [(0, 1, 2, [0.5, 7, 8])])


class PlayTest(unittest.TestCase):
    def play(self, port, headings, rows, times):
        """What is sent at these times, and the last state."""
        lines = [(("", "") if i else (port, "")) + tuple(row) for i, row in enumerate(rows)]
        sheet = Sheet(("Port", "State") + tuple(headings), *lines)
        play = Play(row_of(("Port", "State") + tuple(headings), *lines))
        sent = []
        for now in times:
            sent.append(play.look(sheet.data(), VELOCITY, now))
            play.sent()
        play.show(dict(LIVE, error=None, peers=[]))
        return sent, play.state

    def test_rows_follow_each_other_and_the_present_one_is_repeated(self):
        sent, state = self.play("play c.in every 0.2 s", ["vx"], [(1.0,), (2.0,)], [5.0, 5.1, 5.2, 5.3, 5.4, 5.5])
        self.assertEqual([[message["vx"] for message in each] for each in sent], [[1.0], [1.0], [2.0], [2.0], [], []])
        self.assertEqual(state, "played, 2 rows")

    def test_rows_that_were_due_between_two_refreshes_are_all_sent(self):
        sent, state = self.play("play c.in every 0.02 s", ["vx"], [(float(i),) for i in range(12)], [0.0, 0.1, 0.2])
        numbers = [[message["vx"] for message in each] for each in sent]
        self.assertEqual(numbers, [[0], [1, 2, 3, 4, 5], [6, 7, 8, 9, 10]])
        self.assertEqual(state, "row 11 of 12")

    def test_they_repeat(self):
        sent, state = self.play("play c.in repeating, every 0.1 s", ["vx"], [(1.0,), (2.0,)], [0.0, 0.1, 0.2, 0.3, 0.4])
        self.assertEqual([[message["vx"] for message in each] for each in sent], [[1], [2], [1], [2], [1]])
        self.assertEqual(state, "row 1 of 2")

    def test_a_column_of_times_says_when(self):
        rows = [(10.0, 1.0), (10.3, 2.0), (10.4, 3.0)]
        sent, _ = self.play("play c.in", ["time", "vx"], rows, [2.0, 2.2, 2.3, 2.4, 2.5])
        self.assertEqual([[message["vx"] for message in each] for each in sent], [[1], [1], [2], [3], []])
        sent, state = self.play("play c.in", ["time", "vx"], [(1.0, 1.0), (1.0, 2.0)], [0.0])
        self.assertEqual((sent, state), ([[]], "C3: expected a time, later than in the row above"))

    def test_a_wrong_cell_stops_it(self):
        sent, state = self.play("play c.in", ["vx"], [(1.0,), ("fast",)], [0.0])
        self.assertEqual((sent, state), ([[]], "C3: expected a number, got 'fast'"))

    def test_it_begins_anew_with_the_system(self):
        sent, _ = self.play("play c.in every 0.1 s", ["vx"], [(1.0,), (2.0,)], [5.0, 5.1, 5.3, 0.0])
        self.assertEqual([[message["vx"] for message in each] for each in sent], [[1], [2], [], [1]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
