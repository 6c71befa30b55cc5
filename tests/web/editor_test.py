"""The editor of the browser's page, in a real browser. Usage: editor_test.py NEZUMI [TEST...]"""

import os
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import rig

GUIDE = """local out = output("out", "TimedVelocity2D", "to the wheels")
param("fails", false)
param("speed", 0.1, { min = 0, max = 0.3, unit = "m/s", doc = "forward speed" })

function on_execute()
  if config.fails then error("no way") end
  local v = config.speed * 0.5
  out:write { vx = v }
end
"""
SYSTEM = """-- A mouse that is guided.
robot "mouse" { model = "raspimouse" }
behavior "guide" { script = "guide" }
connect("guide.out", "mouse.target_velocity_in")
"""
CONTROL, END, HOME, F1, F9, ESCAPE, TAB = "\ue009", "\ue010", "\ue011", "\ue031", "\ue039", "\ue00c", "\ue004"


class EditorCase(rig.PageCase):
    def begin(self):
        system = self.open(text=SYSTEM, scripts={"guide": GUIDE, "lib/tools": "return { a = 1 }\n"})
        self.page.view("editor")
        self.page.until("document.querySelector('.editor .tools h2')?.textContent === 'guide.lua'", "the behaviour that runs is open")
        self.guide = os.path.join(system.folder, "behaviors", "guide.lua")
        return system

    def text(self):
        return self.page.js("return document.querySelector('.CodeMirror').CodeMirror.getValue()")

    def put(self, line, column, typed):
        """Types at a place, from 1."""
        self.page.js("const text = document.querySelector('.CodeMirror').CodeMirror; text.focus();"
                     "text.setCursor({ line: arguments[0] - 1, ch: arguments[1] - 1 })", line, column)
        self.page.driver.switch_to.active_element.send_keys(typed)

    def save(self):
        self.page.driver.switch_to.active_element.send_keys(CONTROL + "s")

    def told(self, part):
        self.page.until("document.querySelector('.editor .told').textContent.includes(%r)" % part,
                        lambda: "it tells %r; it tells %r" % (part, self.page.text(".editor .told")))

    def on_disk(self):
        with open(self.guide) as file:
            return file.read()


