"""Hosts that are network namespaces, with a cable each to one switch. Making them takes root."""

import pathlib
import re
import signal
import subprocess
import threading
import time

PATIENCE = 30  # seconds, for what takes far less
SWITCH = "nezumi-switch"


def ip(*words):
    subprocess.run(["ip", *words], check=True, capture_output=True)


def inside(host, *words):
    """The words that run a program on a host."""
    return ["ip", "netns", "exec", "nezumi-" + host, *words]


class Network:
    """Namespaces and the cables between them: the interface of a host is `eth0`, its address 10.77.0.1, 2, 3 ..."""

    def __init__(self, hosts):
        self.hosts = hosts

    def __enter__(self):
        self.take_down()
        ip("netns", "add", SWITCH)
        ip("-n", SWITCH, "link", "add", "switch", "type", "bridge", "mcast_snooping", "0")
        ip("-n", SWITCH, "link", "set", "switch", "up")
        for host in self.hosts:
            ip("netns", "add", "nezumi-" + host)
            ip("-n", "nezumi-" + host, "link", "set", "lo", "up")
            ip("-n", SWITCH, "link", "add", host, "type", "veth", "peer", "name", "eth0", "netns", "nezumi-" + host)
            self.join(host)
        return self

    def __exit__(self, *_):
        self.take_down()

    def take_down(self):
        for space in ["nezumi-" + host for host in self.hosts] + [SWITCH]:
            subprocess.run(["ip", "netns", "del", space], capture_output=True)

    def join(self, host):
        """Both ends of a cable are there: they are put to use."""
        space = "nezumi-" + host
        ip("-n", SWITCH, "link", "set", host, "master", "switch", "up")
        ip("-n", space, "address", "add", f"10.77.0.{self.hosts.index(host) + 1}/24", "dev", "eth0")
        ip("-n", space, "link", "set", "eth0", "up")

    @staticmethod
    def plug(host, is_in):
        ip("-n", SWITCH, "link", "set", host, "up" if is_in else "down")


class Program:
    """A program on a host, and when it said what."""

    def __init__(self, host, *words):
        self.said = []  # (when, line)
        self.process = subprocess.Popen(inside(host, *words), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        for line in self.process.stdout:
            self.said.append((time.monotonic(), line.rstrip()))

    def when(self, text, since, patience=PATIENCE):
        """Seconds from `since` until it says this."""
        end = time.monotonic() + patience
        while time.monotonic() < end:
            for at, line in list(self.said):
                if at >= since and text in line:
                    return at - since
            time.sleep(0.005)
        raise AssertionError(f"'{text}' was not said within {patience} s:\n" + "\n".join(line for _, line in self.said))

    def lines(self, text, since=0):
        return [line for at, line in list(self.said) if at >= since and text in line]

    def never(self, text, seconds):
        time.sleep(seconds)
        assert not self.lines(text), f"'{text}' was said"

    def memory(self):
        """Bytes that it occupies."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmRSS:\s+(\d+) kB", status)[1]) << 10

    def end(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
            self.process.wait(PATIENCE)
        self.reader.join(PATIENCE)


def why_none():
    """Why there can be no such network here; nothing when there can be."""
    try:
        with Network([]):
            return None
    except (OSError, subprocess.CalledProcessError) as problem:
        return f"no network namespaces can be made here: {problem}"
