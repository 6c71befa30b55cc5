"""Random definitions of messages through the real LibreOffice Calc: what is typed below an in-port is what a behaviour
sends back. Usage: random_messages_office_test.py NEZUMI [TEST...]"""

import os
import random
import struct
import sys

sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python")]
import rig
from random_messages import PACKED, definition_text, random_definition

DEFINITIONS = 400  # as in the other tests of random definitions; a part of them is drawn
DRAWN = 40
MOST_COLUMNS = 60


def leaves(types, name, path=""):
    """(heading, kind) of what cells can hold: values, and the elements of arrays and sequences of values."""
    for kind, shape, field in types[name]:
        at = path + field
        is_value = kind in PACKED or kind == "string"
        if is_value and shape is None:
            yield at, kind
        elif is_value:
            for i in range(shape or 3):
                yield "%s[%d]" % (at, i + 1), kind
        elif shape is None:
            yield from leaves(types, kind, at + ".")


def has_bytes(types, name):
    """True if cells can't hold all of it: they show a message without its bytes, and feed none."""
    return any((kind, shape) == ("uint8", 0) or (shape is None and kind in types and has_bytes(types, kind))
               for kind, shape, _ in types[name])


def random_cell(dice, kind):
    """A value as a cell has it: a number or a text."""
    if kind == "string":
        return "t" + "".join(dice.choice("aZ9 ü\"\\") for _ in range(dice.randrange(6)))
    if kind == "bool":
        return float(dice.randrange(2))
    if kind == "float32":
        return struct.unpack("f", struct.pack("f", dice.gauss(0, 1e3)))[0]
    if kind == "float64":
        return dice.choice([-0.5, 1e300, float("%.15g" % dice.gauss(0, 1e3))])  # a file of Calc has 15 digits
    bits = min(8 * struct.calcsize(PACKED[kind]), 53)
    return float(dice.randrange(0 if kind.startswith("u") else -(1 << (bits - 1)), 1 << (bits - 1)))


class RandomMessages(rig.OfficeCase):
    """Types that no one has seen before."""

    def test_cells_of_random_messages_come_back_as_they_were_typed(self):
        seed = int(os.environ.get("NEZUMI_SEED", "1"))
        dice = random.Random(seed)
        types = {"R%d" % number: random_definition(dice, number) for number in range(DEFINITIONS)}
        os.makedirs(self.place.path("behaviors", "messages", "rnd"))
        for name, fields in types.items():
            self.place.write(os.path.join("behaviors", "messages", "rnd", name + ".msg"), definition_text(fields))
        columns = {name: list(leaves(types, name)) for name in types}
        usable = [name for name, all_leaves in columns.items()
                  if 0 < len(all_leaves) <= MOST_COLUMNS and not has_bytes(types, name)]
        drawn = dice.sample(usable, DRAWN)
        self.place.write("behaviors/echo.lua", "--- Sends what comes.\nlocal all = {\n" + "".join(
            '  { input("i%s", "rnd/%s"), output("o%s", "rnd/%s") },\n' % (name, name, name, name) for name in drawn) + """}
function on_execute()
  for _, pair in ipairs(all) do
    if pair[1].is_new then pair[2]:write(pair[1]:read()) end
  end
end
""")
        system = self.system('behavior "echo" { script = "echo" }\n')
        rows, typed = [], {}
        for name in drawn:
            typed[name] = [random_cell(dice, kind) for _, kind in columns[name]]
            rows += [["Port", "State"] + [heading for heading, _ in columns[name]],
                     ["echo.i" + name, ""] + typed[name], ["echo.o" + name], []]
        link = self.link(system, rows)
        for index, name in enumerate(drawn):
            with self.subTest(seed=seed, name=name, fields=types[name]):
                last = len(typed[name]) + 1

                def shown(row, last=last):
                    return list(link.sheet.getCellRangeByPosition(2, row, last, row).getDataArray()[0])
                row = 4 * index + 2
                rig.wait_until(lambda row=row, name=name: shown(row) == typed[name],
                               lambda row=row, name=name: "%s shows %r, not %r: %r" % (
                                   name, shown(row), typed[name], link.sheet.getCellRangeByPosition(0, row - 1, 1, row).getDataArray()))


if __name__ == "__main__":
    rig.main()
