"""Random definitions of messages with random values, through Python, a behaviour, MCAP and the journal:
defined_messages_test.py NEZUMI. MCAP and CDR are decoded here, from the schemas in the file alone."""

import ctypes
import ctypes.util
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path[:0] = [os.path.join(ROOT, "bindings", "python"), os.path.dirname(os.path.abspath(__file__))]

import nezumi  # noqa: E402
from random_messages import PACKED, definition_text, random_definition, random_message  # noqa: E402

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "nezumi"
DEFINITIONS = 400
ROUNDS = 2
PATIENCE = 120.0  # [s]


class Cdr:
    """Reads plain CDR by the fields of a schema."""

    def __init__(self, data):
        self.order = "<" if data[1] == 1 else ">"
        self.data, self.at = data[4:], 0

    def number(self, code):
        size = struct.calcsize(code)
        self.at += -self.at % size
        value = struct.unpack_from(self.order + code, self.data, self.at)[0]
        self.at += size
        return value

    def one(self, schemas, kind):
        if kind in PACKED:
            return self.number(PACKED[kind])
        if kind == "string":
            length = self.number("I")
            text = self.data[self.at:self.at + length - 1].decode()
            self.at += length
            return text
        return self.message(schemas, kind)

    def message(self, schemas, name):
        value = {}
        for kind, shape, field in schemas[name]:
            count = self.number("I") if shape == 0 else shape
            value[field] = self.one(schemas, kind) if shape is None else [self.one(schemas, kind) for _ in range(count)]
            if (kind, shape) == ("uint8", 0):
                value[field] = bytes(value[field]).decode()
        return value


def schemas_of(name, text):
    """The fields of each message in a schema of ROS, all of one package, by its name."""
    schemas = {}
    for block in re.split(r"^=+$", text, flags=re.M):
        lines = [line.split("#")[0].split() for line in block.strip().splitlines()]
        lines = [line for line in lines if line]
        if lines and lines[0][0] == "MSG:":
            name = lines.pop(0)[1]
        fields = []
        for kind, field in lines:
            found = re.fullmatch(r"([\w/]+)(?:\[(\d*)\])?", kind)
            shape = None if found[2] is None else int(found[2] or 0)
            inner = found[1].split("/")[-1]
            fields.append(({"byte": "uint8", "char": "uint8"}.get(inner, inner), shape, field))
        schemas[name.split("/")[-1]] = fields
    return schemas


def decompressed(kind, size, data):
    if kind == b"":
        return data
    library = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
    library.ZSTD_decompress.restype = ctypes.c_size_t
    out = ctypes.create_string_buffer(size)
    length = library.ZSTD_decompress(out, ctypes.c_size_t(size), data, ctypes.c_size_t(len(data)))
    if kind != b"zstd" or length != size:
        raise ValueError("can't read a chunk")
    return out.raw


def records(data):
    at = 0
    while at + 9 <= len(data):
        length = struct.unpack_from("<Q", data, at + 1)[0]
        yield data[at], data[at + 9:at + 9 + length]
        at += 9 + length


def text_at(data, at):
    length = struct.unpack_from("<I", data, at)[0]
    return data[at + 4:at + 4 + length], at + 4 + length


def read_mcap(path):
    """The messages of each topic, decoded."""
    with open(path, "rb") as file:
        data = file.read()
    magic = b"\x89MCAP0\r\n"
    assert data.startswith(magic) and data.endswith(magic)
    schemas, channels, messages = {}, {}, {}

    def take(kind, body):
        if kind == 3:  # schema
            name, at = text_at(body, 2)
            _, at = text_at(body, at)
            text, _ = text_at(body, at)
            schemas[struct.unpack_from("<H", body)[0]] = (name.decode(), text.decode())
        elif kind == 4:  # channel
            number, schema = struct.unpack_from("<HH", body)
            topic, _ = text_at(body, 4)
            channels[number] = (topic.decode(), schema)
        elif kind == 5:  # message
            topic, schema = channels[struct.unpack_from("<H", body)[0]]
            name, text = schemas[schema]
            messages.setdefault(topic, []).append((name, text, body[22:]))
        elif kind == 6:  # chunk
            size = struct.unpack_from("<Q", body, 16)[0]
            compression, at = text_at(body, 28)
            length = struct.unpack_from("<Q", body, at)[0]
            for inner in records(decompressed(compression, size, body[at + 8:at + 8 + length])):
                take(*inner)

    for record in records(data[len(magic):-len(magic)]):
        take(*record)
    return messages


class DefinedMessages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        os.environ["XDG_RUNTIME_DIR"] = self.folder

    def write(self, path, text):
        whole = os.path.join(self.folder, path)
        os.makedirs(os.path.dirname(whole), exist_ok=True)
        with open(whole, "w") as file:
            file.write(text)
        return whole

    def test_random_messages_come_back_as_they_were(self):
        seed = int(os.environ.get("NEZUMI_SEED", "1"))
        dice = random.Random(seed)
        types = {}
        ports = ""
        for number in range(DEFINITIONS):
            name = "R%d" % number
            types[name] = random_definition(dice, number)
            self.write("behaviors/messages/rnd/%s.msg" % name, definition_text(types[name]))
            ports += 'all[%d] = { input("i%d", "rnd/%s"), output("o%d", "rnd/%s") }\n' % (
                number + 1, number, name, number, name)
        self.write("behaviors/echo.lua", "--- Sends what comes.\nlocal all = {}\n" + ports + """
function on_execute()
  for _, pair in ipairs(all) do
    if pair[1].is_new then pair[2]:write(pair[1]:read()) end
  end
end
""")
        system = self.write("behaviors/systems/echo.lua", 'behavior "echo" { script = "echo" }\n')
        recording, journal = os.path.join(self.folder, "run.mcap"), os.path.join(self.folder, "run.journal")
        sent = {name: [] for name in types}
        with nezumi.start(system, "--record", recording, "--ports", "echo.o*", "--journal", journal, program=PROGRAM,
                          timeout=PATIENCE, folder=self.folder) as console:
            for _ in range(ROUNDS):
                for name in types:
                    sent[name].append(random_message(dice, types, name))
                for name, values in sent.items():
                    with self.subTest(seed=seed, name=name, fields=types[name], value=values[-1]):
                        console.inject("echo.i" + name[1:], values[-1])
                console.step(2)
                for name, values in sent.items():
                    with self.subTest(seed=seed, name=name, fields=types[name]):
                        self.assertEqual(values[-1], console.eval("echo.ports['o%s'].value" % name[1:]))
        messages = read_mcap(recording)
        for name, values in sent.items():
            with self.subTest(seed=seed, name=name, fields=types[name]):
                recorded = messages["/echo/o" + name[1:]]
                schema, text = recorded[0][:2]
                self.assertEqual(schema, "rnd/msg/" + name)
                fields = schemas_of(name, text)
                self.assertEqual(fields[name], types[name])
                self.assertEqual([Cdr(data).message(fields, name) for _, _, data in recorded], values)
        # The journal has the messages too: a replay sends the same.
        again = os.path.join(self.folder, "again.mcap")
        subprocess.run([PROGRAM, "run", system, "--headless", "--replay", journal, "--record", again, "--ports",
                        "echo.o*"], cwd=self.folder, check=True, timeout=PATIENCE, stdout=subprocess.DEVNULL)
        replayed = read_mcap(again)
        for name in types:
            topic = "/echo/o" + name[1:]
            self.assertEqual([each[2] for each in replayed[topic]], [each[2] for each in messages[topic]], name)


if __name__ == "__main__":
    unittest.main()
