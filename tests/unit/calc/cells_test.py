"""What the spreadsheet's link makes of cells and messages, without an office."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

BINDINGS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../bindings")
sys.path.insert(0, BINDINGS + "/calc")
from console import lua
from tables import address, rows_of
from values import Type, Wrong, message_of

VELOCITY = Type("TimedVelocity2D", [[name, "m/s", "number", False] for name in ("vx", "vy", "va")])
POSE = Type("TimedPose2D", [[name, "m", "number", False] for name in ("position.x", "position.y", "heading")])
RANGES = Type.of_texts("RangeData", ["ranges[]: number [m]", "config.minRange: number [m]"])
SHORTS = Type.of_texts("TimedShortSeq", ["[]: integer"])
TEXT = Type.of_texts("TimedString", [": text"])


def message(kind, headings, *contents):
    """The message of a row with these headings and contents, as Lua."""
    parts = kind.columns(headings)
    cells = enumerate(zip(parts, contents))
    return lua(message_of([(address(1, i), part, content) for i, (part, content) in cells if part]))


class CellsTest(unittest.TestCase):
    def test_addresses_are_those_of_the_program(self):
        names = [address(0, 0), address(9, 25), address(99, 26), address(0, 701), address(0, 702)]
        self.assertEqual(names, ["A1", "Z10", "AA100", "ZZ1", "AAA1"])

    def test_headings_say_which_field_a_column_is_in_any_order(self):
        self.assertEqual(message(VELOCITY, ["va [rad/s]", "vx"], 1.0, 0.25), '{["va"]=1.0,["vx"]=0.25}')
        pose = message(POSE, ["heading (rad)", "position.y"], 1.5, 2.0)
        self.assertEqual(pose, '{["heading"]=1.5,["position"]={["y"]=2.0}}')
        self.assertEqual(message(VELOCITY, ["vx", "remarks", "va"], 1.0, "slow", ""), '{["vx"]=1.0}')

    def test_without_names_in_the_headings_fields_have_their_own_order(self):
        self.assertEqual(message(VELOCITY, ["a", "b"], 1.0, 2.0), '{["vx"]=1.0,["vy"]=2.0}')
        self.assertEqual(message(SHORTS, ["1", "2", "3"], 31.0, 0.0, ""), "{[1]=31.0,[2]=0.0}")
        self.assertEqual(message(RANGES, ["r", "r"], 0.5, 1.0), '{["ranges"]={[1]=0.5,[2]=1.0}}')
        both = message(RANGES, ["ranges[1] [m]", "config.minRange"], 0.5, 0.03)
        self.assertEqual(both, '{["ranges"]={[1]=0.5},["config"]={["minRange"]=0.03}}')

    def test_a_slip_in_a_heading_is_told(self):
        with self.assertRaisesRegex(Wrong, r"^TimedPose2D has no field 'headin' \(did you mean 'heading'\?\)$"):
            POSE.columns(["position.x", "headin"])

    def test_empty_cells_are_no_message_and_a_sequence_has_no_gap(self):
        self.assertEqual(message(VELOCITY, ["vx", "va"], "", ""), "nil")
        self.assertEqual(message(VELOCITY, ["vx", "va"], "", 1.0), '{["va"]=1.0}')
        with self.assertRaisesRegex(Wrong, "^A2 is empty: a sequence has no gaps$"):
            message(SHORTS, ["1", "2"], "", 1.0)

    def test_a_text_has_its_limit(self):
        self.assertEqual(len(message(TEXT, ["value"], "x" * 1000)), 1002)
        with self.assertRaisesRegex(Wrong, "^A2: the text has more than 1000 characters and is not sent$"):
            message(TEXT, ["value"], "x" * 1001)

    def test_a_part_of_a_message_is_found_and_none_behind_its_end(self):
        self.assertEqual(POSE.part("position.y").of({"position": {"x": 1, "y": 2}, "heading": 0}), 2)
        self.assertEqual([part.of([7, 8]) for part in SHORTS.parts(3)], [7, 8, None])
        self.assertIsNone(SHORTS.part("0"))
        self.assertIsNone(VELOCITY.part("vx[1]"))
        self.assertEqual((SHORTS.length([1, 2]), RANGES.length({"ranges": []}), POSE.length({})), (2, 0, 3))

    def test_texts_go_over_as_they_are_whatever_is_in_them(self):
        self.assertEqual(message(TEXT, ["value"], 'a"b\\c\n]] é'), '"a\\034b\\092c\\010]] \\195\\169"')
        self.assertEqual(message(TEXT, ["value"], 7.0), '"7"')
        self.assertEqual(lua([True, None, -0.0, 1e300, 2.5, "x"]), '{true,nil,-0.0,1e+300,2.5,"x"}')
        self.assertEqual(lua("half a character: \ud800"), '"half a character: ?"')

    def test_a_number_without_end_is_one_that_lua_has(self):
        self.assertEqual(lua([float("inf"), float("-inf"), float("nan")]), "{math.huge,-math.huge,(0/0)}")

    def test_the_installed_link_finds_the_client_that_was_installed_with_it(self):
        with tempfile.TemporaryDirectory() as prefix:
            calc, client = prefix + "/share/nezumi/bindings/calc", prefix + "/lib/python3/dist-packages"
            os.makedirs(calc)
            os.makedirs(client)
            for name in ("console.py", "tables.py", "values.py"):
                shutil.copy(BINDINGS + "/calc/" + name, calc)
            shutil.copy(BINDINGS + "/python/nezumi.py", client)
            with open(client + "/tables.py", "w") as others:  # PyTables, for one, is installed there under this name
                others.write("raise ImportError('this is not the link')")
            text = "import sys; sys.path.insert(0, %r); import console, tables; print(console.client.__file__)" % calc
            found = subprocess.run(
                [sys.executable, "-B", "-E", "-s", "-c", text], capture_output=True, text=True, cwd="/"
            )
            self.assertEqual(os.path.realpath(found.stdout.strip()), os.path.realpath(client + "/nezumi.py"), found.stderr)

    def test_of_a_picture_all_but_the_pixels_is_shown(self):
        picture = Type("CameraImage", [["width", "px", "integer", False], ["pixels", "", "octets", False]])
        self.assertTrue(picture.has_bytes)
        self.assertEqual([part.name for part in picture.parts(8)], ["width"])
        self.assertFalse(SHORTS.has_bytes)

    def test_tables_begin_with_port_and_state_and_end_at_the_first_empty_row(self):
        data = [
            ("nezumi", "", "", "", "", "", ""),
            ("Port", "State", "vx", "", "Port", "State", 1.0),
            ("a.out", "", 0.0, "note", "watch a.in", "", 5.0),
            ("a", "", "", "", "", "", ""),
            ("", "", "", "", "", "", ""),
            ("b.out", "", "", "", "Port", "", ""),
        ]
        rows, tells = rows_of(3, data)
        self.assertTrue(tells)
        self.assertFalse(rows_of(0, data[1:])[1])
        found = [(row.path, row.row, row.column, row.headings, row.limit, row.word) for row in rows]
        self.assertEqual(
            found, [("a.out", 2, 0, ["vx"], 2, None), (None, 3, 0, ["vx"], 2, None), ("a.in", 2, 4, ["1"], 64, "watch")]
        )
        self.assertEqual(rows[1].problem, "expected a port, such as mouse.ir_sensor_out")


if __name__ == "__main__":
    unittest.main()
