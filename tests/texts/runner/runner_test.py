"""Tests the runner of tests/texts: what is as expected passes, and each difference fails and is told at its line."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).parents[3]


def run(kind, text, name="it.lua", words=()):
    """Runs one file of a kind. Returns the exit status, what is printed without the folder's path, the file after."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, kind, name)
        file.parent.mkdir()
        file.write_text(text)
        done = subprocess.run([PROGRAM, "--root", folder, *words, file], capture_output=True, text=True, cwd=ROOT, check=False)
        return done.returncode, (done.stdout + done.stderr).replace(str(file), name), file.read_text()


SEED = "seed: expected a whole number from 0 on, got -1"


class Runner(unittest.TestCase):
    def passes(self, kind, text, name="it.lua"):
        status, said, _ = run(kind, text, name)
        self.assertEqual((status, said), (0, "1 case, 0 not as expected\n"))

    def fails(self, kind, text, *told, name="it.lua"):
        status, said, _ = run(kind, text, name)
        self.assertEqual(status, 1)
        self.assertEqual(said.splitlines()[: len(told)], list(told))

    def test_passes_where_the_error_is_as_expected_at_its_line(self):
        self.passes("systems", f"--- A.\nrate(50)\nseed(-1)  -- error: {SEED}\n\nseed(1)\n")

    def test_an_expectation_may_stand_below_its_line(self):
        self.passes("systems", f"--- A.\nseed(-1)\n-- error: {SEED}\nrate(50)\n")

    def test_a_caret_names_the_column(self):
        text = "--- A.\nphysics { step = -1 }\n--        ^ error: physics: field 'step' expected a positive number, got -1\n"
        self.passes("systems", text)
        self.fails("systems", text.replace("--        ^", "--         ^"),
                   "it.lua:2:12: expected, and it is not said: error: physics: field 'step' expected a positive number, got -1",
                   "it.lua:2:11: said, and it is not expected: error: physics: field 'step' expected a positive number, got -1")

    def test_three_dots_stand_for_any_text(self):
        self.passes("systems", "--- A.\nseed(-1)  -- error: seed: ... got -1\n")
        self.fails("systems", "--- A.\nseed(-1)  -- error: seed: ... got -2\n",
                   "it.lua:2: expected, and it is not said: error: seed: ... got -2")

    def test_fails_where_an_error_is_not_expected(self):
        self.fails("systems", "--- A.\nrate(50)\nseed(-1)\n", f"it.lua:3: said, and it is not expected: error: {SEED}")

    def test_fails_where_an_expected_error_is_not_said(self):
        self.fails("systems", f"--- A.\nseed(1)  -- error: {SEED}\n", f"it.lua:2: expected, and it is not said: error: {SEED}")

    def test_fails_where_the_error_is_at_another_line(self):
        self.fails("systems", f"--- A.\nrate(50)  -- error: {SEED}\nseed(-1)\n",
                   f"it.lua:2: expected, and it is not said: error: {SEED}",
                   f"it.lua:3: said, and it is not expected: error: {SEED}")

    def test_fails_where_one_text_of_several_is_not_as_expected(self):
        self.fails("systems", f"--- A.\nseed(1)\n\nseed(-1)\n\nseed(-1)  -- error: {SEED}\n",
                   f"it.lua:4: said, and it is not expected: error: {SEED}", "1 case, 1 not as expected")

    def test_a_line_that_is_printed_must_be_expected_in_its_order(self):
        self.passes("sandbox", "--- A.\nfor i = 1, 2 do print(i) end\n-- prints: 1\n-- prints: 2\n")
        self.fails("sandbox", "--- A.\nfor i = 1, 2 do print(i) end\n-- prints: 2\n-- prints: 1\n",
                   "it.lua:2: expected, and it is not said: prints: 1", "it.lua:2: said, and it is not expected: prints: 1")
        self.fails("sandbox", "--- A.\nprint(1)\n", "it.lua:2: said, and it is not expected: prints: 1")

    def test_what_is_returned_must_be_expected(self):
        self.passes("sandbox", "--- A.\nx = 1\n\nreturn x + 1, 'a\\n'  -- returns: 2 a\\n\n")
        self.fails("sandbox", "--- A.\nreturn 1\n", "it.lua:2: said, and it is not expected: returns: 1")
        self.fails("sandbox", "--- A.\nreturn 1  -- returns: 2\n", "it.lua:2: expected, and it is not said: returns: 2")

    def test_an_error_in_another_file_is_expected_with_its_place(self):
        text = "--- A.\n-- file: m.lua\nlocal t = nil\nt.x = 1\n\nrequire 'm'"
        error = "m.lua:2: attempt to index a nil value (local 't') (called from behavior.lua:1)"
        self.passes("behaviors", f"{text}  -- error: {error}\n")
        self.fails("behaviors", f"{text}\n", f"it.lua:6: said, and it is not expected: error: {error}")

    def test_a_scenario_that_fails_differs_from_one_that_can_not_run(self):
        self.passes("scenarios", "--- A.\ns:check(false, 'no')  -- failed: check failed: no\n")
        self.fails("scenarios", "--- A.\ns:check(false, 'no')  -- error: check failed: no\n",
                   "it.lua:2: expected, and it is not said: error: check failed: no",
                   "it.lua:2: said, and it is not expected: failed: check failed: no")

    def test_a_command_is_answered_with_its_output_and_its_exit_status(self):
        self.passes("commands", "--- A.\n-- file: a\nx\n$ cat a\nx\n$ cat b 2>/dev/null\n[1]\n", "it.txt")
        self.fails("commands", "--- A.\n$ false\n", "it.txt:2: another answer:", "  + [1]", name="it.txt")

    def test_an_answer_of_a_transcript_is_compared_as_a_whole(self):
        self.passes("console", "--- A.\n> 1 + 1\n2\n> for i = 1, 2 do\n>> print(i) end\n1\n2\n\n> x = 1\n", "it.txt")
        self.fails("console", "--- A.\n> 1 + 1\n3\n", "it.txt:2: another answer:", "  - 3", "  + 2", name="it.txt")
        self.fails("console", "--- A.\n> print(1)\n", "it.txt:2: another answer:", "  + 1", name="it.txt")

    def test_a_file_that_is_no_file_of_texts_is_refused(self):
        self.fails("systems", "seed(1)\n", "it.lua:1: expected a case: a line `--- What happens.`")
        self.fails("systems", "--- A.\n\n--- B.\nseed(1)\n", "it.lua:1: a case without a text")
        self.fails("systems", "--- A.\nseed(1)\n--- A.\nseed(1)\n", "it.lua:3: another case of this file has the same name")
        self.fails("nothing", "--- A.\nseed(1)\n", "it.lua: nothing reads the folder 'nothing'")
        self.fails("systems", "--- A; B.\nseed(1)\n", "it.lua:1: a sentence with one of ; [ ], which ctest can't list")
        self.fails("console", "--- A.\n1 + 1\n", "it.txt:2: expected an input after '> ' or '$ '", name="it.txt")

    def test_renewing_writes_what_is_said(self):
        status, _, after = run("systems", "-- About.\n\n--- A.\nrate(50)  -- error: none\nseed(-1)\n\nphysics { step = -1 }\n", words=["--renew"])
        self.assertEqual(status, 1)
        self.assertEqual(after, f"-- About.\n\n--- A.\nrate(50)\nseed(-1)  -- error: {SEED}\n\nphysics {{ step = -1 }}\n"
                         "--        ^ error: physics: field 'step' expected a positive number, got -1\n")
        self.passes("systems", after.replace("-- About.\n\n", ""))
        _, _, after = run("console", "--- A.\n> 1 + 1\n3\n\n--- B.\n> 2\n2\n", name="it.txt", words=["--renew"])
        self.assertEqual(after, "--- A.\n> 1 + 1\n2\n\n--- B.\n> 2\n2\n")


if __name__ == "__main__":
    unittest.main()
