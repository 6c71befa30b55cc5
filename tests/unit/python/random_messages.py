"""Random definitions of messages, and random values of them."""

import struct

# How struct packs the kinds of ROS, whose integers have these ranges.
PACKED = {"bool": "?", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
          "int64": "q", "uint64": "Q", "float32": "f", "float64": "d"}


def random_definition(dice, number):
    """Fields of "rnd/R7": (kind, None for one value, 0 for a sequence, a length for an array, name)."""
    kinds = list(PACKED) + ["string"] + ["R%d" % dice.randrange(number) for _ in range(2) if number > 0 and number % 8]
    return [(dice.choice(kinds), dice.choice([None, None, 0, dice.randint(1, 4)]), "f%d" % i)
            for i in range(dice.randint(1, 6))]


def random_value(dice, types, kind):
    if kind == "string":
        return "".join(dice.choice("aZ9 ü\"\\\n") for _ in range(dice.randrange(6)))
    if kind == "bool":
        return dice.random() < 0.5
    if kind.startswith("float"):
        value = dice.choice([0.0, -0.5, 1e300, float("inf"), dice.gauss(0, 1e3)])
        return value if kind == "float64" else struct.unpack("f", struct.pack("f", max(min(value, 1e30), -1e30)))[0]
    if kind in PACKED:
        # Lua's integers have 64 bits with a sign, and JSON's are exact to 2^53.
        bits = min(8 * struct.calcsize(PACKED[kind]), 53)
        return dice.randrange(0 if kind.startswith("u") else -(1 << (bits - 1)), 1 << (bits - 1))
    return random_message(dice, types, kind)


def random_message(dice, types, name):
    message = {}
    for kind, shape, field in types[name]:
        count = dice.randrange(4) if shape == 0 else shape
        if (kind, shape) == ("uint8", 0):  # bytes, which Lua has as a string
            message[field] = "".join(chr(dice.randrange(128)) for _ in range(count))
            continue
        message[field] = (random_value(dice, types, kind) if shape is None else
                          [random_value(dice, types, kind) for _ in range(count)])
    return message


def definition_text(fields):
    """The definition as a file of ROS."""
    shapes = {None: "", 0: "[]"}
    return "".join("%s%s %s\n" % (kind, shapes.get(shape, "[%s]" % shape), field) for kind, shape, field in fields)
