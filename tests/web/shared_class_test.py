"""The shared system of a class in real browsers, and a class under load. Usage: shared_class_test.py NEZUMI [TEST...]"""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import class_test
import rig

START = os.path.join(rig.ROOT, "behaviors/exercises/part2_stop_at_wall/start")
SHARED = os.path.join(START, "behaviors/systems/part2_stop_at_wall.lua")
DRIVES = """
input("in", "TimedShortSeq")
local target = output("out", "TimedVelocity2D")
param("speed_x", 0.1)
param("of_%s", 0.2)
function on_execute() target:write { vx = config.of_%s } end
"""


def pupils_file(room, number, text):
    with open(os.path.join(room.work(number), "behaviors", "controller.lua"), "w") as out:
        out.write(text)


def shared_file(room):
    with open(os.path.join(room.folder, "shared", "behaviors", "controller.lua")) as file:
        return file.read()


class SharedCase(class_test.ClassCase):
    def setUp(self):
        self.room = self.begin(options=["--shared", SHARED])
        self.page.driver.get(self.room.url)

    def told(self, page, text, within=rig.PATIENCE):
        page.until("(document.querySelector('.shared:not([hidden]) .shared-told')?.textContent ?? '').includes(%r)" % text, "the bar says: " + text, within)

    def go(self, page):
        """From the pupil's own page to the shared one, and back."""
        before = page.js("return document.querySelector('.shared a').href")
        page.find(".shared a").click()
        page.until("(document.querySelector('.shared a')?.href ?? %r) !== %r" % (before, before), "the other page is there")
        page.ready()

    def asks_teacher(self, **request):
        _, answers = self.ask(self.room.teacher.split("#")[1], {"do": "class", "id": 1, **request})
        return answers[0]

    def tokens(self, *names):
        """The tokens of pupils at the shared system."""
        found = []
        for name in names:
            own = self.joins(name)
            result = self.page.driver.execute_async_script(
                self.ASKS.replace('if (typeof data === "string") got.push(JSON.parse(data));',
                                  'if (typeof data === "string") got.push(JSON.parse(data)); const said = got.at(-1);'
                                  'if (said?.is === "class" && said.shared) { done({ closed: false, got: [said] }); socket.close(); }'), own, [{"do": "floor", "id": 1}], True)
            found.append((own, result["got"][0]["shared"]["link"]))
        return found


class Shared(SharedCase):
    def test_pupils_drive_one_after_the_other_with_behaviours_of_their_own(self):
        room, taro, hanako = self.room, self.page, self.second()
        self.join(room, "Taro")
        self.join(room, "Hanako", hanako)
        pupils_file(room, 1, DRIVES % ("taro", "taro"))
        taro.press("Queue to drive")
        self.told(taro, "You drive, ")
        self.assertIn("of_taro", shared_file(room))
        hanako.press("Queue to drive")
        self.told(hanako, "Taro drives")
        self.told(hanako, "you are 1st")
        self.go(taro)
        self.go(hanako)
        taro.until("document.querySelector('h1').textContent === 'part2_stop_at_wall' && document.body.classList.contains('stopped')", "it begins stopped")
        self.assertEqual(taro.js("return document.body.classList.contains('view-only')"), False)
        self.assertEqual(hanako.js("return document.body.classList.contains('view-only')"), True)
        taro.choose(".world .tools select", "robot 0")
        before = taro.pose()
        taro.press("Re-arm")
        rig.wait_until(lambda: taro.pose()[0] > before[0] + 0.02, "it drives by the pupil's behaviour")
        hanako.press("Stop shared")
        taro.until("document.body.classList.contains('stopped')", "who looks stops it")
        self.stands(taro)
        taro.press("End my turn")
        self.told(hanako, "You drive, ", 40)
        self.assertNotIn("of_taro", shared_file(room))
        hanako.until("document.body.classList.contains('stopped') && !document.body.classList.contains('view-only')", "the next one begins stopped")
        self.told(taro, "Hanako drives")
        self.go(taro)
        self.assertIn("Taro", taro.text(".class-bar .pupil"))
        self.assertEqual(taro.errors() + hanako.errors(), [])

    def test_a_broken_behaviour_and_one_of_another_name_are_told_and_the_teachers_runs_on(self):
        room = self.room
        self.join(room, "Taro")
        os.rename(os.path.join(room.work(), "behaviors", "controller.lua"), os.path.join(room.work(), "behaviors", "mine.lua"))
        self.page.press("Queue to drive")
        self.page.until("document.querySelector('.shared-wrong').textContent === 'Your behaviours are not loaded: no file of yours is a behaviour of this system, which runs controller.lua'",
                        "it is said why")
        pupils_file(room, 1, "this is no Lua\n")
        self.go(self.page)
        self.page.until("!document.body.classList.contains('view-only')", "the pupil drives here")
        self.page.press("Load my behaviours")
        self.page.until("[...document.querySelectorAll('.notice, .troubles, .log')].some((each) => each.textContent.includes('controller.lua:1'))", "the error is told")
        self.page.until("document.body.classList.contains('stopped')", "it is stopped still")

    def test_the_teacher_orders_the_queue_sets_the_limit_and_takes_away(self):
        room = self.room
        (first, _), (second, _), (third, _) = self.tokens("Taro", "Hanako", "Jiro")
        for token in (first, second, third):
            self.assertTrue(self.ask(token, {"do": "class", "what": "queue", "id": 1})[1][0]["ok"])
        teacher = self.teach(room)
        tile = ".shared-tile:not([hidden])"
        teacher.until("document.querySelector('%s .facts').textContent.includes('Taro drives')" % tile, "who drives")
        self.assertEqual(teacher.js("return [...document.querySelectorAll('%s li span')].map((each) => each.textContent)" % tile), ["Hanako", "Jiro"])
        teacher.press("Earlier")
        teacher.until("document.querySelector('%s li span').textContent === 'Jiro'" % tile, "Jiro is next")
        self.assertEqual(self.asks_teacher(what="shared", go="limit", minutes=0)["text"], "'minutes' must be a whole number from 1 to 120")
        self.assertTrue(self.asks_teacher(what="shared", go="limit", minutes=1)["ok"])
        teacher.until("/Taro drives, 0:\\d\\d left/.test(document.querySelector('%s .facts').textContent)" % tile, "the limit holds at once")
        self.assertEqual(self.asks_teacher(what="shared", go="jump")["text"], "'go' must be one of end, restart, up, remove, limit")


