"""The live link between a running system and LibreOffice Calc: `nezumi calc` runs this with a console's socket.

Each refresh reads the sheets, asks the system once (feeding in-ports from cells, looking at what ports carry), and
writes what has changed. Nothing is held: in-ports are fed by messages as from a connection, so that whatever of this
ends, they just fall silent.
"""

import argparse
import json
import os
import signal
import sys
import threading
import time

from console import Console, Ended, lua
from growing import Log, Play, key_of
from tables import LOG, PLAY, Linked, rows_of
from values import Type

NEEDS = (
    "the spreadsheet link needs LibreOffice Calc: sudo apt install --no-install-recommends libreoffice-calc python3-uno"
)
PATIENCE = 2.0  # [s] for an answer; after that the sheet says that there is none


class Link:
    """Connects the sheets of a document with a console."""

    def __init__(self, sheets, console, types, system):
        self._sheets, self._console, self._types, self._system = sheets, console, types, system
        self._asked = None  # the paths that refreshes are about
        self._seen = {}  # by path: what the system said last
        self._widths = {}  # by (sheet, row): columns that were written where no headings say how many
        self._time, self._stands_since = None, 0.0
        self._now = None  # [s] when it said so
        self._rows, self._linked, self._links = [], [], []
        self._growing = {}  # logs and plays, by the key of their row

    def refresh(self):
        """One refresh: cells to ports, then ports to cells."""
        data = self._sheets.read()
        self._find(data)
        taken, plays, logs = {}, {}, {}
        for each in self._linked:
            sheet, seen = data[each.row.sheet], self._seen.get(each.row.path)
            moving = self._growing.get(key_of(each.row)) if each.row.grows else None
            if each.row.word == LOG and moving:
                logs[each.row.path] = moving.look(sheet)
            elif each.row.word == PLAY and moving:
                if each.takes(seen, self._types, taken):
                    plays[each.row.path] = moving.look(sheet, self._types[seen["type"]], self._now)
            else:
                each.read(sheet[each.row.row], seen, self._types, taken)
        try:
            answer = self._ask(plays, logs)
            state = "no answer from %s" % self._system
        except (RuntimeError, ValueError) as refused:
            answer = None
            state = "%s: %s" % (self._system, refused)
        for each in self._linked:
            if answer is None:
                each.state = each.state or "no answer"
            else:
                self._take(each, self._seen.get(each.row.path, {}))
        # Rows that moved since they were read have other cells beside them: next time.
        if [rows_of(sheet, content)[0] for sheet, content in enumerate(self._sheets.read())] == self._rows:
            self._show(state if answer is None else "%s, %s" % (self._system, self._clock(answer["now"])))

    def end(self, why):
        """Writes the reason into every state and leaves the sheets."""
        data = self._sheets.read()
        self._find(data)
        for each in self._linked:
            each.state = each.row.problem or why
        self._show(why)

    def has_rows(self):
        return bool(self._linked)

    def _find(self, data):
        found = [rows_of(sheet, content) for sheet, content in enumerate(data)]
        self._rows = [rows for rows, _ in found]
        self._links = [sheet for sheet, (_, tells) in enumerate(found) if tells]
        self._linked = [Linked(row) for rows in self._rows for row in rows]
        growing = {}
        for each in self._linked:
            if each.row.grows and not each.row.problem:
                key = key_of(each.row)
                growing[key] = self._growing.get(key) or (Log if each.row.word == LOG else Play)(each.row)
        self._growing = growing

    def _take(self, each, seen):
        moving = self._growing.get(key_of(each.row)) if each.row.grows else None
        if not moving or each.state:
            return each.show(seen, self._types)
        if each.row.word == LOG:
            moving.take(seen, self._types.get(seen.get("type")), self._now)
        elif seen.get("direction", "in") != "in":
            moving.state = "%s is an out-port: only in-ports are fed" % each.row.path
        else:
            moving.show(seen)
        each.state = moving.state

    def _ask(self, plays, logs):
        paths = sorted({each.row.path for each in self._linked if each.row.path})
        number = {path: i + 1 for i, path in enumerate(paths)}
        feeds = {number[each.row.path]: each.feeds for each in self._linked if each.feeds is not None}
        played = {number[path]: rows for path, rows in plays.items() if rows}
        logged = {number[path]: want for path, want in logs.items() if want}
        text = "calc_refresh(%s, %s, %s)" % (lua(feeds), lua(played), lua(logged))
        if not self._console.is_waiting:  # an answer that is late is to what was asked then
            for moving in self._growing.values():
                if isinstance(moving, Play):
                    moving.sent()
            if paths != self._asked:
                text = "calc_bind(%s) %s" % (lua(paths), text)
            self._asked = paths
        printed = self._console.ask(text, PATIENCE)
        if printed is None:
            return None
        answer = json.loads(printed)
        learn(self._types, answer["ports"])
        self._seen = dict(zip(self._asked, answer["ports"]))
        self._now = answer["now"]
        return answer

    def _clock(self, seconds):
        now = time.monotonic()
        if seconds != self._time:
            self._time, self._stands_since = seconds, now
        return "%.1f s" % seconds if now - self._stands_since < 1.0 else "stands at %.2f s" % seconds

    def _show(self, link_state):
        changes = []
        for sheet in self._links:
            changes.append((sheet, 0, 1, [link_state]))
        for each in self._linked:
            row = each.row
            line = [each.state or ""]
            if each.shows is not None:
                values = dict(each.shows)
                place = (row.sheet, row.row)
                width = len(row.headings) or max(len(values), self._widths.get(place, 0))
                self._widths[place] = len(values)
                for column in range(row.values_column, row.values_column + width):
                    line.append(values.get(column))
            changes.append((row.sheet, row.row, row.column + 1, line))
        for moving in self._growing.values():
            if isinstance(moving, Log):
                changes += moving.changes()
        self._sheets.write(changes)


