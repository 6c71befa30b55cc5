"""Hosts that are network namespaces, with a cable each to one switch. Making them takes root."""

import subprocess

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


def why_none():
    """Why there can be no such network here; nothing when there can be."""
    try:
        with Network([]):
            return None
    except (OSError, subprocess.CalledProcessError) as problem:
        return f"no network namespaces can be made here: {problem}"