class Writing(EditorCase):
    def test_a_save_runs_as_a_new_version_or_says_why_not(self):
        self.begin()
        page = self.page
        self.assertEqual([each.text for each in page.all(".files h3")], ["Behaviours", "Modules", "Systems"])
        self.put(7, 31, "0")
        page.until("document.querySelector('.files .unsaved') !== null", "the list shows what is not saved")
        self.save()
        self.told("version 2 runs (guide)")
        self.assertIn("config.speed * 0.50\n", self.on_disk())
        self.assertEqual(page.all(".files .unsaved"), [])
        self.put(4, 1, "nonsense(")
        self.save()
        self.told("still running version 2")
        self.assertIn("nonsense(", self.on_disk())

    def test_findings_of_check_are_marked_while_a_person_types(self):
        self.begin()
        page = self.page
        self.put(8, 1, "  owt:write {}\n")
        row = page.until("document.querySelector('.finding-row')", "it is found")
        self.assertIn("8:3", row.text)
        self.assertIn("unknown global 'owt' (did you mean 'out'?)", row.text)
        self.assertEqual(page.text("span.finding"), "owt")
        self.assertIn("did you mean", page.js("return document.querySelector('.finding-sign').title"))
        self.assertNotIn("owt", self.on_disk())
        row.click()
        self.assertEqual(page.js("const at = document.querySelector('.CodeMirror').CodeMirror.getCursor(); return [at.line, at.ch]"), [7, 2])
        self.put(8, 6, "\b\b\bout")
        page.until("document.querySelector('.findings').hidden", "nothing is wrong any more")
        self.assertEqual(page.errors(), [])

    def test_a_text_that_never_ends_is_found_and_disturbs_nothing(self):
        self.begin()
        page = self.page
        self.put(10, 1, "while true do end\n")
        row = page.until("document.querySelector('.finding-row')", "it is found", 60)
        self.assertRegex(row.text, "endless loop|not checked: it took more than 20 s")  # as the machine has time for it
        before = page.text(".clock")
        page.until("document.querySelector('.clock').textContent !== %r" % before, "the system runs")

    def test_a_file_that_was_changed_meanwhile_is_not_overwritten_until_a_person_chooses(self):
        self.begin()
        page = self.page
        self.put(2, 1, "-- mine\n")
        theirs = "-- theirs\n" + GUIDE
        with open(self.guide, "w") as out:
            out.write(theirs)
        self.save()
        page.until("!document.querySelector('.sheet-over').hidden", "it asks")
        self.assertIn("it was changed meanwhile", page.text(".sheet-over h2"))
        self.assertEqual([each.text for each in page.all(".difference .gone")], ["-\n-- theirs"])
        self.assertEqual([each.text for each in page.all(".difference .came")], ["+\n-- mine"])
        self.assertEqual(self.on_disk(), theirs)
        page.press("Keep my text")
        rig.wait_until(lambda: self.on_disk().startswith(GUIDE.splitlines()[0] + "\n-- mine"), "my text is written")
        self.assertEqual(page.errors(), [])

    def test_a_file_that_another_program_changes_is_shown_as_it_is_now(self):
        self.begin()
        with open(self.guide, "a") as out:
            out.write("-- from elsewhere\n")
        self.page.view("world")
        self.page.view("editor")
        rig.wait_until(lambda: self.text().endswith("-- from elsewhere\n"), "the text of the file is shown")

    def test_an_earlier_version_is_compared_and_saved_again(self):
        self.begin()
        page = self.page
        self.put(7, 31, "5")
        self.save()
        self.told("version 2 runs")
        page.press("Versions")
        rows = page.until("document.querySelectorAll('.versions .file').length === 2 && document.querySelectorAll('.versions .file')", "two versions are kept")
        self.assertIn("Version 2", rows[0].text)
        rows[1].click()
        page.until("document.querySelector('.difference .came') !== null", "the difference is shown")
        self.assertIn("0.55", page.text(".difference .came"))
        page.press("Save version 1 again")
        self.told("version 3 runs")
        self.assertEqual(self.on_disk(), GUIDE)

    def test_what_was_not_saved_survives_a_reload_of_the_page(self):
        self.begin()
        page = self.page
        self.put(1, 1, "-- begun\n")
        page.js("addEventListener('beforeunload', (event) => event.stopImmediatePropagation(), true)")
        page.driver.refresh()
        page.ready()
        page.view("editor")
        page.until("document.querySelector('.CodeMirror')?.CodeMirror.getValue().startsWith('-- begun')", "the text is still there")
        self.assertEqual(self.on_disk(), GUIDE)

    def test_a_new_file_is_made_within_the_project_only(self):
        system = self.begin()
        page = self.page
        for name, why in (("../outside.lua", "is not a file name in the project"), ("/tmp/x.lua", "is not a file name in the project"),
                          ("behaviors/x.sh", "can't be edited here"), ("behaviors/guide.lua", "it was changed meanwhile")):
            page.press("New…")
            page.answer("Make", name)
            self.told(why)
        page.press("New…")
        page.answer("Make", "behaviors/second.lua")
        page.until("document.querySelector('.editor .tools h2').textContent === 'second.lua'", "it is open")
        self.assertTrue(os.path.exists(os.path.join(system.folder, "behaviors", "second.lua")))

    def test_a_system_file_counts_from_the_next_start(self):
        self.begin()
        page = self.page
        page.js("document.querySelector('[data-file=\"tried.lua\"]').click()")
        page.until("document.querySelector('.editor .tools h2').textContent === 'tried.lua'", "it is open")
        self.put(1, 1, "-- another comment\n")
        self.save()
        self.told("It is used from the next start")
        page.js("document.querySelector('.editor .told button').click()")
        page.answer("Restart")
        page.until("parseFloat(document.querySelector('.clock').textContent) < 1", "it begins again")

    def test_a_view_only_page_shows_no_files(self):
        system = self.begin()
        address = system.url.split("#")[0] + "#" + self.page.js(
            "return new Promise((done) => { const socket = new WebSocket(`ws://${location.host}/ws`, ['nezumi', `token.${sessionStorage.getItem('nezumi.token')}`]);"
            "socket.onmessage = ({ data }) => typeof data === 'string' && data.includes('view_token') && done(JSON.parse(data).view_token); })")
        self.page.open(address)
        self.page.view("editor")
        self.told("view-only")
        self.assertEqual(self.page.all(".files .file"), [])


    def test_without_codemirror_the_page_says_how_to_install_it(self):
        self.page.driver.execute_cdp_cmd("Network.enable", {})
        self.page.driver.execute_cdp_cmd("Network.setBlockedURLs", {"urls": ["*/lib/codemirror/*"]})
        self.addCleanup(self.page.driver.execute_cdp_cmd, "Network.setBlockedURLs", {"urls": []})
        self.open(text=SYSTEM, scripts={"guide": GUIDE})
        self.page.view("editor")
        self.page.until("document.querySelector('.editor').textContent.includes('sudo apt install libjs-codemirror')", "it says so")
        self.page.view("plots")
        self.page.until("document.querySelector('.tree .row') !== null", "the others work")
        self.page.errors()


