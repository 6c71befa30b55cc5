"""A console client for the spreadsheet's link: one request at a time; its answer may come later."""

import importlib.util
import os
import socket
import time


def _load_client():
    """The client in Python, in the source tree or as it is installed. Not one from elsewhere: it belongs to this
    program; and nothing else of its folder, where other people's modules may be."""
    here = os.path.dirname(os.path.abspath(__file__))
    files = [os.path.join(here, folder, "nezumi.py") for folder in ("../python", "../../../../lib/python3/dist-packages")]
    spec = importlib.util.spec_from_file_location("nezumi", next(filter(os.path.exists, files), files[-1]))
    client = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(client)
    return client


client = _load_client()
Ended, Lines, lua = client.Ended, client.Lines, client.lua


class Console:
    """One console of a running system, by a socket that is connected already."""

    def __init__(self, descriptor):
        connection = socket.socket(fileno=descriptor)
        connection.setblocking(True)
        self._lines = Lines(connection)
        self._last_id = 0
        self._pending = None  # the request that has no answer yet
        self._outputs = []
        self._errors = []
        self._lines.send({"do": "hello", "who": "spreadsheet"})

    @property
    def is_waiting(self):
        """True while an answer is missing."""
        return self._pending is not None

    def ask(self, text, patience):
        """Runs Lua there. Returns what it printed, as one text, or None when there is no answer within `patience`
        seconds: the next call then waits for that one instead. An error of the text raises RuntimeError."""
        if self._pending is None:
            self._last_id += 1
            self._pending = self._last_id
            self._outputs, self._errors = [], []
            self._lines.send({"do": "eval", "id": self._last_id, "text": text})
        end = time.monotonic() + patience
        while True:
            for event in self._lines.events(end):
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