class SharedAttacks(SharedCase):
    NOT_YOURS = "it is not your turn"
    ONLY = "in the shared system you can only drive, set parameters and press buttons: use your own system for everything else"

    def test_only_the_driver_drives_and_may_change_nothing_else(self):
        (own, link), (_, other) = self.tokens("Taro", "Hanako")
        wanted = [{"do": "rearm"}, {"do": "drive", "port": "controller.out", "value": {"vx": 0.1}}, {"do": "console", "request": {"eval": "1"}},
                  {"do": "edit", "what": "list"}, {"do": "edit", "what": "save", "file": "behaviors/x.lua", "text": "x", "mark": ""},
                  {"do": "time", "what": "quit"}, {"do": "test", "what": "list"}, {"do": "explain", "component": "controller"},
                  {"do": "act", "act": "Remove", "fields": {"component": "controller"}}, {"do": "act", "act": ["Rearm"]}, {"do": 3}]
        asks = [{**each, "id": i} for i, each in enumerate(wanted, 1)]
        _, answers = self.ask(other, *asks)
        self.assertEqual([each["text"] for each in answers], [self.NOT_YOURS] * len(asks))
        _, answers = self.ask(own, {"do": "class", "what": "load", "id": 1})
        self.assertEqual(answers[0]["text"], self.NOT_YOURS)
        self.assertTrue(self.ask(own, {"do": "class", "what": "queue", "id": 1})[1][0]["ok"])
        rig.wait_until(lambda: self.ask(link, {"do": "rearm", "id": 1})[1][0]["ok"], "the driver re-arms")
        refused = [each for each in asks if each["do"] not in ("rearm", "drive", "explain")]
        _, answers = self.ask(link, *refused)
        self.assertEqual([each["text"] for each in answers], [self.ONLY] * len(refused))
        _, answers = self.ask(link, {"do": "act", "act": "SetParameter", "fields": {"component": "controller", "parameter": "speed_x", "value": 0.05}, "id": 1})
        self.assertTrue(answers[0]["ok"], answers)
        _, answers = self.ask(other, {"do": "stop", "id": 1})
        self.assertTrue(answers[0]["ok"], "everybody may stop it")
        for token in ("join", link, other):
            _, answers = self.ask(token, {"do": "class", "what": "shared", "go": "end", "id": 1})
            self.assertEqual(answers[0]["text"], "enter a name" if token == "join" else "this page has no permission for that: open your own link of the class")

    def test_a_pupil_who_goes_away_gives_up_the_turn_and_the_next_one_drives(self):
        (first, _), (second, _) = self.tokens("Taro", "Hanako")
        page = self.second()
        self.join(self.room, self.room.pupil(2)["code"], page, field="code")
        self.ask(first, {"do": "class", "what": "queue", "id": 1})
        page.press("Queue to drive")
        self.told(page, "Taro drives")
        self.told(page, "You drive", 40)

    def test_a_killed_shared_process_ends_the_turn_and_starts_stopped_with_the_teachers_files(self):
        self.join(self.room, "Taro")
        pupils_file(self.room, 1, DRIVES % ("taro", "taro"))
        self.page.press("Queue to drive")
        self.told(self.page, "You drive")
        with open(os.path.join(START, "behaviors/controller.lua")) as file:
            given = file.read()
        process = [each for each in self.room.processes() if self.is_shared(each)]
        self.assertEqual(len(process), 1)
        with open("/proc/%d/status" % process[0]) as file:
            self.assertRegex(file.read(), r"(?s)NoNewPrivs:\s+1.*Seccomp:\s+2")
        os.kill(process[0], signal.SIGKILL)
        self.told(self.page, "Nobody drives")
        rig.wait_until(lambda: [each for each in self.room.processes() if self.is_shared(each)] not in ([], process), "it runs again", 40)
        self.assertEqual(shared_file(self.room), given)
        self.go(self.page)
        self.page.until("document.body.classList.contains('stopped')", "it is stopped")

    @staticmethod
    def is_shared(process):
        with open("/proc/%d/cmdline" % process) as file:
            return "--stopped" in file.read().split("\0")

    def test_hidden_scenarios_are_not_in_the_copy_and_no_system_file_of_a_pupil_is(self):
        self.join(self.room, "Taro")
        with open(os.path.join(self.room.work(), "behaviors/systems/part2_stop_at_wall.lua"), "a") as out:
            out.write("-- a pupil's\n")
        self.page.press("Queue to drive")
        self.told(self.page, "You drive")
        found = [name for _, _, files in os.walk(os.path.join(self.room.folder, "shared")) for name in files if name.endswith("_test.lua")]
        self.assertEqual(found, [])
        with open(os.path.join(self.room.folder, "shared/behaviors/systems/part2_stop_at_wall.lua")) as file:
            self.assertNotIn("a pupil's", file.read())


