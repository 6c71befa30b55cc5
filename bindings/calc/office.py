"""Connects to LibreOffice or starts it, and reads and writes its sheets."""

import itertools
import os
import secrets
import shutil
import signal
import subprocess
import tempfile
import time

import uno
from com.sun.star.beans import PropertyValue
from com.sun.star.lang import DisposedException
from com.sun.star.uno import Exception as UnoException

LONGEST_START = 120  # [s]
MOST_ROWS, MOST_COLUMNS, MOST_SHEETS = 1000, 100, 16  # of a document: what is read


class Refused(Exception):
    """LibreOffice can't be used; the text says why and what to do."""


class Closed(Exception):
    """The document or the office was closed; the text says which."""


def start(profile, is_headless, ended):
    """Reaches the user's office, or starts one: an office that runs already takes over what a new one is called with,
    the pipe to listen at among it. The pipe has a name that nobody can foresee, and is its user's alone. Returns the
    office's desktop, and the process if it is a new office. Gives up when `ended` is set."""
    program = shutil.which("soffice") or shutil.which("libreoffice")
    if program is None:
        raise Refused(
            "LibreOffice Calc is not installed: sudo apt install --no-install-recommends libreoffice-calc python3-uno"
        )
    if not is_headless and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        raise Refused("there is no display to show Calc on; --headless does without")
    pipe = "nezumi-" + secrets.token_hex(8)
    words = [program, "--accept=pipe,name=%s;urp;" % pipe, "--norestore", "--nologo", "--nodefault"]
    if profile:
        words.append("-env:UserInstallation=" + uno.systemPathToFileUrl(os.path.abspath(profile)))
    if is_headless:
        words.append("--headless")
    said = tempfile.TemporaryFile()  # no pipe: the office outlives the link
    # A session of its own: Ctrl-C ends the link, but not LibreOffice.
    process = subprocess.Popen(
        words, stdin=subprocess.DEVNULL, stdout=said, stderr=said, start_new_session=True, umask=0o077
    )
    context = uno.getComponentContext()
    resolver = context.ServiceManager.createInstanceWithContext("com.sun.star.bridge.UnoUrlResolver", context)
    try:
        remote = _reach(resolver, "uno:pipe,name=%s;urp;StarOffice.ComponentContext" % pipe, process, said, ended)
    except Refused:
        if is_headless and process.poll() is None:
            os.killpg(process.pid, signal.SIGTERM)
        raise
    desktop = remote.ServiceManager.createInstanceWithContext("com.sun.star.frame.Desktop", remote)
    return desktop, None if process.poll() is not None else process


def _reach(resolver, address, process, said, ended):
    end = time.monotonic() + LONGEST_START
    while time.monotonic() < end:
        try:
            return resolver.resolve(address)
        except UnoException:
            pass
        status = process.poll()
        if status:
            said.seek(0)
            lines = said.read().decode(errors="replace").strip().splitlines()
            raise Refused("LibreOffice can't start: " + (lines[0] if lines else "exit status %d" % status))
        if ended.wait(0.1):
            raise Refused("ended before LibreOffice was there")
    raise Refused("LibreOffice did not answer within %d s" % LONGEST_START)


def stop(desktop):
    """Ends an office that has no window."""
    try:
        desktop.terminate()
    except UnoException:
        pass  # it has ended already


def open_sheet(desktop, file, is_headless):
    """The document of a file, or a new one where `file` is empty."""
    hidden = PropertyValue()
    hidden.Name, hidden.Value = "Hidden", is_headless
    url = uno.systemPathToFileUrl(file) if file else "private:factory/scalc"
    try:
        document = desktop.loadComponentFromURL(url, "_default" if file else "_blank", 0, (hidden,))
    except DisposedException:
        raise Closed("LibreOffice has ended") from None
    except UnoException:
        document = None
    if document is None:
        raise Refused("LibreOffice can't open %s" % (file or "a new sheet"))
    if not document.supportsService("com.sun.star.sheet.SpreadsheetDocument"):
        raise Refused("%s is not a spreadsheet" % file)
    return document


