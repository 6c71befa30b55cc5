"""Writes docs/llms.txt: the documentation's pages for language models, each with its first sentence.

    python3 bindings/agent/llms.py > docs/llms.txt"""

import os
import re
import sys


def first_sentence(lines):
    paragraph = []
    for line in lines[1:]:
        if line.startswith(("#", "|", "```", "!", "<", "- ", "[日本語]")):
            if paragraph:
                break
            continue
        if not line.strip():
            if paragraph:
                break
            continue
        paragraph.append(line.strip())
    plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", " ".join(paragraph))
    return re.split(r"(?<=[.:])\s", plain, maxsplit=1)[0]


def text(docs):
    lines = ["# nezumi", "", "> A behaviour engine for small wheeled robots: a C++ engine simulates and drives them, behaviours are "
             "Lua files that reload when they are saved, scenarios test them.", "", "## Pages", ""]
    for name in sorted(os.listdir(docs)):
        if name.endswith(".md"):
            with open(os.path.join(docs, name), encoding="utf-8") as file:
                page = file.read().splitlines()
            lines.append("- [%s](%s): %s" % (page[0].strip("# "), name, first_sentence(page)))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(text(os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "docs")))
