"""The console's protocol, as a client speaks it: requests and events as lines of JSON over a socket."""

import json
import select
import socket
import time


class Ended(Exception):
    """The system at the other end is gone."""


class Console:
    """One console of a running system, by a socket that is connected already."""

    def __init__(self, descriptor):
        self._socket = socket.socket(fileno=descriptor)
        self._socket.setblocking(True)
        self._begun = b""
        self._last_id = 0
        self._pending = None  # the request that has no answer yet
        self._outputs = []
        self._errors = []
        self._send({"do": "hello", "who": "spreadsheet"})

    @property
    def is_waiting(self):
        """An answer is still to come."""
        return self._pending is not None

    def ask(self, text, patience):
        """Runs Lua there. Returns what it printed, as one text, or None when there is no answer within `patience`
        seconds: the next call then waits for that one instead. An error of the text raises RuntimeError."""
        if self._pending is None:
            self._last_id += 1
            self._pending = self._last_id
            self._outputs, self._errors = [], []
            self._send({"do": "eval", "id": self._last_id, "text": text})
        end = time.monotonic() + patience
        while True:
            for event in self._events(end):
                kind = event.get("is")
                if kind == "bye":
                    raise Ended
                if kind == "output":
                    self._outputs.append(event.get("text", ""))
                elif kind == "error":
                    self._errors.append(event.get("text", ""))
                elif kind == "answer" and event.get("id") == self._pending:
                    self._pending = None
                    if not event.get("ok"):
                        raise RuntimeError("\n".join(self._errors))
                    return "".join(self._outputs)
            if time.monotonic() >= end:
                return None

    def _send(self, request):
        try:
            self._socket.sendall(json.dumps(request).encode() + b"\n")
        except OSError:
            raise Ended from None

    def _events(self, end):
        """The events of the next piece that comes before `end`; none when nothing comes."""
        if not select.select([self._socket], [], [], max(0.0, end - time.monotonic()))[0]:
            return []
        try:
            piece = self._socket.recv(1 << 16)
        except OSError:
            piece = b""
        if not piece:
            raise Ended
        *lines, self._begun = (self._begun + piece).split(b"\n")
        return [json.loads(line) for line in lines if line]


def lua(value):
    """A value as Lua writes it. Texts are written byte by byte: whatever is in a cell stays a text."""
    if value is None:
        return "nil"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 2.0**53 else repr(value)
    if isinstance(value, str):
        plain = (chr(b) if 32 <= b < 127 and b not in b'"\\' else "\\%03d" % b for b in value.encode(errors="replace"))
        return '"' + "".join(plain) + '"'
    if isinstance(value, dict):
        return "{" + ",".join("[%s]=%s" % (lua(key), lua(element)) for key, element in value.items()) + "}"
    return "{" + ",".join(lua(element) for element in value) + "}"