class Sheets:
    """The cells of a document."""

    def __init__(self, desktop, document):
        self._desktop, self.document = desktop, document
        self._before, self._written = [], {}  # what was read last; what was written over it, by (sheet, row, column)
        self._formulas = set()  # cells that are known to change by themselves

    def read(self):
        """The content of every sheet, from A1 on: numbers, texts, and None for the error of a formula."""
        return self._try(self._read)

    def write(self, changes):
        """Writes (sheet, row, column, values), without a trace in the list of what can be undone, and without making an
        unchanged document a changed one."""
        if changes:
            self._try(lambda: self._write(changes))

    def _read(self):
        sheets = self.document.Sheets
        contents = []
        for i in range(min(sheets.getCount(), MOST_SHEETS)):
            sheet = sheets.getByIndex(i)
            cursor = sheet.createCursor()
            cursor.gotoEndOfUsedArea(False)
            used = cursor.getRangeAddress()
            row, column = min(used.EndRow, MOST_ROWS - 1), min(used.EndColumn, MOST_COLUMNS - 1)
            contents.append(sheet.getCellRangeByPosition(0, 0, column, row).getDataArray())
        if not self.document.isModified() and self._is_edited(contents):
            self.document.setModified(True)  # it was edited just while `_write` kept the mark from changing
        self._before, self._written = contents, {}
        return contents

    def _is_edited(self, contents):
        for sheet, (old, new) in enumerate(zip(self._before, contents)):
            for row, (old_line, new_line) in enumerate(itertools.zip_longest(old, new, fillvalue=())):
                if old_line == new_line:
                    continue
                for column, (was, content) in enumerate(itertools.zip_longest(old_line, new_line, fillvalue="")):
                    place = (sheet, row, column)
                    if self._written.get(place, was) == content or place in self._formulas:
                        continue
                    cell = self.document.Sheets.getByIndex(sheet).getCellByPosition(column, row)
                    if not cell.getFormula().startswith("="):
                        return True
                    self._formulas.add(place)
        return False

    def _write(self, changes):
        texts, numbers = pieces(changes, self._content)
        self.document.disableSetModified()
        try:
            for sheet, row, column, text in texts:
                cell = self.document.Sheets.getByIndex(sheet).getCellByPosition(column, row)
                self._write_silently(lambda: cell.setString(text))
                self._written[sheet, row, column] = text
            for sheet, row, column, block in numbers:
                right, low = column + len(block[0]) - 1, row + len(block) - 1
                cells = self.document.Sheets.getByIndex(sheet).getCellRangeByPosition(column, row, right, low)
                places = [(i, j, value) for i, values in enumerate(block) for j, value in enumerate(values)]
                try:
                    self._write_silently(lambda: cells.setDataArray(block))
                except UnoException:  # a protected sheet takes cells one by one
                    for i, j, value in places:
                        self._write_silently(lambda: cells.getCellByPosition(j, i).setValue(value))
                for i, j, value in places:
                    self._written[sheet, row + i, column + j] = value
        finally:
            self.document.enableSetModified()

    def _write_silently(self, write):
        """A lock of the list of what can be undone holds for one write: the office opens it again by itself. (It does
        so too early where setDataArray makes a row higher, as long texts do: those go by setString.)"""
        undo = self.document.getUndoManager()
        undo.lock()
        try:
            write()
        finally:
            undo.unlock()

    def _content(self, sheet, row, column):
        """The content that was read last."""
        lines = self._before[sheet]
        return lines[row][column] if row < len(lines) and column < len(lines[row]) else ""

    def _try(self, action):
        try:
            return action()
        except Exception:  # a document that closes answers in many ways
            if self._is_open():
                raise
        try:
            self._desktop.getCurrentComponent()
        except UnoException:
            raise Closed("LibreOffice has ended") from None
        raise Closed("the sheet was closed")

    def _is_open(self):
        try:
            return self.document.Sheets.getCount() > 0
        except (UnoException, AttributeError):
            return False


def pieces(changes, content):
    """What changes (sheet, row, column, values) come to, where `content` is what a cell has: texts (sheet, row, column,
    text), and numbers that lie beside or under each other (sheet, row, column, rows of values)."""
    texts, blocks = [], []
    for sheet, row, column, values in changes:
        # An integer beyond 32 bits is nothing that a cell takes.
        values = ["" if value is None else value if isinstance(value, str) else float(value) for value in values]
        for is_text, group in itertools.groupby(enumerate(values, column), lambda place: isinstance(place[1], str)):
            group = list(group)
            if is_text:
                texts += [(sheet, row, at, text) for at, text in group if content(sheet, row, at) != text]
            elif any(content(sheet, row, at) != number for at, number in group):
                _add_block(blocks, sheet, row, group[0][0], tuple(number for _, number in group))
    return texts, [(sheet, row, column, tuple(block)) for sheet, row, column, block in blocks]


def _add_block(blocks, sheet, row, column, numbers):
    if blocks:
        last_sheet, first, last_column, block = blocks[-1]
        if (sheet, row, column) == (last_sheet, first + len(block), last_column) and len(numbers) == len(block[0]):
            block.append(numbers)
            return
    blocks.append((sheet, row, column, [numbers]))