def learn(types, ports):
    """Takes the fields of types that are new, or have changed."""
    for port in ports:
        if port.get("fields") is not None:
            types[port["type"]] = Type.of_texts(port["type"], port["fields"])


def event_of_signals():
    """An event that Ctrl-C and the like set; when the office does not let go within 5 s, the link just leaves."""
    ended = threading.Event()
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    signal.set_wakeup_fd(writer)  # also while a call to the office does not come back
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: None)

    def wait():
        os.read(reader, 1)
        ended.set()
        time.sleep(5)
        os._exit(0)

    threading.Thread(target=wait, daemon=True).start()
    return ended


def run(options, office):
    console = Console(options.socket)
    types = {}
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "ports.lua"), encoding="utf-8") as file:
        console.ask(file.read(), 60)
    console.ask("calc_check(%s)" % lua(options.port), 60)
    ports = json.loads(console.ask("calc_ports()", 60) or "[]")
    learn(types, ports)

    ended = event_of_signals()
    desktop, process = office.start(options.profile, options.headless, ended)
    try:
        document = office.open_sheet(desktop, options.file, options.headless)
        if not options.file:
            from new_sheet import fill

            fill(document, ports, types, options.system, options.port)
        sheets = office.Sheets(desktop, document)
        why = refresh_until_the_end(options, office, Link(sheets, console, types, options.system), ended)
        print("nezumi: " + why, file=sys.stderr)
    finally:
        if process and options.headless:
            office.stop(desktop)
    return 0


def refresh_until_the_end(options, office, link, ended):
    due = time.monotonic()
    is_first = True
    try:
        while not ended.wait(max(0.0, due - time.monotonic())):
            due = max(due + 1.0 / options.rate, time.monotonic())
            link.refresh()
            if is_first:
                print("nezumi: Calc is linked with %s; Ctrl-C ends the link" % options.system, file=sys.stderr)
                if not link.has_rows():
                    print("nezumi: %s has no table yet: see docs/spreadsheet.md" % options.file, file=sys.stderr)
                is_first = False
        why = "the link has ended"
    except Ended:
        why = "%s has ended" % options.system
    except office.Closed as closed:
        return str(closed)
    except BaseException:
        leave(office, link, "the link has failed")
        raise
    leave(office, link, why)
    return why


def leave(office, link, why):
    """A sheet that is no longer linked must show that."""
    try:
        link.end(why)
    except office.Closed:
        pass


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--socket", type=int, required=True)
    parser.add_argument("--system", required=True)
    parser.add_argument("--file", default="")
    parser.add_argument("--profile", default="")
    parser.add_argument("--rate", type=float, required=True)
    parser.add_argument("--port", action="append", default=[])
    parser.add_argument("--headless", action="store_true")
    options = parser.parse_args()
    try:
        import office
    except ImportError:
        print("nezumi: " + NEEDS, file=sys.stderr)
        return 2
    try:
        return run(options, office)
    except (office.Refused, RuntimeError) as problem:
        print("nezumi: %s" % problem, file=sys.stderr)
        return 2
    except office.Closed as end:
        print("nezumi: %s" % end, file=sys.stderr)
        return 2
    except Ended:
        print("nezumi: %s has ended" % options.system, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