class Help(EditorCase):
    def offers(self, *names, only=False):
        """Waits until these names are offered."""
        seen = lambda: self.page.js("return [...document.querySelectorAll('.CodeMirror-hint > span')].map((each) => each.textContent)")
        rig.wait_until(lambda: seen() == list(names) if only else set(names) <= set(seen()), lambda: "%s is offered, not %s" % (names, seen()))

    def test_a_snippet_is_filled_in_place_after_place_by_tab(self):
        self.begin()
        page = self.page
        self.put(4, 1, "outp")
        self.offers("output …", "output(name, type, doc, options)")
        keys = page.driver.switch_to.active_element
        keys.send_keys("\n")
        self.assertIn('local target = output("out", "TimedVelocity2D", "target velocity")', self.text())
        keys.send_keys("lamp" + TAB + "lamp_out" + TAB + TAB + "light" + TAB + " -- done")
        self.assertIn('local lamp = output("lamp_out", "TimedVelocity2D", "light") -- done\n', self.text())
        self.put(4, 1, TAB)
        self.assertIn('  local lamp = ', self.text())  # Tab indents again
        self.put(4, 1, "config.sp")
        self.offers("speed", only=True)
        self.assertEqual(page.errors(), [])

    def test_each_snippet_is_what_check_accepts_and_begins_with_a_word_that_is_offered(self):
        system = self.begin()
        page = self.page
        snippets = page.driver.execute_async_script("""const done = arguments[0];
            import("/editor_snippets.js").then(({ SNIPPETS, places_in }) => done(Object.entries(SNIPPETS).flatMap(([kind, all]) =>
              Object.entries(all).map(([word, snippet]) => [kind, word, places_in(snippet).text]))))""")
        self.assertGreater(len(snippets), 8)
        texts = {}
        for kind, _, text in snippets:
            texts[kind] = texts.get(kind, "") + text + "\n"
        texts["systems"] += 'behavior "other" { script = "guide" }\n'
        with open(os.path.join(system.folder, "behaviors", "robot_controller.lua"), "w") as out:
            out.write(GUIDE)
        for kind, name in (("behaviors", "behaviors/filled.lua"), ("systems", "filled.lua"), ("scenarios", "filled_test.lua")):
            with open(os.path.join(system.folder, name), "w") as out:
                out.write(texts[kind])
            checked = subprocess.run([self.nezumi, "check", name], cwd=system.folder, capture_output=True, text=True)
            self.assertIn("nothing wrong", checked.stdout, texts[kind] + checked.stderr)
        with open(os.path.join(system.folder, "filled_test.lua"), "w") as out:
            out.write("\n")
        page.driver.refresh()
        page.ready()
        page.view("editor")
        for file, kind in (("behaviors/guide.lua", "behaviors"), ("tried.lua", "systems"), ("filled_test.lua", "scenarios")):
            page.until("document.querySelector('[data-file=\"%s\"]')" % file, "%s is listed" % file).click()
            page.until("document.querySelector('.editor .tools h2').textContent === %r" % file.split("/")[-1], "it is open")
            for word in [each for of, each, _ in snippets if of == kind]:
                self.put(1, 1, word)
                self.offers(word + " …")
                self.put(1, 1, ESCAPE)
                page.js("document.querySelector('.CodeMirror').CodeMirror.undo()")

    def test_names_are_offered_with_what_they_mean(self):
        self.begin()
        page = self.page
        self.put(4, 1, "local a = config.")
        self.offers("fails", "speed", only=True)
        self.assertIn("forward speed", page.text(".CodeMirror-hints"))
        self.put(4, 18, "sp")
        page.until("document.querySelectorAll('.CodeMirror-hint').length === 1", "one is left")
        page.driver.switch_to.active_element.send_keys("\n")
        self.assertIn("local a = config.speed\n", self.text())
        self.put(8, 14, "v")
        self.offers("va", "vx", "vy", only=True)

    def test_ports_types_and_the_library_are_offered(self):
        self.begin()
        for typed, name in (("out:wr", "write"), ("local b = math.fl", "floor"), ('local c = input("c", "TimedVel', "TimedVelocity2D"), ("pro", "probe(name, value)")):
            self.put(4, 1, typed)
            self.offers(name)
            self.page.driver.switch_to.active_element.send_keys(ESCAPE)
            self.page.js("document.querySelector('.CodeMirror').CodeMirror.replaceRange('', { line: 3, ch: 0 }, { line: 3, ch: 99 })")

    def test_a_system_file_is_completed_by_the_running_system(self):
        self.begin()
        page = self.page
        page.js("document.querySelector('[data-file=\"tried.lua\"]').click()")
        page.until("document.querySelector('.editor .tools h2').textContent === 'tried.lua'", "it is open")
        self.put(5, 1, 'connect("guide.')
        self.offers("guide.out")
        page.driver.switch_to.active_element.send_keys(ESCAPE)
        self.put(5, 1, "box { si")
        self.offers("size")

    def test_a_name_is_explained_under_the_pointer_and_by_a_key(self):
        from selenium.webdriver.common.action_chains import ActionChains

        self.begin()
        page = self.page
        word = next(each for each in page.all(".CodeMirror-line span span") if each.text == "param")
        ActionChains(page.driver).move_to_element(word).perform()
        page.until("!document.querySelector('.word-tip').hidden", "it is explained")
        self.assertIn("Declares a parameter", page.text(".word-tip"))
        self.put(7, 24, F1)
        page.until("document.querySelector('.word-tip').textContent.includes('forward speed')", "the parameter is explained")
        self.told("[m/s] forward speed")

    def test_tab_leaves_the_text_after_escape(self):
        self.begin()
        self.put(4, 1, TAB)
        self.assertIn("\n  \nfunction", self.text())
        self.put(4, 3, ESCAPE + TAB)
        self.page.until("document.activeElement.textContent === 'Save'", "the focus is outside")


