"""A class in real browsers: pupils, the teacher, and attacks. Usage: class_test.py NEZUMI [TEST...]"""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

STOPS = """
local range  = input("in", "TimedShortSeq")
local target = output("out", "TimedVelocity2D")
param("speed_x", 0.0)
param("stop_d", 30)
function on_execute()
  for _, value in ipairs(range:read()) do
    if value > config.stop_d then return target:write { vx = 0 } end
  end
  target:write { vx = config.speed_x }
end
"""


class Class:
    """`nezumi class` with a folder of its own, or of another one."""

    def __init__(self, nezumi, folder=None, options=()):
        self.folder = folder or tempfile.mkdtemp(prefix="nezumi-class-")
        self.keeps = folder is not None
        environment = dict(os.environ, XDG_RUNTIME_DIR=self.folder, XDG_STATE_HOME=self.folder)
        self.process = subprocess.Popen([nezumi, "class", self.folder, "--port", "8865", *options], cwd=rig.ROOT, env=environment,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        said = [self.process.stderr.readline() for _ in range(2)]
        found = [re.search(r"https?://\S+", line) for line in said]
        if not all(found):
            self.process.kill()
            raise AssertionError("".join(said) + self.process.stderr.read())
        self.url, self.teacher = (each.group(0) for each in found)
        self.reader = threading.Thread(target=self.process.stderr.read)
        self.reader.start()

    def end(self, remove=True):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            self.process.wait(15)
        self.reader.join()
        self.process.stderr.close()
        if remove:
            shutil.rmtree(self.folder, ignore_errors=True)

    def pupil(self, number=1):
        with open(os.path.join(self.folder, "pupils", "%02d" % number, "pupil.json")) as file:
            return json.load(file)

    def work(self, number=1):
        return os.path.join(self.folder, "pupils", "%02d" % number, "work", self.pupil(number)["exercise"])

    def processes(self):
        """The processes of pupils' systems."""
        found = []
        for each in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open("/proc/%s/cmdline" % each) as file:
                    words = file.read().split("\0")
                with open("/proc/%s/stat" % each) as file:
                    parent = int(file.read().rsplit(")", 1)[1].split()[1])
            except OSError:
                continue
            if parent == self.process.pid and "--page-on-input" in words:
                found.append(int(each))
        return found


class ClassCase(rig.PageCase):
    def begin(self, **named):
        room = Class(self.nezumi, **named)
        self.addCleanup(room.end)
        self.addCleanup(self.page.driver.get, "about:blank")
        return room

    def second(self):
        """A window with a storage of its own, as on another computer."""
        page = rig.Page()
        self.addCleanup(page.close)
        return page

    def join(self, room, name, page=None, field="name", waits=True):
        page = page or self.page
        page.driver.get(room.url)
        page.until("document.querySelector('input[name=%s]') !== null" % field, "it asks")
        page.find("input[name=%s]" % field).send_keys(name + "\n")
        if waits:
            # A pupil's process comes last, so it begins late on a busy machine.
            page.until("document.title.includes('·')", "the pupil's system is there", 90)
            page.ready()
            page.until("document.querySelector('.class-bar b')?.textContent", "the bar is there")

    def teach(self, room, page=None):
        page = page or self.second()
        page.driver.get(room.teacher)
        page.until("document.querySelector('.address')?.textContent", "the class is shown")
        return page

    def tile(self, page, name, script):
        return page.js("const tile = [...document.querySelectorAll('.tile')].find((each) => each.dataset.name === arguments[0]);"
                       "return tile && (" + script + ")", name)

    def until_tile(self, page, name, script, what, within=rig.PATIENCE):
        rig.wait_until(lambda: self.tile(page, name, script), what, within)

    def press_at(self, page, name, text):
        button = page.driver.execute_script(
            "const tile = [...document.querySelectorAll('.tile')].find((each) => each.dataset.name === arguments[0]);"
            "return [...tile.querySelectorAll('button, a')].find((each) => each.textContent === arguments[1])", name, text)
        button.click()

    ASKS = """const done = arguments[arguments.length - 1];
        const [token, messages, retries] = arguments;
        const got = [];
        const end = Date.now() + 15000;
        function open() {
          const socket = new WebSocket(`ws://${location.host}/ws`, ["nezumi", `token.${token}`]);
          let was_open = false;
          socket.onopen = () => {
            was_open = true;
            messages.forEach((each) => socket.send(JSON.stringify(each)));
          };
          socket.onmessage = ({ data }) => {
            if (typeof data === "string") got.push(JSON.parse(data));
            if (got.filter((each) => each.is === "answer").length === messages.length) {
              done({ closed: false, got });
              socket.close();
            }
          };
          socket.onclose = () => (was_open || !retries || Date.now() > end ? done({ closed: true, got }) : setTimeout(open, 200));
        }
        open();
        setTimeout(() => done({ closed: false, got }), 17000);"""

    def ask(self, token, *messages, retries=True):
        """Whether a socket with this token was closed, and the answers."""
        result = self.page.driver.execute_async_script(self.ASKS, token, list(messages), retries)
        return result["closed"], [each for each in result["got"] if each["is"] == "answer"]

    def joins(self, name):
        answers = self.ask("join", {"do": "class", "name": name, "id": 1})[1]
        self.assertTrue(answers and answers[0]["ok"], answers)
        return answers[0]["token"]


class Classroom(ClassCase):
    def test_a_pupil_joins_by_a_name_and_comes_back_by_the_code(self):
        room = self.begin()
        self.join(room, "花子")
        page = self.page
        self.assertIn("花子", page.text(".class-bar .pupil"))
        code = room.pupil()["code"]
        self.assertIn(code[:3] + "-" + code[3:], page.text(".class-bar .code"))
        with open(os.path.join(room.work(), "behaviors", "notes.lua"), "w") as out:
            out.write("return {}\n")
        room.end(remove=False)
        again = self.begin(folder=room.folder)
        other = self.second()
        self.join(again, (code[:3] + "-" + code[3:]).upper(), other, field="code")
        self.assertIn("花子", other.text(".class-bar .pupil"))
        self.assertTrue(os.path.exists(os.path.join(again.work(), "behaviors", "notes.lua")))
        self.assertEqual(other.errors(), [])

    def test_the_teacher_sees_who_is_there_and_stops_and_freezes_all(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        self.until_tile(teacher, "Taro", "tile.className.includes('runs') && tile.textContent.includes('here')", "the tile shows that it runs")
        teacher.press("Stop all")
        self.page.until("document.body.classList.contains('stopped')", "the pupil's robots are stopped")
        self.until_tile(teacher, "Taro", "tile.className.includes('stopped')", "the tile shows it")
        self.page.press("Re-arm")
        self.until_tile(teacher, "Taro", "tile.className.includes('runs')", "it runs again")
        teacher.press("Freeze all")
        self.page.until("document.querySelector('.late')?.textContent === 'paused'", "the pupil's time stands")
        self.page.until("!document.querySelector('.class-bar .frozen').hidden", "the pupil is told")
        self.page.find(".run.acts").click()
        self.page.until("[...document.querySelectorAll('.notice')].some((each) => each.textContent.includes('the teacher has paused the class'))",
                        "a pupil can't go on alone")
        self.assertEqual(self.page.text(".late"), "paused")
        self.until_tile(teacher, "Taro", "tile.className.includes('paused')", "the tile shows it")
        teacher.press("Go on")
        self.page.until("document.querySelector('.late')?.textContent !== 'paused'", "time goes on")
        self.assertEqual(self.page.errors() + teacher.errors(), [])

    def test_an_error_is_on_the_tile_with_its_time_and_a_save_too(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        with open(os.path.join(room.work(), "behaviors", "controller.lua"), "w") as out:
            out.write('local target = output("out", "TimedVelocity2D")\ninput("in", "TimedShortSeq")\nlocal begin = now()\n'
                      'param("speed_x", 0.1)\nfunction on_execute() if now() > begin + 1 then error("oh no") end end\n')
        self.until_tile(teacher, "Taro", "tile.className.includes('error') && tile.textContent.includes('oh no') && /since \\d/.test(tile.textContent)",
                        "the tile shows the error")
        self.until_tile(teacher, "Taro", "/saved \\d/.test(tile.textContent)", "the tile shows the save")

    def test_a_killed_process_and_one_that_quits_start_again(self):
        room = self.begin()
        self.join(room, "Taro")
        for how in (signal.SIGKILL, signal.SIGTERM):
            time.sleep(5.5)  # a run that ends sooner is taken for one that can't run
            before = rig.wait_until(lambda: len(room.processes()) == 1 and room.processes(), "one process runs")
            os.kill(before[0], how)
            rig.wait_until(lambda: room.processes() not in ([], before), "another one runs")
            self.page.ready()
            self.page.until("document.querySelector('.late')?.textContent !== ''", "the page shows it")

    def test_a_system_file_that_cannot_run_is_corrected_in_the_editor(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        file = os.path.join(room.work(), "behaviors/systems/part2_stop_at_wall.lua")
        with open(file) as before:
            good = before.read()
        with open(file, "w") as out:
            out.write("robt 'mouse' {}\n")
        os.kill(room.processes()[0], signal.SIGKILL)
        self.page.until("document.querySelector('.class-bar .broken')?.textContent.includes('robt')", "the reason is shown", 30)
        self.until_tile(teacher, "Taro", "tile.className.includes('broken') && tile.textContent.includes('robt')", "the teacher sees it")
        with open(file, "w") as out:
            out.write(good)
        rig.wait_until(lambda: self.page.js("return document.querySelector('.dot.open') !== null"), "the page is connected")
        self.page.press("Start again")
        self.until_tile(teacher, "Taro", "tile.className.includes('runs')", "it runs")
        self.page.until("document.querySelector('.class-bar .broken').hidden", "it is over")

    def test_no_process_is_left_when_the_class_is_killed(self):
        room = self.begin()
        self.join(room, "Taro")
        left = room.processes()
        room.process.kill()
        room.process.wait()
        rig.wait_until(lambda: not any(os.path.exists("/proc/%d" % each) for each in left), "the pupil's process has ended")


class Lessons(ClassCase):
    """Exercises, checks, hints, marks and the projector."""

    def test_work_is_checked_by_shown_and_hidden_scenarios(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        page = self.page
        page.press("Check my work")
        page.until("document.querySelectorAll('.class-bar .results li.failed').length === 2", "one shown and the hidden ones have failed", 90)
        self.assertIn("0 of 7 more checks passed", page.text(".class-bar .results"))
        self.assertNotIn("any of the four", page.text(".class-bar"))
        with open(os.path.join(room.work(), "behaviors", "controller.lua"), "w") as out:
            out.write(STOPS)
        for each in os.listdir(os.path.join(room.work(), "tests")):
            os.remove(os.path.join(room.work(), "tests", each))
        self.press_at(teacher, "Taro", "Check")
        self.until_tile(teacher, "Taro", "tile.textContent.includes('8 of 8 passed')", "all have passed", 90)
        page.until("document.querySelectorAll('.class-bar .results li.passed').length === 2", "the pupil sees it")
        page.find(".class-bar summary").click()
        self.assertGreater(page.js("return document.querySelector('.task-sheet').offsetHeight"), 200, "the whole text is seen")
        teacher.press("Collect")
        teacher.until("document.querySelector('.collected').textContent.includes('/collected/')", "it is said where")
        folder = os.path.join(room.folder, "collected", os.listdir(os.path.join(room.folder, "collected"))[0])
        with open(os.path.join(folder, "results.csv")) as file:
            self.assertIn("01,Taro,part2_stop_at_wall,8,8,", file.read())
        self.assertTrue(os.path.exists(os.path.join(folder, "01/part2_stop_at_wall/behaviors/controller.lua")))
        self.assertEqual(page.errors() + teacher.errors(), [])

    def test_a_pupil_opens_a_failed_scenario_and_watches_one_as_outside_of_a_class(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        page = self.page
        page.view("scenarios")
        page.until("document.querySelector('.scenario') !== null", "they are listed", 30)
        page.press("Run all")
        page.until("document.querySelector('.scenario.failed') !== null && !document.querySelector('.scenario.runs')", "one has failed", 90)
        own = room.processes()
        failed = page.js("return document.querySelector('.scenario.failed').dataset.name")
        with page.opened(lambda: page.press("Open")):
            page.until("document.querySelector('.late')?.textContent === 'paused'", "it is paused", 60)
            page.until("parseFloat(document.querySelector('.clock').textContent) > 0.3", "it is where it failed")
            self.assertGreater(page.js("return document.querySelectorAll('.conditions li').length"), 0)
            page.find(".timeline input[type=range]").send_keys("\ue012")  # the left arrow
            page.until("!document.querySelector('.timeline .is-past').hidden", "it goes back in time")
            (opened,) = set(room.processes()) - set(own)
            with open("/proc/%d/status" % opened) as file:
                status = file.read()
            self.assertRegex(status, r"NoNewPrivs:\s+1")
            self.assertRegex(status, r"Seccomp:\s+2")
            teacher.press("Freeze all")
            page.press("Run")
            page.until("[...document.querySelectorAll('.notice')].some((each) => each.textContent.includes('the teacher has paused the class'))", "it is frozen too")
            teacher.press("Go on")
        with page.opened(lambda: page.find("[aria-label^='Watch %s']" % failed).click()):
            page.until("document.querySelector('header .kind')?.textContent === 'simulated · a run that is only watched'", "it says what it is", 60)
            page.until("parseFloat(document.querySelector('.clock').textContent) > 0.3", "time passes", 30)
            page.picture("watched_in_class")
            self.assertEqual(len(room.processes()), 2, "what was opened before has ended")
            page.choose("header select[aria-label=Speed]", "max")
            page.until("document.querySelector('.notice.error.lasting') !== null", "it says how it ended", 60)
        token = room.pupil()["token"]
        for file, text in (("nezumi-test/../../x", "'nezumi-test/../../x' is not the folder of a failed run"), ("behaviors", "'behaviors' is not the folder of a failed run")):
            _, answers = self.ask(token, {"do": "test", "what": "open", "file": file, "id": 1})
            self.assertEqual(answers[0]["text"], text)
        _, answers = self.ask(token, {"do": "test", "what": "watch", "file": "tests/no_test.lua", "name": "x", "id": 1})
        self.assertIn("no_test.lua", answers[0]["text"])
        rig.wait_until(lambda: room.processes() == own, "what nobody shows ends", 40)
        self.assertEqual(page.errors() + teacher.errors(), [])

    def test_whatever_a_pupils_process_writes_is_within_the_quota(self):
        room = self.begin(options=("--quota", "1"))
        teacher = self.teach(room)
        self.join(room, "Taro")
        before = room.processes()
        os.makedirs(os.path.join(room.work(), "nezumi-test", "kept"))
        written = os.path.join(room.work(), "nezumi-test", "kept", "trace.csv")
        with open(written, "w") as out:
            out.write("x" * (3 << 20))
        why = "too much was written: 3.0 MB in 1 files, and at most 1.0 MB in 2000 files are allowed; files removed because they are not text: 1"
        self.page.until("document.querySelector('.class-bar .broken')?.textContent.includes(%r)" % why, "the pupil is told", 30)
        self.until_tile(teacher, "Taro", "tile.className.includes('broken') && tile.textContent.includes(%r)" % why, "the teacher sees it")
        self.assertFalse(os.path.exists(written))
        rig.wait_until(lambda: not set(before) & set(room.processes()), "the process has ended")
        rig.wait_until(lambda: self.page.js("return document.querySelector('.dot.open') !== null"), "the page is connected")
        self.page.press("Start again")
        self.until_tile(teacher, "Taro", "tile.className.includes('runs')", "it runs again")

    def test_an_exercise_is_sent_and_the_work_on_the_other_one_stays(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        with open(os.path.join(room.work(), "behaviors", "controller.lua"), "w") as out:
            out.write(STOPS)
        before = room.work()
        teacher.choose("header select", "part3_touch_drive")
        teacher.press("Send to all")
        self.page.until("document.querySelector('.class-bar b').textContent === 'Drive the mouse with touch sensors'", "the pupil has it")
        self.page.until("document.querySelector('h1').textContent === 'part3_touch_drive'", "its system runs")
        with open(os.path.join(before, "behaviors", "controller.lua")) as file:
            self.assertEqual(file.read(), STOPS)
        self.join(room, "Jiro", teacher)  # who comes later starts with it
        self.assertEqual(room.pupil(2)["exercise"], "part3_touch_drive")

    def test_hints_and_marks_are_seen_by_this_pupil(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        self.until_tile(teacher, "Taro", "true", "the tile is there")
        self.press_at(teacher, "Taro", "Hint")
        teacher.find("dialog textarea").send_keys("Look at <b>all</b> sensors")
        teacher.press("Save")
        self.page.until("[...document.querySelectorAll('.notice')].some((each) => each.textContent.includes('Look at <b>all</b> sensors'))", "the hint is there")
        self.press_at(teacher, "Taro", "Mark…")
        teacher.find("dialog input").send_keys("A")
        teacher.find("dialog textarea").send_keys("Well done")
        teacher.press("Save")
        self.page.until("document.querySelector('.mark-text').textContent === 'Mark: A'", "the mark is there")
        self.assertEqual(self.page.text(".class-bar .comment"), "Well done")
        self.assertEqual((room.pupil()["mark"], room.pupil()["comment"], room.pupil()["hints"]), ("A", "Well done", ["Look at <b>all</b> sensors"]))

    def test_the_projector_shows_a_pupil_and_the_teacher_looks_and_helps(self):
        room = self.begin()
        teacher = self.teach(room)
        self.join(room, "Taro")
        self.until_tile(teacher, "Taro", "tile.className.includes('runs')", "it runs")
        self.press_at(teacher, "Taro", "Projector")
        link = teacher.until("document.querySelector('.projector:not([hidden])')?.textContent.match(/http\\S+/)[0]", "the link is there")
        look = self.tile(teacher, "Taro", "[...tile.querySelectorAll('a')].find((each) => each.textContent === 'Look').href")
        aid = self.tile(teacher, "Taro", "[...tile.querySelectorAll('a')].find((each) => each.textContent === 'Help').href")
        other = self.second()
        for address, views, told in ((link, True, "This is on the projector"), (look, True, "The teacher is watching"), (aid, False, "The teacher helps here")):
            other.driver.get("about:blank")
            other.open(address)
            other.until("document.querySelector('.class-bar b')?.textContent", "the bar is there")
            self.assertEqual(other.js("return document.body.classList.contains('view-only')"), views)
            self.assertNotIn(room.pupil()["code"][:3] + "-", other.text(".class-bar"))
            self.page.until("document.querySelector('.class-bar .told').textContent.includes(%r)" % told, "the pupil sees: " + told)
        other.press("Pause")
        self.page.until("document.querySelector('.late')?.textContent === 'paused'", "who helps can act")


class Japanese(ClassCase):
    """Who reads Japanese sees the class in Japanese."""

    language = "ja,en"

    def test_the_language_is_that_of_the_browser_until_another_one_is_chosen(self):
        room = self.begin()
        page = self.teach(room, self.page)
        self.assertEqual(page.text("header .stop"), "全員を停止")
        self.join(room, "花子")
        self.assertEqual(page.text(".class-bar b"), "壁の手前で止まる")
        self.assertEqual(page.text(".class-bar .check"), "できたか確かめる")
        page.driver.get(room.url)
        page.until("document.querySelector('h1')?.textContent === 'クラスに参加する'", "it asks in Japanese")
        page.press("English")
        page.until("document.querySelector('h1')?.textContent === 'Join the class'", "it asks in English")
        self.assertEqual(page.errors(), [])


class Attacks(ClassCase):
    def setUp(self):
        self.room = self.begin()
        self.page.driver.get(self.room.url)

    def test_codes_cannot_be_guessed(self):
        self.joins("Taro")
        code = self.room.pupil()["code"]
        _, answers = self.ask("join", *[{"do": "class", "code": "aaaaa%d" % i, "id": i} for i in range(2, 9)])
        self.assertEqual([each["text"] for each in answers],
                         ["nobody in this class has this code"] * 5 + ["too many wrong codes: wait a minute"] * 2)
        _, answers = self.ask("join", {"do": "class", "code": code, "id": 1})
        self.assertEqual(answers[0]["text"], "too many wrong codes: wait a minute", "also the right one has to wait")

    def test_a_visitor_and_a_pupil_cannot_do_what_the_teacher_does(self):
        token = self.joins("Taro")
        for who, text in (("join", "enter a name"), (token, "this page has no permission for that: open your own link of the class")):
            for what in ("stop", "freeze", "collect", "hint", "mark", "renew", "project", "door"):
                _, answers = self.ask(who, {"do": "class", "what": what, "pupil": 1, "text": "x", "id": 1})
                self.assertEqual((answers[0]["ok"], answers[0]["text"]), (False, text), what)
        self.assertEqual(self.room.pupil()["mark"], "")
        for wrong in ("", "teacher", "0" * 32):
            self.assertTrue(self.ask(wrong, {"do": "stop", "id": 1}, retries=False)[0], "it is not let in")

    def test_names_are_no_paths_and_exercises_are_no_paths(self):
        self.joins("../../../tmp/evil")
        self.assertEqual(os.listdir(os.path.join(self.room.folder, "pupils")), ["01"])
        teacher = self.room.teacher.split("#")[1]
        for name in ("../../x", "/etc", "part2_stop_at_wall/../part3_touch_drive", ""):
            _, answers = self.ask(teacher, {"do": "class", "what": "exercise", "pupil": 1, "exercise": name, "id": 1})
            self.assertEqual(answers[0]["text"], "there is no exercise '%s'" % name)

    def test_a_pupil_reads_and_writes_only_the_own_copy(self):
        first, second = self.joins("Taro"), self.joins("Hanako")
        with open(os.path.join(self.room.work(2), "behaviors", "mine.lua"), "w") as out:
            out.write("return 'secret'\n")
        os.symlink(self.room.work(2), os.path.join(self.room.work(1), "next"))
        files = ["../part2_stop_at_wall/../../../02/work/part2_stop_at_wall/behaviors/mine.lua", os.path.join(self.room.work(2), "behaviors/mine.lua"),
                 "next/behaviors/mine.lua", "../../pupil.json", "/etc/passwd"]
        _, answers = self.ask(first, *[{"do": "edit", "what": "read", "file": file, "id": i} for i, file in enumerate(files, 1)])
        outside = "' is not a file name in the project: no part may be empty or begin with a dot"
        linked = "next/behaviors/mine.lua: 'next' is not a folder, or is a link, which is not followed"
        texts = [linked if file.startswith("next") else "'" + file + outside for file in files]
        self.assertEqual([each["text"] for each in answers], texts)
        self.assertNotIn("secret", json.dumps(answers))
        _, answers = self.ask(first, *[{"do": "edit", "what": "save", "file": file, "text": "x", "mark": "", "id": i} for i, file in enumerate(files, 1)])
        self.assertEqual([each["text"] for each in answers], [text + (": nothing was saved" if text == linked else "") for text in texts])
        self.assertNotEqual(first, second)

    def test_an_endless_loop_of_one_pupil_leaves_the_others_alone(self):
        first, second = self.joins("Taro"), self.joins("Hanako")
        with open(os.path.join(self.room.work(1), "behaviors", "controller.lua"), "w") as out:
            out.write('output("out", "TimedVelocity2D")\ninput("in", "TimedShortSeq")\nparam("speed_x", 0.1)\nfunction on_execute() while true do end end\n')
        with open(os.path.join(self.room.work(1), "behaviors/systems/part2_stop_at_wall.lua"), "w") as out:
            out.write("while true do end\n")
        self.ask(first, {"do": "time", "what": "speed", "value": "max", "id": 1}, {"do": "time", "what": "restart", "id": 2})
        self.ask(second, {"do": "stop", "id": 1})
        began = time.monotonic()
        _, answers = self.ask(second, {"do": "stop", "id": 1})
        self.assertTrue(answers[0]["ok"])
        self.assertLess(time.monotonic() - began, 5)

    def test_a_flood_of_requests_is_closed(self):
        closed, answers = self.ask("join", *[{"do": "class", "name": "x%d" % i, "id": i} for i in range(1, 200)])
        self.assertTrue(closed)
        self.assertLess(len(os.listdir(os.path.join(self.room.folder, "pupils"))), 25)

    def test_a_new_code_locks_out_who_knows_the_old_one(self):
        token = self.joins("Taro")
        code = self.room.pupil()["code"]
        teacher = self.room.teacher.split("#")[1]
        self.assertTrue(self.ask(teacher, {"do": "class", "what": "renew", "pupil": 1, "id": 1})[1][0]["ok"])
        self.assertTrue(self.ask(token, {"do": "stop", "id": 1}, retries=False)[0], "the old token is refused")
        self.assertEqual(self.ask("join", {"do": "class", "code": code, "id": 1})[1][0]["text"], "nobody in this class has this code")

    def test_a_pupils_processes_are_confined_and_come_last(self):
        self.page.driver.get(self.room.url)
        self.join(self.room, "Taro")
        process = self.room.processes()[0]
        with open("/proc/%d/status" % process) as file:
            status = file.read()
        self.assertRegex(status, r"NoNewPrivs:\s+1")
        self.assertRegex(status, r"Seccomp:\s+2")
        self.assertEqual(os.getpriority(os.PRIO_PROCESS, process), os.getpriority(os.PRIO_PROCESS, self.room.process.pid) + 10)


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