class Bounds(class_test.ClassCase):
    """Quotas, a full disk, load, and sleep."""

    def begins(self, **named):
        self.room = self.begin(**named)
        self.page.driver.get(self.room.url)

    def save(self, token, name, text):
        return self.ask(token, {"do": "edit", "what": "save", "file": name, "text": text, "mark": "", "id": 1})[1][0]

    def test_a_save_beyond_the_quota_is_refused_and_nothing_is_lost(self):
        self.begins(options=["--quota", "1"])
        token = self.joins("Taro")
        text = "-- x\n" * 50000
        for i in range(4):
            self.assertTrue(self.save(token, "behaviors/x%d.lua" % i, text)["ok"])
        answer = self.save(token, "behaviors/x4.lua", text)
        self.assertRegex(answer["text"], r"^nothing was saved: your files would have 1\.2 MB, and at most 1\.0 MB are allowed$")
        self.assertFalse(os.path.exists(os.path.join(self.room.work(), "behaviors/x4.lua")))
        with open(os.path.join(self.room.work(), "behaviors/x3.lua")) as file:
            self.assertEqual(file.read(), text)
        self.assertTrue(self.save(token, "behaviors/small.lua", "-- x\n")["ok"])

    def test_a_full_disk_is_told_and_the_class_goes_on_when_there_is_space(self):
        folder = tempfile.mkdtemp(prefix="nezumi-full-")
        if os.geteuid() != 0 or subprocess.call(["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", folder], stderr=subprocess.DEVNULL) != 0:
            shutil.rmtree(folder)
            print("SKIPPED: a full disk was not tried: that needs a mount by root", file=sys.stderr)
            self.skipTest("a full disk needs a mount by root")
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        self.addCleanup(subprocess.call, ["umount", "-l", folder])
        self.begins(folder=folder)
        token = self.joins("Taro")
        self.assertTrue(self.save(token, "behaviors/x.lua", "-- as it was\n")["ok"])
        mark = self.ask(token, {"do": "edit", "what": "read", "file": "behaviors/x.lua", "id": 1})[1][0]["mark"]
        filler = os.path.join(folder, "filler")
        with open(filler, "wb", buffering=0) as out:
            try:
                while out.write(b"x" * 4096) == 4096:
                    pass
            except OSError:
                pass
        _, answers = self.ask(token, {"do": "edit", "what": "save", "file": "behaviors/x.lua", "text": "-- y\n" * 2000, "mark": mark, "id": 1})
        self.assertEqual(answers[0]["text"], "behaviors/x.lua: can't be written: No space left on device: the file is unchanged")
        with open(os.path.join(self.room.work(), "behaviors/x.lua")) as file:
            self.assertEqual(file.read(), "-- as it was\n")
        _, answers = self.ask("join", {"do": "class", "name": "Hanako", "id": 1})
        self.assertIn("No space left on device", answers[0]["text"])
        self.assertIsNone(self.room.process.poll(), "the class runs on")
        os.remove(filler)
        self.assertTrue(self.joins("Hanako"), "the name is free, and there is space")
        self.room.end(remove=False)
        self.begins(folder=folder)
        self.assertEqual(self.room.pupil(1)["name"], "Taro")

    def test_reloads_of_30_pupils_at_once_are_all_done(self):
        self.begins()
        tokens = [self.joins("P%02d" % i) for i in range(1, 31)]
        rig.wait_until(lambda: len(self.room.processes()) == 30, "30 systems run", 120)
        for number in range(1, 31):
            with open(os.path.join(self.room.work(number), "behaviors", "controller.lua"), "w") as out:
                out.write(DRIVES % ("p%d" % number, "p%d" % number))
        for number in (1, 15, 30):
            asked = [{"do": "act", "act": "SetParameter", "fields": {"component": "controller", "parameter": "of_p%d" % number, "value": 0.1}, "id": 1}]
            rig.wait_until(lambda: self.ask(tokens[number - 1], *asked)[1][0]["ok"], "pupil %d has the new behaviour" % number, 120)
        self.assertEqual(len(self.room.processes()), 30)

    def test_a_class_goes_on_after_the_computer_has_slept(self):
        self.begins()
        self.join(self.room, "Taro")
        processes = [self.room.process.pid, *self.room.processes()]
        for each in processes:
            os.kill(each, signal.SIGSTOP)
        time.sleep(8)
        for each in reversed(processes):
            os.kill(each, signal.SIGCONT)
        self.page.until("!document.body.classList.contains('offline') && document.querySelector('.dot.open') !== null", "the page is there again", 40)
        clock = self.page.text(".clock")
        self.page.until("document.querySelector('.clock').textContent !== %r" % clock, "time goes on")
        self.assertEqual(self.room.processes(), processes[1:], "no process was lost")

    def test_files_as_given_are_not_taken_for_saved_ones(self):
        self.begins()
        teacher = self.teach(self.room)
        self.join(self.room, "Taro")
        self.until_tile(teacher, "Taro", "tile.className.includes('runs')", "it runs")
        time.sleep(5)
        self.assertIn("nothing saved", self.tile(teacher, "Taro", "tile.textContent"))
        pupils_file(self.room, 1, DRIVES % ("taro", "taro"))
        self.until_tile(teacher, "Taro", "/saved \\d/.test(tile.textContent)", "the tile shows the save")


