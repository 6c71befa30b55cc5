"""A table on a page of the docs that a test's run brings up to date: it stands between `<!-- NAME -->` and `<!-- end NAME -->`."""

import pathlib
import re


def renew(page, name, head, rows):
    """The rows, each of as many texts as the head, become the page's table of this name."""
    page = pathlib.Path(page)
    text = page.read_text(encoding="utf-8")
    lines = (head, ["---"] * len(head), *rows)
    table = "".join(f"| {' | '.join(map(str, line))} |\n" for line in lines)
    begin, end = f"<!-- {name} -->\n", f"<!-- end {name} -->"
    new, places = re.subn(re.escape(begin) + ".*?" + re.escape(end), lambda _: begin + table + end, text, flags=re.S)
    if places != 1:
        raise ValueError(f"{page} has no place for the table `{name}`")
    page.write_text(new, encoding="utf-8")
