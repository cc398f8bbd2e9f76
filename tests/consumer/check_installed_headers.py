"""check_installed_headers.py INCLUDE_DIR: few headers are installed; they include only installed ones
of ours, and each is reached from the one that includes all, or is for drivers."""

import pathlib
import re
import sys

MAX_HEADERS = 40
ROOTS = ("turnscan/turnscan.hpp", "turnscan/capture/source/plugin.h")

root = pathlib.Path(sys.argv[1])
headers = {str(path.relative_to(root)) for path in root.glob("turnscan/**/*") if path.is_file()}
includes = {name: re.findall(r"^#include <(turnscan/[^>]+)>", (root / name).read_text(), re.MULTILINE)
            for name in headers}
faults = [f"{name} includes {target}, which is not installed"
          for name in sorted(headers) for target in includes[name] if target not in headers]
reached, waiting = set(), list(ROOTS)
while waiting:
    name = waiting.pop()
    if name not in reached:
        reached.add(name)
        waiting += includes.get(name, [])
faults += [f"{name} is not installed" for name in ROOTS if name not in headers]
faults += [f"{name} is not included by {ROOTS[0]}" for name in sorted(headers - reached)]
if len(headers) > MAX_HEADERS:
    faults.append(f"{len(headers)} headers are installed; {MAX_HEADERS} at most")
print("\n".join(faults) or f"{len(headers)} headers")
sys.exit(1 if faults else 0)