class RealRobot(SharedCase):
    """The nodes of a mouse are plain files here."""

    def setUp(self):
        self.devices = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.devices)
        for name, text in {"rtmotor_raw_l0": "0", "rtmotor_raw_r0": "0", "rtmotoren0": "0", "rtlightsensor0": "10 10 10 10\n"}.items():
            with open(os.path.join(self.devices, name), "w") as node:
                node.write(text)
        self.room = self.begin(options=["--shared", SHARED, "--hw", "--dev-root", self.devices])
        self.page.driver.get(self.room.url)

    def node(self, name):
        with open(os.path.join(self.devices, name)) as node:
            return node.read().strip()

    def test_a_real_robot_is_driven_in_turn_and_loses_its_power_at_the_end(self):
        room, page = self.room, self.page
        self.join(room, "Taro")
        pupils_file(room, 1, DRIVES % ("taro", "taro"))
        page.press("Queue to drive")
        self.told(page, "You drive, ", 60)
        self.assertEqual((self.node("rtmotor_raw_l0"), self.node("rtmotoren0")), ("0", "0"))
        self.go(page)
        page.until("document.body.classList.contains('stopped')", "it begins stopped")
        page.press("Re-arm")
        rig.wait_until(lambda: self.node("rtmotor_raw_l0") not in ("", "0") and self.node("rtmotoren0") == "1", "the motors turn", 20)
        self.assertTrue(self.asks_teacher(what="shared", go="end")["ok"])
        rig.wait_until(lambda: (self.node("rtmotor_raw_l0"), self.node("rtmotoren0")) == ("0", "0"), "the motors have no power", 20)


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
