"""Consoles of running systems from Python: attach to one, or start one, look at it, act on it, move its time.

    with nezumi.start("behaviors/systems/stop_at_wall.lua", seed=1) as console:
        console.step(100)
        print(console.eval("mouse.truth.pose.position"))

The standard library is all that is needed. One console is for one thread; a system may have many consoles.
"""

import collections
import json
import os
import re
import select
import shutil
import socket
import stat
import struct
import subprocess
import threading
import time

__all__ = ["Console", "Ended", "Error", "Refused", "System", "Timeout", "attach", "lua", "start", "systems"]


class Error(Exception):
    """Something of this module went wrong."""


class Refused(Error):
    """What was asked is wrong: the message is what the console says."""


class Timeout(Error):
    """No answer in time; what ran was interrupted."""


class Ended(Error):
    """The run has ended, or can't be reached."""


System = collections.namedtuple("System", "name process path")


def console_folder():
    """Where this user's systems listen."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    if os.path.isabs(runtime) and os.path.isdir(runtime) and os.stat(runtime).st_uid == os.geteuid():
        return os.path.join(runtime, "nezumi")
    return "/tmp/nezumi-%d" % os.geteuid()


def systems():
    """The systems of this user that listen, by name and process."""
    try:
        names = os.listdir(console_folder())
    except FileNotFoundError:
        return []
    found = []
    for name in names:
        parts = re.fullmatch(r"([^.].*)-(\d+)\.sock", name)
        if parts and os.path.exists("/proc/" + parts[2]):
            found.append(System(parts[1], int(parts[2]), os.path.join(console_folder(), name)))
    return sorted(found)


def _connect(system):
    """A socket to a system. It is reached through its folder's descriptor: a path to a socket may have 107 bytes only."""
    try:
        folder = os.open(os.path.dirname(system.path), os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    except OSError as wrong:
        raise Ended("%s (process %d) can't be reached: %s" % (system.name, system.process, wrong.strerror)) from None
    try:
        status = os.fstat(folder)
        if status.st_uid != os.geteuid() or stat.S_IMODE(status.st_mode) & 0o077:
            raise Error("%s is open to others: it should be this user's alone" % os.path.dirname(system.path))
        connection = socket.socket(socket.AF_UNIX)
        try:
            # Its name may be longer than an address: the socket itself is opened, which gives it a short one.
            file = os.open(os.path.basename(system.path), os.O_PATH | os.O_NOFOLLOW, dir_fd=folder)
            try:
                connection.connect("/proc/self/fd/%d" % file)
            finally:
                os.close(file)
            credentials = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, struct.calcsize("3i"))
            if struct.unpack("3i", credentials)[1] != os.geteuid():
                raise Error("%s (process %d) belongs to another user" % (system.name, system.process))
        except OSError as wrong:
            connection.close()
            raise Ended("%s (process %d) can't be reached: %s" % (system.name, system.process, wrong.strerror)) from None
        except Error:
            connection.close()
            raise
        return connection
    finally:
        os.close(folder)


def attach(which="", timeout=10.0, who=""):
    """A console of a running system: `which` is its name, its file or its process, and may be left out when only one
    runs. `who`: "agent" if a program acts on its own: journals and ports say so, and its holds end with it."""
    running = systems()
    if not running:
        raise Ended("nothing is running: start a system with `nezumi run FILE`")
    which = str(which)
    name = os.path.basename(which)[:-4] if which.endswith(".lua") else which
    fitting = [each for each in running if which == "" or each.name == name or str(each.process) == which]
    listed = ", ".join("%s (process %d)" % (each.name, each.process) for each in fitting or running)
    if not fitting:
        raise Ended("no system '%s' is running; running: %s" % (which, listed))
    if len(fitting) > 1:
        raise Error("several systems are running, choose one by its name or process number: %s" % listed)
    return Console(_connect(fitting[0]), timeout, who=who)


def start(file, *options, seed=None, program="nezumi", timeout=10.0, folder=None):
    """Starts `nezumi run FILE --batch` and gives its console. Time stands still unless `step` or `advance` moves it, and
    then passes as fast as possible; the same calls give the same run. The run ends with the console."""
    words = [shutil.which(program) or program, "run", str(file), "--batch", *options]
    if seed is not None:
        words += ["--seed", str(seed)]
    try:
        process = subprocess.Popen(  # its input stays open as long as it is to run
            words, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, cwd=folder
        )
    except OSError as wrong:
        raise Ended("%s can't be started: %s" % (words[0], wrong.strerror)) from None
    said = collections.deque(maxlen=100)
    reader = threading.Thread(target=lambda: said.extend(process.stderr), daemon=True)
    reader.start()
    end = time.monotonic() + timeout
    while process.poll() is None:
        for system in systems():
            if system.process == process.pid:
                return Console(_connect(system), timeout, process, reader)
        if time.monotonic() > end:
            process.kill()
            process.wait()
            process.stdin.close()
            raise Timeout("%s did not begin within %g s" % (file, timeout))
        time.sleep(0.002)
    reader.join()
    process.stdin.close()
    process.stderr.close()
    raise Ended(b"".join(said).decode(errors="replace").strip() or "the run of %s ended immediately" % file)


