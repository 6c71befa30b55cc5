"""What the tests of the spreadsheet's link run: a real office without a window, real systems, real links."""

import glob
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import uno
    from com.sun.star.beans import PropertyValue
    from com.sun.star.uno import Exception as UnoException
except ImportError:
    uno = None

ALONE = 'behavior "controller" { script = "robot_controller", config = { speed_x = 0.2 } }\n'
MOUSE = 'robot "mouse" { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }\n'
CONTROLLER = [
    ["nezumi"],
    ["Port", "State", 1, 2, 3, 4],
    ["controller.in"],
    [],
    ["Port", "State", "vx [m/s]", "va"],
    ["controller.out"],
]
STANDS = "math.abs(mouse.truth.velocity.vx) < 0.001"
DRIVE = [["Port", "State", "vx", "va"], ["mouse.target_velocity_in"]]
PATIENCE = 240  # [s] for anything to happen: machines may be slow, and busy: the office alone took more than 90 to start


def explain_missing():
    """Why the tests can't run; None when they can."""
    if uno is None or shutil.which("soffice") is None:
        return "the spreadsheet link's tests need Debian's libreoffice-calc and python3-uno: tests/long installs them"
    return None


def wait_until(condition, what):
    """Waits until the condition gives something true, and returns it."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError("waited %d s in vain: %s" % (PATIENCE, what() if callable(what) else what))


def pipes():
    """The sockets of this user's offices."""
    return glob.glob("/tmp/OSL_PIPE_%d_*" % os.geteuid())


def remove_if_dead(pipe):
    """An office that is killed leaves its sockets behind."""
    with socket.socket(socket.AF_UNIX) as connection:
        try:
            connection.connect(pipe)
        except ConnectionRefusedError:
            os.unlink(pipe)
        except OSError:
            pass


def offices_of(folder):
    """The processes of offices whose settings are in this folder."""
    found = []
    for line in glob.glob("/proc/[0-9]*/cmdline"):
        try:
            with open(line, encoding="utf-8", errors="replace") as file:
                if "-env:UserInstallation=" + uno.systemPathToFileUrl(folder) + "/" in file.read():
                    found.append(int(line.split("/")[2]))
        except OSError:
            pass  # it has ended
    return found


class Place:
    """A scratch folder, with sockets, settings and systems of its own."""

    def __init__(self, nezumi):
        self.nezumi = nezumi
        self.folder = tempfile.mkdtemp(prefix="nezumi-calc-")
        os.mkdir(os.path.join(self.folder, "runtime"), 0o700)
        self.environment = dict(os.environ, XDG_RUNTIME_DIR=self.path("runtime"), HOME=self.folder, TMPDIR=self.folder)
        self.processes = []

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def start(self, words, name, environment=None):
        """Starts a program whose output goes to a file, `said(name)`."""
        with open(self.path(name + ".log"), "wb") as log:
            process = subprocess.Popen(
                words,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                env=environment or self.environment,
                start_new_session=True,
            )
        self.processes.append(process)
        return process

    def said(self, name):
        with open(self.path(name + ".log"), encoding="utf-8", errors="replace") as log:
            return log.read()

    def remove(self):
        for process in self.processes:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
        for process in offices_of(self.folder):  # that links started
            os.kill(process, signal.SIGKILL)
        shutil.rmtree(self.folder, ignore_errors=True)
        for pipe in pipes():
            remove_if_dead(pipe)


class System:
    """A system that runs."""

    count = 0

    def __init__(self, place, text):
        System.count += 1
        self.place, self.name = place, "system_%d" % System.count
        file = place.write(self.name + ".lua", text)
        self.process = place.start([place.nezumi, "run", file, "--headless"], self.name)
        wait_until(lambda: self.ask("1 + 1") == "2", lambda: "%s listens: %s" % (self.name, place.said(self.name)))

    def ask(self, text):
        """What the console says to this, in one line."""
        words = [self.place.nezumi, "attach", self.name, "--eval", text]
        done = subprocess.run(
            words, env=self.place.environment, stdin=subprocess.DEVNULL, capture_output=True, check=False
        )
        return (done.stdout + done.stderr).decode().strip()

    def end(self):
        self.process.terminate()
        self.process.wait(PATIENCE)


