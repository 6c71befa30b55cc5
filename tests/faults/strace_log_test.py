"""What is made of strace's log: calls in two parts, and which failures are libwebsockets' own."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from strace_log import failed_below_libwebsockets, whole_calls

# A page is served by thread 15, on socket 785; 10 is the first thread, 12 one that has nothing to do with it.
SERVED = """10 socket(AF_UNIX, SOCK_STREAM|SOCK_CLOEXEC|SOCK_NONBLOCK, 0) = 8<socket:[748]>
10    socket(AF_INET6, SOCK_STREAM, IPPROTO_IP <unfinished ...>
12    poll([{fd=7<anon_inode:[eventfd]>, events=POLLIN}, {fd=8<socket:[748]>, events=POLLIN}], 2, -1 <unfinished ...>
10    <... socket resumed>)             = 14<socket:[785]>
10    fcntl(14<socket:[785]>, F_SETFL, O_RDONLY|O_NONBLOCK) = 0
15    poll([{fd=13<anon_inode:[eventfd]>, events=POLLIN}, {fd=14<socket:[785]>, events=POLLIN}], 2, 9999 <unfinished ...>
15    <... poll resumed>)               = 1 ([{fd=13, revents=POLLIN}])
12    <... poll resumed>)               = 1 ([{fd=7, revents=POLLIN}])
"""
FAILED = "= -1 EMFILE (Too many open files) (INJECTED)"
KILLED = """10    --- SIGSEGV {si_signo=SIGSEGV, si_code=SEGV_MAPERR, si_addr=0x55f17b406} ---
12    <... ppoll resumed> <unfinished ...>) = ?
15    +++ killed by SIGSEGV +++
"""


class StraceLogTest(unittest.TestCase):
    def left_out(self, *lines):
        return failed_below_libwebsockets(SERVED + "\n".join(lines) + "\n" + KILLED)

    def test_a_call_in_two_parts_is_one(self):
        log = "10    read(3</a b>,  <unfinished ...>\n9     close(4)   = 0\n10    <... read resumed>\"x\", 8) = 1\n"
        self.assertEqual(list(whole_calls(log)), [("9", "close(4)   = 0"), ("10", 'read(3</a b>,  "x", 8) = 1')])

    def test_a_call_that_the_end_interrupts_is_told(self):
        self.assertEqual(list(whole_calls("10 poll([], 0, 9 <unfinished ...>\n10 <... poll resumed> <unfinished ...>) = ?\n")),
                         [("10", "poll([], 0, 9  <unfinished ...>) = ?")])

    def test_nothing_failed(self):
        self.assertFalse(self.left_out("15    read(13<anon_inode:[eventfd]>, \"\\1\\0\\0\\0\\0\\0\\0\\0\", 8) = 8"))

    def test_the_read_of_its_wake_up(self):
        self.assertTrue(self.left_out(f"15    read(13<anon_inode:[eventfd]>, 0x7f, 8) {FAILED}"))

    def test_the_read_of_its_wake_up_in_two_parts(self):
        self.assertTrue(self.left_out("15    read(13<anon_inode:[eventfd]>,  <unfinished ...>", "10    write(13, \"\", 8) = 8",
                                      f"15    <... read resumed>0x7f, 8) {FAILED}"))

    def test_the_read_of_its_wake_up_before_it_is_seen_to_serve(self):
        first, second = SERVED.splitlines(), SERVED.splitlines()
        log = [*first[:5], f"15    read(13<anon_inode:[eventfd]>, 0x7f, 8) {FAILED}", *second[5:]]
        self.assertTrue(failed_below_libwebsockets("\n".join(log)))

    def test_reads_of_our_own_eventfds_are_judged(self):
        self.assertFalse(self.left_out(f"10    read(4<anon_inode:[eventfd]>, 0x7f, 8) {FAILED}",
                                       f"12    read(7<anon_inode:[eventfd]>, 0x7f, 8) {FAILED}"))
        self.assertFalse(self.left_out("12    read(7<anon_inode:[eventfd]>,  <unfinished ...>",
                                       "15    read(13<anon_inode:[eventfd]>, \"\", 8) = 8", f"12    <... read resumed>0x7f, 8) {FAILED}"))

    def test_what_else_its_thread_reads_is_judged(self):
        self.assertFalse(self.left_out(f"15    read(16</page/index.html>, 0x7f, 65536) {FAILED}"))

    def test_making_its_listening_socket_wait_for_nobody(self):
        self.assertTrue(self.left_out(f"10    fcntl(14<socket:[785]>, F_SETFL, O_RDONLY|O_NONBLOCK) {FAILED}"))
        self.assertTrue(self.left_out("10    fcntl(14<socket:[785]>, F_SETFL, O_RDONLY|O_NONBLOCK <unfinished ...>",
                                      f"10    <... fcntl resumed>)              {FAILED}"))

    def test_other_calls_about_sockets_are_judged(self):
        self.assertFalse(self.left_out(f"10    fcntl(8<socket:[748]>, F_SETFL, O_RDWR|O_NONBLOCK) {FAILED}",
                                       f"15    fcntl(17<socket:[990]>, F_SETFL, O_RDONLY|O_NONBLOCK) {FAILED}",
                                       f"10    fcntl(14<socket:[785]>, F_SETFD, FD_CLOEXEC) {FAILED}"))


if __name__ == "__main__":
    unittest.main()
