"""A new sheet that shows a system: out-ports with their values, and cells for its in-ports."""

import uno  # makes the names below importable
from com.sun.star.awt.FontWeight import BOLD
from com.sun.star.lang import Locale
from com.sun.star.table import BorderLine2
from com.sun.star.table.CellHoriJustify import LEFT, RIGHT
from com.sun.star.table.CellVertJustify2 import CENTER

from tables import LINK, PORT, STATE
from values import BOOLEAN, INTEGER, NUMBER

DARK, LIGHT, YELLOW, GREY, WHITE = 0x1F3A5F, 0xEEF2F7, 0xFFF6C8, 0x6B7280, 0xFFFFFF
WIDTHS = (5400, 5400)  # [1/100 mm] of port and state
VALUE_WIDTH, MOST_VALUES = 2900, 8
LINE = BorderLine2(Color=0xD5DAE1, OuterLineWidth=18, LineWidth=18)
FORMATS = {NUMBER: "0.000", INTEGER: "0", BOOLEAN: "BOOLEAN"}


class Table:
    """Ports of one direction whose values have the same headings."""

    def __init__(self, headings):
        self.headings, self.ports = headings, []


def fill(document, ports, types, system, wanted):
    """Lays out the first sheet for the system's ports that `wanted` names (ports or components; none: all)."""
    chosen = choose(ports, wanted)
    outs, ins = tables_of(chosen, "out", types), tables_of(chosen, "in", types)
    sheet = document.Sheets.getByIndex(0)
    sheet.Name = system
    document.CurrentController.ShowGrid = False
    writer = Writer(document, sheet, max([len(table.headings) for table in outs + ins] or [1]))
    writer.title()
    writer.section("What the system says", "out-ports, live")
    for table in outs:
        writer.table(table, types, False)
    writer.section("What you tell it", "in-ports: type into a yellow cell; empty it to feed nothing")
    for table in ins:
        writer.table(table, types, True)
    writer.widths()
    document.getUndoManager().clear()
    document.setModified(False)


def choose(ports, wanted):
    """The ports whose path or component is in `wanted`."""
    if not wanted:
        return ports
    chosen = []
    for name in wanted:
        found = [port for port in ports if name in (port["path"], port["path"].split(".")[0])]
        chosen += [port for port in found if port not in chosen]
    return chosen


def tables_of(ports, direction, types):
    """Tables in the order of the first use of their headings."""
    tables = {}
    for port in ports:
        if port.get("direction", "out") != direction or (direction == "in" and types[port["type"]].has_bytes):
            continue
        headings = headings_of(port, types)
        if headings:
            tables.setdefault(headings, Table(headings)).ports.append(port)
    return list(tables.values())


def headings_of(port, types):
    kind = types.get(port.get("type"))
    if kind is None:
        return ("value",)
    count = MOST_VALUES
    if kind.is_sequence:
        count = min(kind.length(port["value"]) or 4, MOST_VALUES)
    parts = kind.parts(count)
    if len(parts) == 1 and not parts[0].name and not kind.is_sequence:
        return ("value",)
    names = [part.name or str(i + 1) for i, part in enumerate(parts)]
    return tuple(name + (" [%s]" % part.unit if part.unit else "") for name, part in zip(names, parts))


class Writer:
    """Writes titles and tables into a sheet, from top to bottom."""

    def __init__(self, document, sheet, most_values):
        self._formats = document.NumberFormats
        self._sheet, self._most_values = sheet, most_values
        self._row = 0

    def title(self):
        self._put(self._row, 0, (LINK, ""))
        self._cells(0, 0, 1).CharHeight = 14
        self._cells(0, 0, 1).CharWeight = BOLD
        self._cells(0, 1, 3).CharColor = GREY
        self._row += 2

    def section(self, name, what):
        self._put(self._row, 0, (name, what))
        self._cells(self._row, 0, 1).CharWeight = BOLD
        self._cells(self._row, 0, 1).CharHeight = 12
        self._cells(self._row, 1, 1).CharColor = GREY
        self._row += 1

    def table(self, table, types, is_fed):
        width = len(table.headings)
        heading = self._cells(self._row, 0, 2 + width)
        self._put(self._row, 0, (PORT, STATE) + table.headings)
        heading.CellBackColor, heading.CharColor, heading.CharWeight = DARK, WHITE, BOLD
        self._cells(self._row, 2, width).HoriJustify = RIGHT
        for port in table.ports:
            self._row += 1
            self._put(self._row, 0, (port["path"], ""))
            self._put(self._row, 2 + self._most_values, (port.get("doc", ""),))
            self._cells(self._row, 0, 1).CharWeight = BOLD
            state = self._cells(self._row, 1, 1)
            state.CharColor, state.IsTextWrapped = GREY, True
            self._cells(self._row, 0, 3 + self._most_values).VertJustify = CENTER
            values = self._cells(self._row, 2, width)
            values.CellBackColor = YELLOW if is_fed else LIGHT
            values.HoriJustify = RIGHT
            self._format(values, port, types)
            doc = self._cells(self._row, 2 + self._most_values, 1)
            doc.CharColor, doc.HoriJustify, doc.ParaIndent = GREY, LEFT, 300
            self._cells(self._row, 0, 2 + width).BottomBorder = LINE
        self._row += 2

    def widths(self):
        columns = self._sheet.Columns
        for column, width in enumerate(WIDTHS):
            columns.getByIndex(column).Width = width
        for column in range(2, 2 + self._most_values):
            columns.getByIndex(column).Width = VALUE_WIDTH
        columns.getByIndex(2 + self._most_values).OptimalWidth = True

    def _format(self, values, port, types):
        kind = types.get(port.get("type"))
        parts = kind.parts(1) if kind else []
        code = FORMATS.get(parts[0].kind) if parts else None
        if code is None:
            values.HoriJustify = LEFT
            return
        locale = Locale("en", "US", "")
        key = self._formats.queryKey(code, locale, False)
        values.NumberFormat = self._formats.addNew(code, locale) if key < 0 else key

    def _cells(self, row, column, width):
        return self._sheet.getCellRangeByPosition(column, row, column + width - 1, row)

    def _put(self, row, column, values):
        self._cells(row, column, len(values)).setDataArray((values,))
