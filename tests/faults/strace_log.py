"""Reads what strace -f -y tells of a program's system calls."""

import re


def whole_calls(log):
    """Each call with its thread, in the order of their ends. strace writes a call in two parts where another thread's comes between."""
    begun = {}
    for line in log.splitlines():
        thread, _, text = line.partition(" ")
        text = text.lstrip()
        if text.endswith("<unfinished ...>"):
            begun[thread] = text.removesuffix("<unfinished ...>")
            continue
        resumed = re.match(r"<\.\.\. \w+ resumed>(.*)", text)
        yield thread, begun.pop(thread, "") + resumed[1] if resumed else text


def failed_below_libwebsockets(log):
    """Whether a call was made to fail that fails in no kernel, and that libwebsockets does not get over: that its wake-up is read,
    which it then frees and uses, or that its listening socket is made to wait for nobody, for which it then waits. Those are its
    own alone: only it has sockets of TCP, and only the thread that polls a listening one reads its wake-up."""
    listening = set()
    serving = set()
    wakened = set()
    for thread, call in whole_calls(log):
        made = re.match(r"socket\(AF_INET6?, SOCK_STREAM.* = \d+<(socket:\[\d+\])>", call)
        if made:
            listening.add(made[1])
        elif re.match(r"p?poll\(", call) and not listening.isdisjoint(re.findall(r"<(socket:\[\d+\])>", call)):
            serving.add(thread)
        elif "(INJECTED)" in call:
            told = re.match(r"fcntl\(\d+<(.*?)>, F_SETFL", call)
            if told and told[1] in listening:
                return True
            if re.match(r"read\(\d+<anon_inode:\[eventfd\]", call):
                wakened.add(thread)
    return not serving.isdisjoint(wakened)