class Running(EditorCase):
    def test_an_error_opens_its_file_at_the_line(self):
        self.begin()
        page = self.page
        page.view("world")
        time.sleep(1.1)  # lines of the log in the first second make no notices
        page.find(".console textarea").send_keys("guide.config.fails = true\n")
        page.press("Open line 6")
        page.until("document.querySelector('.editor').offsetParent !== null", "the editor is shown")
        page.until("document.querySelector('.CodeMirror').CodeMirror.getCursor().line === 5", "the cursor is at the line")

    def test_values_are_shown_at_their_lines_while_it_runs(self):
        self.begin()
        page = self.page
        page.press("Values")
        page.until("[...document.querySelectorAll('.line-values')].some((each) => each.textContent.includes('v = 0.05'))", "the value of a local variable is shown")
        marks = page.js("const text = document.querySelector('.CodeMirror').CodeMirror; const ran = [];"
                        "text.eachLine((line) => { if (line.gutterMarkers?.['gutter-ran']) ran.push(text.getLineNumber(line) + 1); }); return ran")
        self.assertEqual(marks, [6, 7, 8, 9])
        page.press("Values")
        self.assertEqual(page.all(".line-values"), [])

    def test_time_pauses_at_a_line_that_was_clicked(self):
        self.begin()
        page = self.page
        number = next(each for each in page.all(".CodeMirror-linenumber") if each.text == "7")
        number.click()
        page.until("document.querySelector('.late').textContent === 'paused'", "time is paused")
        page.until("document.querySelector('.stopped-line') !== null", "the line is marked")
        self.told("Line 7 ran: time is paused")
        self.assertEqual(len(page.all(".break-sign")), 1)
        self.put(7, 1, F9)
        page.until("document.querySelector('.break-sign') === null", "the breakpoint is gone")
        page.press("Run")
        page.until("document.querySelector('.stopped-line') === null", "time passes")
        before = page.text(".clock")
        page.until("document.querySelector('.clock').textContent !== %r" % before, "time passes")
        self.assertEqual(page.errors(), [])

    def test_breakpoints_follow_their_lines_and_end_with_unwatch(self):
        self.begin()
        page = self.page
        self.put(6, 1, F9)
        page.until("document.querySelector('.late').textContent === 'paused'", "time is paused")
        self.put(4, 1, "\n\n")
        self.save()
        self.told("version 2 runs (guide)")
        page.until("document.querySelector('.console .output').textContent.includes('guide.lua:8')", "the engine has the new line")
        self.put(8, 1, F9)
        page.until("document.querySelector('.break-sign') === null", "the breakpoint is gone")
        page.press("Run")
        before = page.text(".clock")
        page.until("document.querySelector('.clock').textContent !== %r" % before, "time passes")
        self.put(8, 1, F9)
        page.until("document.querySelector('.break-sign') !== null", "it is there again")
        self.put(5, 1, F9)
        self.told("no function runs line 5")
        page.view("world")
        page.find(".console textarea").send_keys("unwatch()\n")
        page.until("[...document.querySelectorAll('.console .asked')].some((each) => each.textContent === 'unwatch()')", "it was asked")
        page.view("editor")
        page.until("document.querySelector('.break-sign') === null", "the breakpoint is gone")
        self.assertEqual(page.errors(), [])


