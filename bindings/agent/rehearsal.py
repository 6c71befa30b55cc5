"""What an agent writes, before it goes live: drafts, copies of the project, and the scenarios that count."""

import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile

LONGEST_TEXT = 256 * 1024  # [bytes] of a draft, and of a file that is read
LARGEST_PROJECT = 64 << 20  # [bytes] that are copied
LONGEST_TEST = 600  # [s]
NAME = re.compile(r"[a-z][a-z0-9_]{0,63}")
OTHER_FILES = re.compile(r"\b(robot_model|calibration|message|scenario|exercise)\b")


class Wrong(Exception):
    """What the agent asked for can't be done; the text says why."""


def digest(data):
    return hashlib.sha256(data).hexdigest()


def state_folder(project):
    """Where accepted scenarios and the journal are kept: outside of the project, in which the agent writes."""
    base = os.environ.get("XDG_STATE_HOME", "")
    if not os.path.isabs(base):
        base = os.path.join(os.path.expanduser("~"), ".local", "state")
    folder = os.path.join(base, "nezumi", "agent")
    os.makedirs(folder, mode=0o700, exist_ok=True)
    return os.path.join(folder, "%s-%s" % (os.path.basename(project), digest(project.encode())[:12]))


def write_beside(path, data):
    """Replaces a file whole or not at all."""
    handle, name = tempfile.mkstemp(dir=os.path.dirname(path), prefix=".", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(name, 0o644)
        os.replace(name, path)
    except OSError:
        os.unlink(name)
        raise


class Project:
    """The person's project: read here, and written at one place only, `put`."""

    def __init__(self, folder):
        self.root = os.path.realpath(folder)
        self.behaviors = os.path.join(self.root, "behaviors")
        if os.path.realpath(self.behaviors) != self.behaviors or not os.path.isdir(self.behaviors):
            raise Wrong("%s is not a project: it has no folder behaviors/ of its own" % folder)

    def files(self):
        """All files with their paths from the project's folder; none that lies outside of it, or is hidden."""
        found = []
        for folder, folders, names in os.walk(self.root):
            folders[:] = sorted(each for each in folders if not each.startswith(".") and each != "nezumi-test")
            for name in sorted(names):
                path = os.path.join(folder, name)
                if not name.startswith(".") and os.path.isfile(path) and not os.path.islink(path):
                    found.append(os.path.relpath(path, self.root))
        return found

    def read(self, path):
        """The text of a file of the project."""
        if not isinstance(path, str) or "\0" in path or len(path) > 1000:
            raise Wrong("expected the path of a file in the project")
        full = os.path.realpath(os.path.join(self.root, path))
        inside = os.path.relpath(full, self.root)
        if os.path.isabs(path) or inside.startswith("..") or any(part.startswith(".") for part in inside.split(os.sep)):
            raise Wrong("%s is not in the project" % ascii(path))
        if not os.path.isfile(full):
            raise Wrong("there is no file %s in the project" % ascii(path))
        if os.path.getsize(full) > LONGEST_TEXT:
            raise Wrong("%s has more than %d KB" % (ascii(path), LONGEST_TEXT // 1024))
        with open(full, "rb") as file:
            return file.read().decode(errors="replace")

    def path_of(self, name):
        if not isinstance(name, str) or not NAME.fullmatch(name) or name.endswith("_test"):
            raise Wrong("the name of a behaviour has small letters, digits and _, and does not end in _test")
        path = os.path.join(self.behaviors, name + ".lua")
        if os.path.islink(path) or (os.path.exists(path) and not os.path.isfile(path)):
            raise Wrong("behaviors/%s.lua is not a regular file" % name)
        return path

    def content(self, name):
        """The bytes of a behaviour, None if there is none yet."""
        path = self.path_of(name)
        if not os.path.exists(path):
            return None
        with open(path, "rb") as file:
            return file.read()

    def put(self, name, data):
        """The one place where the project is written."""
        path = self.path_of(name)
        if data is None:
            os.unlink(path)
        else:
            write_beside(path, data)

    def scenarios(self):
        """The scenario files, with the digests of their contents."""
        found = {}
        for path in self.files():
            if path.endswith("_test.lua"):
                with open(os.path.join(self.root, path), "rb") as file:
                    found[path] = digest(file.read())
        return found


class Accepted:
    """The scenarios that count: those that stood there before an agent came, and those that the person has accepted."""

    def __init__(self, project):
        self._project, self._path = project, state_folder(project.root) + ".scenarios.json"
        if not os.path.exists(self._path):
            self.accept()

    def accept(self):
        """Takes all scenarios as they are now. Returns those that did not count before."""
        try:
            before = self._read()
        except (OSError, Wrong):
            before = {}
        now = self._project.scenarios()
        write_beside(self._path, json.dumps(now, indent=1, sort_keys=True).encode())
        return sorted(path for path, content in now.items() if before.get(path) != content)

    def _read(self):
        with open(self._path) as file:
            try:
                return dict(json.load(file))
            except (ValueError, TypeError):
                raise Wrong("%s is damaged: look at the scenarios, then `nezumi mcp --accept`" % self._path) from None

    def paths(self):
        accepted = self._read()
        return sorted(path for path, content in self._project.scenarios().items() if accepted.get(path) == content)


class Copy:
    """A copy of the project in a folder of its own, with drafts in it."""

    def __init__(self, project, drafts):
        self._folder = tempfile.TemporaryDirectory(prefix="nezumi-agent-")
        self.root = os.path.join(self._folder.name, os.path.basename(project.root) or "project")
        size = 0
        for path in project.files():
            source = os.path.join(project.root, path)
            size += os.path.getsize(source)
            if size > LARGEST_PROJECT:
                self.close()
                raise Wrong("the project has more than %d MB: it can't be copied" % (LARGEST_PROJECT >> 20))
            target = os.path.join(self.root, path)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copyfile(source, target)
        for name, text in drafts.items():
            with open(os.path.join(self.root, "behaviors", name + ".lua"), "wb") as file:
                file.write(text.encode())

    def close(self):
        self._folder.cleanup()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Rehearsal:
    """The drafts of one agent."""

    def __init__(self, program, project):
        self.program, self.project, self.accepted = program, project, Accepted(project)
        self.drafts, self._begun_from, self._before = {}, {}, {}
        self.running = None  # the process that a cancelled request ends

    def run(self, *words, folder, limit=LONGEST_TEST):
        """Runs nezumi. Returns its exit status and what it said."""
        environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        with tempfile.TemporaryFile() as said:
            self.running = subprocess.Popen([self.program, *words], cwd=folder, stdin=subprocess.DEVNULL, stdout=said,
                                            stderr=said, env=environment, start_new_session=True)
            try:
                status = self.running.wait(limit)
            except subprocess.TimeoutExpired:
                status = None
            finally:
                self.end_running()
            said.seek(0)
            text = said.read(4 << 20).decode(errors="replace")
        if status is None:
            raise Wrong("nezumi %s did not end within %d s" % (words[0], limit))
        return status, text

    def end_running(self):
        process, self.running = self.running, None
        if process is not None:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()

    def draft(self, name, text):
        """Keeps a draft and checks it. Returns what is wrong with it, "" if nothing is."""
        self.project.path_of(name)
        if not isinstance(text, str) or len(text.encode(errors="replace")) > LONGEST_TEXT or "\0" in text:
            raise Wrong("expected the text of a behaviour, of at most %d KB" % (LONGEST_TEXT // 1024))
        other = OTHER_FILES.search(re.sub(r"--[^\n]*|\"[^\"\n]*\"|'[^'\n]*'", "", text))
        if other:
            raise Wrong("only behaviours can be written: '%s' belongs to another kind of file" % other[1])
        self._begun_from[name] = self.project.content(name)
        self.drafts[name] = text.encode(errors="replace").decode()
        with Copy(self.project, self.drafts) as copy:
            return self.check(copy, name)

    def check(self, copy, name):
        status, said = self.run("check", "behaviors/%s.lua" % name, folder=copy.root, limit=60)
        return "" if status == 0 else said or "the check ended with status %d" % status

    def scenarios_for(self, name):
        """The scenarios that count and lead to a behaviour: they name it, or a system that does."""
        texts = {path: self.project.read(path) for path in self.project.files() if path.endswith(".lua")}
        words = {path: set(re.findall(r"[\"'](?:[\w./]*/)?([\w]+)(?:\.lua)?[\"']", text)) for path, text in texts.items()}
        naming = {os.path.basename(path)[:-4] for path, named in words.items()
                  if name in named and not path.endswith("_test.lua")}
        return [path for path in self.accepted.paths() if name in words[path] or words[path] & naming]

    def go_live(self, name):
        """Rehearses a draft, and writes it into the project if it passes. Returns what the rehearsal said."""
        if name not in self.drafts:
            raise Wrong("there is no draft of %s: write it first" % ascii(name))
        if self.project.content(name) != self._begun_from[name]:
            raise Wrong("behaviors/%s.lua has changed since the draft was written: read it again" % name)
        scenarios = self.scenarios_for(name)
        if not scenarios:
            raise Wrong("no scenario that counts tests %s, so it can't go live: the person writes one, or accepts yours "
                        "with `nezumi mcp --accept`" % name)
        required = re.compile(r"require\s*\(?\s*[\"']%s[\"']" % name)
        for path in self.accepted.paths():
            if required.search(self.project.read(path)):
                raise Wrong("%s requires %s: what tests can't be written by the one who is tested" % (path, name))
        text = self.drafts[name]
        with Copy(self.project, {name: text}) as copy:
            wrong = self.check(copy, name)
            if wrong:
                raise Wrong("the check refuses it: " + wrong)
            status, said = self.run("test", *scenarios, "--project", copy.root, "--coverage", "rehearsal", "-o",
                                    "rehearsal-results", folder=copy.root)
            covered = os.path.join(copy.root, "rehearsal", "lcov.info")
            ran = os.path.exists(covered) and re.search(r"^SF:.*\b%s\.lua$" % name, open(covered).read(), re.M)
        if status != 0:
            raise Wrong("its scenarios do not pass:\n" + said)
        if not ran:
            raise Wrong("its scenarios pass without running it: %s" % ", ".join(scenarios))
        if self.project.content(name) != self._begun_from[name] or self.drafts.get(name) != text:
            raise Wrong("behaviors/%s.lua has changed during the rehearsal: read it again" % name)
        self._before[name] = self._begun_from[name]
        self.project.put(name, text.encode())
        del self.drafts[name]
        return said

    def undo(self, name):
        """Puts back what stood there before `go_live`."""
        if name not in self._before:
            raise Wrong("%s has not gone live in this session" % ascii(name))
        self.project.put(name, self._before.pop(name))
