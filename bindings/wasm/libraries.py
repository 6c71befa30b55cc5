"""The page's libraries, as bindings/web/page/editor_library.js and playground.html name them."""
import pathlib
import re

PAGE = pathlib.Path(__file__).resolve().parents[1] / "web/page"
EDITOR = (PAGE / "editor_library.js").read_text()
HEAD = (PAGE / "playground.html").read_text()


def editor_scripts():
    """The scripts of the editor, in the order in which they are loaded."""
    listed = re.search(r"SCRIPTS = \[(.*?)\]", EDITOR, re.S).group(1)
    return ["lib/codemirror/" + name for name in re.findall(r'"([^"]+)"', listed)]


def editor_styles():
    return ["lib/codemirror/" + name for name in re.findall(r"\$\{HOME\}([\w./-]+\.css)", EDITOR)]


def scripts():
    return re.findall(r'src="(lib/[^"]+)"', HEAD) + editor_scripts()


def styles():
    """All style sheets of the page; those of libraries come first."""
    of_page = re.findall(r'href="([^"]+\.css)"', HEAD)
    return [name for name in of_page if name.startswith("lib/")] + editor_styles() + [name for name in of_page if not name.startswith("lib/")]


NAMED_MODULE = re.compile(r'"\./((?:[\w-]+/)*[\w.-]+\.js)"')


def modules_from(folder, first):
    """All modules that the module `first` needs: their texts by their names."""
    modules, waiting = {}, [first]
    while waiting:
        name = waiting.pop()
        if name not in modules:
            modules[name] = (folder / name).read_text()
            waiting += NAMED_MODULE.findall(modules[name])
    return modules
