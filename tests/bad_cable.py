"""A cable of a virtual network that loses, doubles, delays and reorders packets, as a seed says."""

import ctypes
import fcntl
import heapq
import itertools
import os
import random
import select
import struct
import threading
import time

from virtual_network import SWITCH, ip

LOSS, DOUBLED, OVERTAKEN = 0.05, 0.02, 0.05  # parts of all packets, each way
DELAY, HELD = 0.005, 0.02  # seconds: of all packets, and besides of those that others overtake
CLONE_NEWNET = 0x40000000
TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x400454CA, 0x0002, 0x1000
LONGEST = 65536  # bytes of a packet


def open_tap(space, name):
    """A network device of a namespace whose packets are read and written here."""
    opened = []

    def there():  # in a thread of its own, which alone is moved
        with open(f"/run/netns/{space}", encoding="ascii") as it:
            if ctypes.CDLL(None, use_errno=True).setns(it.fileno(), CLONE_NEWNET) != 0:
                return
        device = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
        fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH22x", name.encode(), IFF_TAP | IFF_NO_PI))
        opened.append(device)

    thread = threading.Thread(target=there)
    thread.start()
    thread.join()
    if not opened:
        raise OSError(f"no TAP device can be made in {space}")
    return opened[0]


class Way:
    """One direction: the packets that are on their way."""

    def __init__(self, source, sink, seed):
        self.source, self.sink, self.random = source, sink, random.Random(seed)
        self.waiting, self.order = [], itertools.count()
        self.counts = {"sent": 0, "lost": 0, "doubled": 0, "overtaken": 0}

    def take(self, now):
        packet = os.read(self.source, LONGEST)
        lost, doubled, overtaken = (self.random.random() < part for part in (LOSS, DOUBLED, OVERTAKEN))
        for what, it_is in (("sent", True), ("lost", lost), ("doubled", doubled), ("overtaken", overtaken)):
            self.counts[what] += it_is
        if not lost:
            for _ in range(1 + doubled):
                heapq.heappush(self.waiting, (now + DELAY + HELD * overtaken, next(self.order), packet))

    def give(self, now):
        while self.waiting and self.waiting[0][0] <= now:
            try:
                os.write(self.sink, heapq.heappop(self.waiting)[2])
            except OSError:
                pass  # a device that is down


class BadCable:
    """Takes the place of a host's cable until it ends; `counts`: what became of the packets, to the host and from it."""

    def __init__(self, network, host, seed):
        ip("-n", SWITCH, "link", "delete", host)
        self.devices = [open_tap("nezumi-" + host, "eth0"), open_tap(SWITCH, host)]
        network.join(host)
        inner, outer = self.devices
        self.ways = [Way(outer, inner, seed), Way(inner, outer, seed + 1)]
        self.is_over = threading.Event()
        self.thread = threading.Thread(target=self.carry, daemon=True)
        self.thread.start()

    @property
    def counts(self):
        return [way.counts for way in self.ways]

    def carry(self):
        by_source = {way.source: way for way in self.ways}
        while not self.is_over.is_set():
            due = min((way.waiting[0][0] for way in self.ways if way.waiting), default=time.monotonic() + 0.1)
            ready = select.select(list(by_source), [], [], max(0, due - time.monotonic()))[0]
            now = time.monotonic()
            for source in ready:
                by_source[source].take(now)
            for way in self.ways:
                way.give(now)

    def end(self):
        self.is_over.set()
        self.thread.join()
        for device in self.devices:
            os.close(device)