# Runs in the console: values as JSON, in pieces, as `print` shortens long texts. Each has the request's number.
_PRELUDE = r"""
local function quoted(text)
  local is_text = utf8.len(text)
  return '"' .. text:gsub(is_text and '[%c"\\]' or '[%c"\\\x80-\xff]', function(c) return ("\\u%04x"):format(c:byte()) end) .. '"'
end
local function json(value, depth)
  local kind = math.type(value) or type(value)
  if depth > 50 then error("a value within itself, or more than 50 deep", 0) end
  if value == nil then return "null" end
  if kind == "integer" or kind == "boolean" then return tostring(value) end
  if kind == "float" then
    if value ~= value then return "NaN" end
    return math.abs(value) < math.huge and ("%.17g"):format(value) or value > 0 and "Infinity" or "-Infinity"
  end
  if kind == "string" then return quoted(value) end
  if kind ~= "table" then error("a " .. kind .. " has no form in Python: ask for its fields", 0) end
  local parts = {}
  if next(value) == nil or value[1] ~= nil then
    for i, element in ipairs(value) do parts[i] = json(element, depth + 1) end
    return "[" .. table.concat(parts, ",") .. "]"
  end
  for key, element in pairs(value) do parts[#parts + 1] = quoted(tostring(key)) .. ":" .. json(element, depth + 1) end
  return "{" .. table.concat(parts, ",") .. "}"
end
function nezumi_answer(number, ...)
  local text = select("#", ...) > 1 and json({ ... }, 0) or json((...), 0)
  local at = 1
  while at <= #text do
    local last = math.min(at + 1499, #text)
    while last < #text and text:byte(last + 1) & 0xC0 == 0x80 do last = last - 1 end
    print("nezumi#" .. number .. " " .. text:sub(at, last))
    at = last + 1
  end
end
"""


class Lines:
    """What every client of the console has: requests and events as lines of JSON over a connected socket."""

    def __init__(self, connection):
        self._socket = connection
        self._begun = b""

    def close(self):
        self._socket.close()

    def send(self, request):
        try:
            self._socket.sendall(json.dumps(request).encode() + b"\n")
        except OSError:
            raise Ended("the run has ended") from None

    def events(self, end):
        """The events of the next piece that comes before `end`; none when nothing comes."""
        try:
            if not select.select([self._socket], [], [], max(0.0, end - time.monotonic()))[0]:
                return []
            piece = self._socket.recv(1 << 16)
        except (OSError, ValueError):
            piece = b""
        if not piece:
            raise Ended("the run has ended")
        *lines, self._begun = (self._begun + piece).split(b"\n")
        return [json.loads(line) for line in lines if line]


