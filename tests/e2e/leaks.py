"""What no output of the program may hold: a figure that is not known, printed as if it were one.

The harness looks for it after every run, on both streams and in the JSON and HTML files that the
run wrote.
"""

import json
import pathlib
import re

UNITS = "mm|cm|m|um|deg|rad|s|deg/s"
# A number that is none, with or without a unit; and the metre, in millimetres, that stands for
# more than can be said.
LEAK = re.compile(rf"(?<![\w./'])[-+]?(?:nan|inf)(?:{UNITS})?(?![\w/'-]|\.\w)|(?<![\d.])1000\.00(?= ?mm)")
# The models and scripts of a page are not read by people.
NOT_WORDS = re.compile(r"<(script|style)\b.*?</\1>|<[^>]*>", re.DOTALL)


def in_text(text):
    """The leaks in a text, each with what stands around it."""
    return [text[max(0, m.start() - 60):m.end() + 20] for m in LEAK.finditer(text)]


def in_file(path):
    text = path.read_text(errors="replace")
    if path.suffix == ".html":
        return in_text(NOT_WORDS.sub(" ", text))
    constants = []
    try:
        json.loads(text, parse_constant=constants.append)
    except ValueError:
        return []  # cut off, by a test that stops the program
    return constants + in_text(text)


def written_files(args, cwd, since_ns):
    """The JSON and HTML files, in the folder and in what options name, younger than that."""
    args = list(map(str, args))
    base = pathlib.Path(cwd or ".")
    places = {base} if cwd else set()
    for before, arg in zip(args, args[1:]):
        if before.startswith("-"):
            places.add(base / arg)
    for place in places:
        try:
            for path in [place] if place.is_file() else place.rglob("*"):
                if path.suffix in (".json", ".html") and path.stat().st_mtime_ns > since_ns:
                    yield path
        except OSError:
            pass  # not ours to look at, or gone by now


def of_run(args, cwd, since_ns, out, err):
    """Sentences about all leaks of one run; empty: there are none."""
    found = [f"{name}: {leak!r}" for name, text in (("stdout", out), ("stderr", err))
             for leak in in_text(text or "")]
    for path in written_files(args, cwd, since_ns):
        found += [f"{path.name}: {leak!r}" for leak in in_file(path)]
    return found
