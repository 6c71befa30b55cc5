"""Tables that move, with the real LibreOffice Calc. Usage: growing_office_test.py NEZUMI [TEST...]"""

import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

# Writes the number of each execution, a hundred each second.
COUNTER = """--- Counts.
local out = output("out", "TimedVelocity2D", "vx counts")
state.count = state.count or 0
function on_execute()
  state.count = state.count + 1
  out:write { vx = state.count, va = -state.count }
end
"""
# Keeps what came, each message.
LISTENER = """--- Listens.
local heard = input("heard", "TimedLong", "numbers", { queue = 1000 })
state.all = state.all or {}
function on_execute()
  while heard.is_new do state.all[#state.all + 1] = heard:read() end
end
"""


class GrowingTest(rig.OfficeCase):
    """Logs, and rows that are played."""

    def counter(self):
        self.place.write("counter.lua", COUNTER)
        return self.system('behavior "counter" { script = "counter" }\n')

    def rows(self, link, first="C2", last="D"):
        """What a log has in two columns, down to its first empty row."""
        low = link.sheet.getCellRangeByName("%s:%s2002" % (first, last))
        values = []
        for line in low.getDataArray():
            if "" in line:
                break
            values.append(line)
        return values

    def test_each_of_a_hundred_messages_a_second_is_a_row_and_a_chart_over_them_lives(self):
        system = self.counter()
        link = self.link(system, [["Port", "State", "time [s]", "vx"], ["log counter.out rows 500"]])
        from com.sun.star.awt import Rectangle  # once uno is there
        from com.sun.star.table import CellRangeAddress

        range_address = CellRangeAddress()
        range_address.StartColumn, range_address.EndColumn, range_address.StartRow, range_address.EndRow = 2, 3, 0, 500
        link.sheet.Charts.addNewByName("drawn", Rectangle(9000, 500, 12000, 8000), (range_address,), True, False)
        chart = link.sheet.Charts.getByName("drawn").getEmbeddedObject()
        rig.wait_until(lambda: len(self.rows(link)) > 100, lambda: repr(link.text()[:5]))
        rows = self.rows(link)
        counts = [row[1] for row in rows]
        self.assertEqual(counts, [counts[0] + i for i in range(len(counts))])
        self.assertAlmostEqual(rows[-1][0] - rows[0][0], (len(rows) - 1) / 100, 6)
        rig.wait_until(lambda: len(self.rows(link)) == 500, lambda: repr(link.text()[:5]))
        rig.wait_until(lambda: self.rows(link)[0][1] > counts[0] + 300, "the oldest go")
        rows = self.rows(link)
        self.assertEqual(len(rows), 500)
        self.assertEqual([row[1] for row in rows], [rows[0][1] + i for i in range(500)])
        self.assertRegex(link.cell("B2").getString(), "^live, 500 rows$")
        drawn = chart.getData().getData()
        self.assertGreater(drawn[0][0] if drawn[0][0] > 100 else drawn[0][-1], 300)
        # Each refresh takes what came since the one before: it keeps up.
        before, began = self.rows(link)[-1][1], time.monotonic()
        time.sleep(3)
        gained, passed = self.rows(link)[-1][1] - before, time.monotonic() - began
        print("%.0f messages in %.1f s" % (gained, passed), file=sys.stderr)
        self.assertGreater(gained, passed * 100 * 0.5)

    def test_a_log_begins_anew_when_its_cells_are_emptied_and_can_leave_messages_out(self):
        link = self.link(self.counter(), [["Port", "State", "time", "vx"], ["log counter.out every 0.2 s"]])
        rig.wait_until(lambda: len(self.rows(link)) > 5, lambda: repr(link.text()[:5]))
        counts = [row[1] for row in self.rows(link)]
        self.assertEqual({b - a for a, b in zip(counts, counts[1:])}, {20.0})
        for line in range(2, 5):
            link.put("C%d" % line, ""), link.put("D%d" % line, "")
        rig.wait_until(lambda: [row for row in self.rows(link)[:1] if row[1] > counts[-1]], "new rows")

    def test_a_log_does_not_write_over_what_is_there(self):
        link = self.link(self.counter(), [["Port", "State", "time", "vx"], ["log counter.out", "", "mine"]])
        link.shows("B2", "its cells hold other rows: empty them to begin")
        self.assertEqual(link.cell("C2").getString(), "mine")
        link.put("C2", "")
        rig.wait_until(lambda: len(self.rows(link)) > 5, lambda: repr(link.text()[:5]))

    def test_rows_are_played_one_after_the_other(self):
        self.place.write("listener.lua", LISTENER)
        system = self.system('behavior "listener" { script = "listener" }\n')
        rows = [["Port", "State", "value"], ["play listener.heard every 0.05 s", "", 1]]
        rows += [["", "", i] for i in range(2, 31)]
        link = self.link(system, rows)
        link.shows("B2", "played, 30 rows")
        heard = [int(number) for number in system.ask('table.concat(listener.state.all, " ")').strip('"').split()]
        self.assertEqual(sorted(set(heard)), list(range(1, 31)))
        self.assertEqual(heard, sorted(heard))
        rig.wait_until(lambda: float(system.ask("listener.heard.age")) > 1, "then nothing comes")
        link.put("A2", "play listener.heard repeating")
        rig.wait_until(lambda: link.cell("B2").getString().startswith("row "), lambda: repr(link.text()[:3]))

    def test_a_robot_stops_when_its_rows_were_played(self):
        system = self.system(rig.MOUSE)
        rows = [["Port", "State", "time", "vx", "va"], ["play mouse.target_velocity_in", "", 0, 0.2, 0]]
        rows += [["", "", 1, 0.1, 0]]
        link = self.link(system, rows)
        rig.wait_until(lambda: system.ask("mouse.truth.velocity.vx > 0.15") == "true", lambda: repr(link.text()))
        link.shows("B2", "played, 2 rows")
        rig.wait_until(lambda: system.ask(rig.STANDS) == "true", "it stands")


if __name__ == "__main__":
    rig.main()
