"""Conversion between cells and messages: which cell holds which field of a message, and how its content is read."""

import difflib
import re

LONGEST_TEXT = 1000
NUMBER, INTEGER, BOOLEAN, TEXT, OCTETS = "number", "integer", "boolean", "text", "octets"


class Wrong(Exception):
    """Invalid content of a cell; the text says why."""


class Part:
    """One number, boolean or text of a message: its name within the message, its unit, its kind."""

    def __init__(self, name, unit, kind, steps):
        self.name, self.unit, self.kind, self.steps = name, unit, kind, steps

    @property
    def label(self):
        """Its name among the samples of the system: "position.x", "ranges[1]", "[1]", "" for a single value."""
        label = ""
        for step in self.steps:
            label += "[%d]" % (step + 1) if isinstance(step, int) else ("." if label else "") + step
        return label

    def of(self, message):
        """Its value in a message as JSON; None where a sequence is shorter."""
        for step in self.steps:
            if isinstance(step, int):
                message = message[step] if isinstance(message, list) and step < len(message) else None
            else:
                message = message.get(step) if isinstance(message, dict) else None
        return message


class Type:
    """A message type. `fields` are [name, unit, kind, is a sequence], the name "" for a type that is one value."""

    def __init__(self, name, fields):
        self.name = name
        self._fields = [field for field in fields if field[2] != OCTETS]
        self.has_bytes = len(self._fields) < len(fields)  # cells show everything else
        self.is_sequence = bool(fields) and fields[0][3]  # what it carries first, or all of it

    @classmethod
    def of_texts(cls, name, texts):
        """A type whose fields are texts of the system: "position.x: number [m]", "ranges[]: number [m]"."""
        found = [re.fullmatch(r"(.*?)(\[\])?: (\w+)(?: \[(.*)\])?", text) for text in texts]
        return cls(name, [[each[1], each[4] or "", each[3], each[2] is not None] for each in found])

    def part(self, name):
        """A part by its name; None when there is no such part."""
        found = re.fullmatch(r"([A-Za-z_][\w.]*)?\[?([1-9]\d*)?\]?", name, re.ASCII)
        for field, unit, kind, is_sequence in self._fields if found else ():
            steps = field.split(".") if field else []
            if is_sequence and (found[1] or "") == field and found[2]:
                return Part(name, unit, kind, steps + [int(found[2]) - 1])
            if not is_sequence and name == field:
                return Part(name, unit, kind, steps)
        return None

    def parts(self, count):
        """The first `count` parts in the order of the fields: the columns when there are no headings."""
        if not self.is_sequence:
            return [self.part(name) for name, _, _, is_sequence in self._fields if not is_sequence][:count]
        name = self._fields[0][0]
        return [self.part("%s[%d]" % (name, i + 1) if name else str(i + 1)) for i in range(count)]

    def length(self, message):
        """The number of cells that show the whole message."""
        if not self.is_sequence:
            return sum(1 for field in self._fields if not field[3])
        name = self._fields[0][0]
        for step in name.split(".") if name else []:
            message = message.get(step, [])
        return len(message)

    def columns(self, headings):
        """The part of each column below these headings; None for a column of something else. A heading that matches no
        field is ignored; one that nearly matches is an error."""
        texts = [re.sub(r"\s*[\[(][^\[\]()\d][^\[\]()]*[\])]\s*$", "", heading).strip() for heading in headings]
        named = [self.part(text) if text else None for text in texts]
        known = [field[0] for field in self._fields if field[0]]
        if not known or not any(named):
            return self.parts(len(headings))
        for text, part in zip(texts, named):
            near = [] if part else difflib.get_close_matches(text, known, 1)
            if near:
                raise Wrong("%s has no field '%s' (did you mean '%s'?)" % (self.name, text, near[0]))
        return named


def from_cell(content, kind, address):
    """The value that a cell's content is for a part of that kind. Numbers are checked further by the system."""
    if kind == TEXT:
        if isinstance(content, str):
            if len(content) > LONGEST_TEXT:
                raise Wrong("%s: the text has more than %d characters and is not sent" % (address, LONGEST_TEXT))
            return content
        return str(int(content)) if content.is_integer() else repr(content)
    if kind == BOOLEAN:
        if isinstance(content, str) and content.strip().lower() in ("true", "false"):
            return content.strip().lower() == "true"
        if content in (0.0, 1.0):
            return content == 1.0
        raise Wrong("%s: expected TRUE or FALSE, got %s" % (address, shown(content)))
    if isinstance(content, str):
        raise Wrong("%s: expected a number, got %s" % (address, shown(content)))
    return content


def shown(content):
    if not isinstance(content, str):
        return "%.15g" % content
    return "'%s'" % (content if len(content) <= 40 else content[:40] + "...")


def message_of(cells):
    """The message that (address, part, content) of a row's cells make; None when all of them are empty."""
    if all(content == "" for _, _, content in cells):
        return None
    message = {}
    empty = None  # the first empty cell of a sequence
    for address, part, content in cells:
        in_sequence = isinstance(part.steps[-1] if part.steps else None, int)
        if content == "":
            empty = empty or (address if in_sequence else None)
            continue
        if in_sequence and empty:
            raise Wrong("%s is empty: a sequence has no gaps" % empty)
        value = from_cell(content, part.kind, address)
        if not part.steps:
            return value
        inner = message
        for step in part.steps[:-1]:
            inner = inner.setdefault(step, {})
        last = part.steps[-1]
        inner[last + 1 if isinstance(last, int) else last] = value  # Lua counts from 1
    return message