class Office:
    """An office without a window, with a profile in the scratch folder."""

    def __init__(self, place, profile="profile"):
        self.place, self.profile = place, place.path(profile)
        self.process = self._call()
        self._pipe = self.process.pipe
        context = uno.getComponentContext()
        resolver = context.ServiceManager.createInstanceWithContext("com.sun.star.bridge.UnoUrlResolver", context)
        remote = wait_until(lambda: self._resolve(resolver), lambda: "the office starts: " + place.said(self._pipe))
        self.desktop = remote.ServiceManager.createInstanceWithContext("com.sun.star.frame.Desktop", remote)

    def _call(self):
        pipe = "nezumi-test-%d-%d" % (os.getpid(), len(self.place.processes))
        words = [
            "soffice",
            "-env:UserInstallation=" + uno.systemPathToFileUrl(self.profile),
            "--headless",
            "--norestore",
        ]
        process = self.place.start(words + ["--nodefault", "--accept=pipe,name=%s;urp;" % pipe], pipe)
        process.pipe = pipe
        return process

    def _resolve(self, resolver):
        try:
            return resolver.resolve("uno:pipe,name=%s;urp;StarOffice.ComponentContext" % self._pipe)
        except UnoException:
            return None

    def write_sheet(self, name, rows):
        """Writes a file with these rows of cells: formulas, numbers, texts."""
        document = self.desktop.loadComponentFromURL("private:factory/scalc", "_blank", 0, (_hidden(),))
        for at, row in enumerate(rows):
            for column, content in enumerate(row):
                put(document.Sheets.getByIndex(0).getCellByPosition(column, at), content)
        path = self.place.path(name)
        document.storeToURL(uno.systemPathToFileUrl(path), ())
        document.close(True)
        return path

    def documents(self):
        found = []
        components = self.desktop.Components.createEnumeration()
        while components.hasMoreElements():
            found.append(components.nextElement())
        return found

    def kill(self):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


class Link:
    """`nezumi calc`, and the document that it linked."""

    count = 0

    def __init__(self, office, system, *words):
        Link.count += 1
        self.place, self.name = office.place, "link_%d" % Link.count
        before = len(office.documents())
        self.process = self.place.start(
            [self.place.nezumi, "calc", "--headless", "--profile", office.profile, "--system", system.name, *words],
            self.name,
        )
        wait_until(lambda: "is linked with" in self.said() or self.process.poll() is not None, self.said)
        if self.process.poll() is not None:
            raise AssertionError("the link ended: " + self.said())
        documents = office.documents()
        assert len(documents) == before + 1, "one document more"
        self.document = documents[0] if before == 0 else documents[-1]
        self.sheet = self.document.Sheets.getByIndex(0)

    def said(self):
        return self.place.said(self.name)

    def cell(self, name):
        return self.sheet.getCellRangeByName(name)

    def put(self, name, content):
        put(self.cell(name), content)

    def shows(self, name, text):
        """Waits until a cell shows this text."""
        wait_until(lambda: self.cell(name).getString() == text, lambda: "%s shows %r: %r" % (name, text, self.text()))

    def text(self):
        """All cells, to be read when something is wrong."""
        cursor = self.sheet.createCursor()
        cursor.gotoEndOfUsedArea(False)
        end = cursor.getRangeAddress()
        return self.sheet.getCellRangeByPosition(0, 0, end.EndColumn, end.EndRow).getDataArray()

    def end(self):
        self.process.terminate()
        return self.wait()

    def wait(self):
        """Its exit status."""
        return self.process.wait(PATIENCE)

    def close(self):
        """Ends whatever is left of it."""
        self.process.terminate()
        self.process.wait(PATIENCE)
        try:
            self.document.close(True)
        except UnoException:
            pass


def put(cell, content):
    if isinstance(content, str) and not content.startswith("="):
        cell.setString(content)
    elif isinstance(content, str):
        cell.setFormula(content)
    else:
        cell.setValue(content)


def _hidden():
    hidden = PropertyValue()
    hidden.Name, hidden.Value = "Hidden", True
    return hidden


class OfficeCase(unittest.TestCase):
    """Each test has systems and sheets of its own, all in one office."""

    nezumi = ""  # the program

    @classmethod
    def setUpClass(cls):
        cls.place = Place(cls.nezumi)
        cls.addClassCleanup(cls.place.remove)
        cls.office = Office(cls.place)

    def system(self, text):
        system = System(self.place, text)
        self.addCleanup(system.end)
        return system

    def link(self, system, rows, *words):
        file = self.office.write_sheet(self.id().rsplit(".", 1)[-1] + ".ods", rows)
        link = Link(self.office, system, file, *words)
        self.addCleanup(link.close)
        return link


def main():
    if explain_missing():
        sys.exit("SKIPPED: " + explain_missing())  # as ctest knows a skipped test
    OfficeCase.nezumi = os.path.abspath(sys.argv.pop(1))
    unittest.main(verbosity=2)