class Access(EditorCase):
    CONTRAST = """
        const channels = (text) => text.match(/[\\d.]+/g).map(Number);
        const light = ([r, g, b]) => [r, g, b].map((each) => each / 255).map((each) => (each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4))
          .reduce((sum, each, i) => sum + each * [0.2126, 0.7152, 0.0722][i], 0);
        const behind = (node) => {
          for (let at = node; at; at = at.parentElement) {
            const color = channels(getComputedStyle(at).backgroundColor);
            if (color.length === 3 || color[3] > 0.9) return color;
          }
          return [255, 255, 255];
        };
        return [...document.querySelectorAll(arguments[0])].filter((each) => each.offsetParent && each.textContent.trim()).map((each) => {
          const [one, other] = [light(channels(getComputedStyle(each).color)), light(behind(each))];
          return [each.className || each.tagName, each.textContent.slice(0, 20), (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05)];
        }).filter(([, , ratio]) => ratio < 4.5);"""

    def test_everything_has_a_name_and_is_readable_in_light_and_dark(self):
        self.begin()
        page = self.page
        self.addCleanup(page.resize, *self.size)
        self.put(8, 1, "  owt:write {} -- a comment\n")
        page.until("document.querySelector('.finding-row')", "it is found", 60)
        without_name = page.js("return [...document.querySelectorAll('.editor button, .editor input, .editor select, .scenarios button')]"
                               ".filter((each) => each.offsetParent && !each.textContent.trim() && !each.getAttribute('aria-label')).map((each) => each.outerHTML)")
        self.assertEqual(without_name, [])
        seen = ".editor h2, .editor h3, .file span, .finding-row b, .finding-row span, .CodeMirror-linenumber, .cm-keyword, .cm-string, .cm-number, .cm-comment, .cm-builtin, .finding-sign"
        self.assertEqual(page.js(self.CONTRAST, seen), [])
        page.resize(1500, 950, dark=True)
        page.until("getComputedStyle(document.documentElement).colorScheme === 'dark'", "it is dark")
        rig.wait_until(lambda: page.js(self.CONTRAST, seen) == [], lambda: "%s is readable" % page.js(self.CONTRAST, seen))  # colours change slowly


class OnPhone(EditorCase):
    size = (390, 844)

    def test_a_phone_chooses_a_file_and_edits_it(self):
        self.begin()
        page = self.page
        self.assertEqual(page.js("return document.documentElement.scrollWidth"), 390)
        page.press("Files")
        page.until("document.querySelector('[data-file=\"behaviors/lib/tools.lua\"]').offsetParent !== null", "the files are listed")
        page.find("[data-file='behaviors/lib/tools.lua']").click()
        page.until("document.querySelector('.CodeMirror').CodeMirror.getValue().startsWith('return { a')", "it is open")
        self.assertGreater(page.js("return document.querySelector('.CodeMirror').offsetHeight"), 250)


if __name__ == "__main__":
    sys.exit(rig.main(__name__))