class Console:
    """One console of a running system."""

    def __init__(self, connection, timeout=10.0, process=None, reader=None, who=""):
        """`connection`: a socket that is connected to a console. `process` ends with it, `reader` takes what that says."""
        self.timeout = timeout  # [s] for an answer, unless a call says otherwise
        self._lines, self._process, self._reader = Lines(connection), process, reader
        if who:
            self._lines.send({"do": "hello", "who": who})
        self._number = 0
        self._said = {}  # by request: pieces of the value, output, errors
        self.run(_PRELUDE)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Leaves the system; one that `start` began ends in good order."""
        self._lines.close()
        if self._process is None:
            return
        process, self._process = self._process, None
        process.stdin.close()
        try:
            process.wait(self.timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        self._reader.join()
        process.stderr.close()

    def eval(self, expression, timeout=None):
        """The value of an expression of Lua, as the console gives it: `eval("mouse.truth.pose.position.x")`."""
        return self.finish(self.begin(expression), timeout)

    def run(self, text, timeout=None):
        """Runs lines of Lua, as at the prompt. Returns what they printed."""
        number = self._ask(text)
        return "\n".join(self._answer(number, timeout)[1])

    def step(self, ticks=1, timeout=None):
        """Lets exactly so many ticks pass, then time stands still."""
        self.run("step(%s)" % lua(ticks), timeout)

    def advance(self, seconds, timeout=None):
        """Lets so much simulated time pass, then time stands still."""
        self.run("run(%s)" % lua(seconds), timeout)

    def look(self, port, timeout=None):
        """What a port shows: a dict of its value, tm, age, type, connected, stale, override, peers."""
        names = ("value", "tm", "age", "type", "connected", "stale", "override", "peers")
        fields = ", ".join("%s = port.%s" % (name, name) for name in names)
        text = "(function() local port = %s return { %s } end)()" % (_port(port), fields)
        return self.eval(text, timeout)

    def inject(self, port, value, timeout=None):
        """One message, as from a connection."""
        self.run("inject(%s, %s)" % (lua(port), lua(value)), timeout)

    def hold(self, port, value, take=False, timeout=None):
        """This value in every tick and nothing else, until `release`. `take`: also if another actor holds it."""
        self.run("hold(%s, %s%s)" % (lua(port), lua(value), ", { take = true }" if take else ""), timeout)

    def release(self, port, timeout=None):
        self.run("release(%s)" % lua(port), timeout)

    def set(self, component, timeout=None, **parameters):
        """Sets parameters of a component: `set("controller", speed_x=0.2)`."""
        lines = ["%s.config.%s = %s" % (component, name, lua(value)) for name, value in parameters.items()]
        self.run("\n".join(lines), timeout)

    def begin(self, expression):
        """As `eval`, without waiting: `finish` takes what this returns. So several systems can work at the same time."""
        self._number += 1
        return self._send("nezumi_answer(%d, (function() return %s\nend)())" % (self._number, expression))

    def finish(self, number, timeout=None):
        """The value of what was begun."""
        try:
            pieces, _ = self._answer(number, timeout)
        except Refused as refused:  # its lines are not the caller's
            raise Refused(re.sub(r"^line \d+: ", "", str(refused))) from None
        return json.loads("".join(pieces) or "null")

    def _ask(self, text):
        self._number += 1
        return self._send(text)

    def _send(self, text):
        self._said[self._number] = ([], [], [])
        self._lines.send({"do": "eval", "id": self._number, "text": text})
        return self._number

    def _answer(self, number, timeout):
        """The pieces of the value and the output of a request, when it is answered."""
        timeout = self.timeout if timeout is None else timeout
        end = time.monotonic() + timeout
        while True:
            for event in self._lines.events(end):
                kind, text = event.get("is"), event.get("text", "")
                running = next(iter(self._said.values()), None)  # requests are answered in their order
                if kind == "bye":
                    raise Ended(text or "the run has ended")
                if kind == "output" and running:
                    for line in text.split("\n"):
                        mark = "nezumi#%d " % next(iter(self._said))
                        (running[0] if line.startswith(mark) else running[1]).append(line.removeprefix(mark))
                elif kind == "error" and running:
                    running[2].append(text)
                elif kind == "answer":
                    pieces, output, errors = self._said.pop(event.get("id"), ([], [], []))
                    if event.get("id") != number:
                        continue
                    if not event.get("ok"):
                        raise Refused("\n".join(errors))
                    return pieces, output
            if time.monotonic() >= end:
                self._lines.send({"do": "interrupt"})
                raise Timeout("no answer within %g s" % timeout)


def _port(path):
    """How a port is written, also if its name is a keyword of Lua, as in `controller.in`."""
    component, _, name = path.partition(".")
    return "%s.ports[%s]" % (component, lua(name))


def _encoded(text):
    """The bytes of a text, those that were no UTF-8 as they were; half a character is a question mark."""
    try:
        return text.encode(errors="surrogateescape")
    except UnicodeEncodeError:
        return text.encode(errors="replace")


def lua(value):
    """A value as Lua writes it: None, booleans, numbers, texts, bytes, and lists, tuples and dicts of them."""
    if value is None:
        return "nil"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if value != value or value in (float("inf"), float("-inf")):
            return "(0/0)" if value != value else "math.huge" if value > 0 else "-math.huge"
        return repr(value)
    if isinstance(value, (str, bytes)):
        encoded = _encoded(value) if isinstance(value, str) else value
        plain = (chr(b) if 32 <= b < 127 and b not in b'"\\' else "\\%03d" % b for b in encoded)
        return '"' + "".join(plain) + '"'
    if isinstance(value, dict):
        return "{" + ",".join("[%s]=%s" % (lua(key), lua(element)) for key, element in value.items()) + "}"
    try:
        return "{" + ",".join(lua(element) for element in value) + "}"
    except TypeError:
        # Numbers of other libraries say what they are as plain ones.
        if hasattr(value, "item"):
            return lua(value.item())
        raise TypeError("a %s has no form in Lua" % type(value).__name__) from None
