"""Firefox without a window, spoken to in its own protocol: Marionette, JSON over a socket. Debian has no geckodriver."""

import json
import os
import shutil
import socket
import subprocess
import tempfile
import time


class Firefox:
    def __init__(self):
        self.profile = tempfile.mkdtemp(prefix="nezumi-firefox-")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        with open(os.path.join(self.profile, "user.js"), "w") as prefs:
            for name, value in (("marionette.port", port), ("datareporting.policy.dataSubmissionEnabled", False), ("app.update.enabled", False),
                                ("browser.shell.checkDefaultBrowser", False), ("intl.accept_languages", "en-US")):
                prefs.write("user_pref(%s, %s);\n" % (json.dumps(name), json.dumps(value)))
        self.process = subprocess.Popen(["firefox-esr", "--headless", "--marionette", "--no-remote", "--profile", self.profile],
                                        env=dict(os.environ, HOME=self.profile), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.socket = self.connect(port)
        self.got = b""
        self.number = 0
        self.receive()  # the greeting
        self.ask("WebDriver:NewSession", capabilities={})
        self.ask("WebDriver:SetTimeouts", script=120000)

    def connect(self, port):
        end = time.monotonic() + 60
        while True:
            try:
                return socket.create_connection(("127.0.0.1", port), 180)
            except OSError:
                if time.monotonic() > end or self.process.poll() is not None:
                    self.close()
                    raise
                time.sleep(0.2)

    def receive(self):
        while b":" not in self.got or len(self.got) < self.got.index(b":") + 1 + int(self.got[:self.got.index(b":")]):
            piece = self.socket.recv(1 << 16)
            if not piece:
                raise OSError("firefox has closed the connection")
            self.got += piece
        begin = self.got.index(b":") + 1
        end = begin + int(self.got[:begin - 1])
        message, self.got = json.loads(self.got[begin:end]), self.got[end:]
        return message

    def ask(self, command, **arguments):
        self.number += 1
        data = json.dumps([0, self.number, command, arguments]).encode()
        self.socket.sendall(b"%d:%s" % (len(data), data))
        _, number, error, result = self.receive()
        assert number == self.number
        if error:
            raise AssertionError("%s: %s" % (command, error.get("message", error)))
        return result

    def open(self, url):
        self.ask("WebDriver:Navigate", url=url)

    def js(self, code, *arguments):
        return self.ask("WebDriver:ExecuteScript", script=code, args=list(arguments))["value"]

    def wait_for(self, code, *arguments):
        """What an asynchronous function with this body gives."""
        wrapped = "const done = arguments[arguments.length - 1]; (async (...args) => {" + code + "})(...arguments).then(done, (no) => done(String(no)))"
        return self.ask("WebDriver:ExecuteAsyncScript", script=wrapped, args=list(arguments))["value"]

    def picture(self):
        """A screenshot as base64."""
        return self.ask("WebDriver:TakeScreenshot", full=False)["value"]

    def close(self):
        self.process.terminate()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        if hasattr(self, "socket"):
            self.socket.close()
        shutil.rmtree(self.profile, ignore_errors=True)
