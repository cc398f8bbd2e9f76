"""check_installed_headers.py INCLUDE_DIR: an installed header includes only installed ones of ours."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
headers = sorted(root.glob("turnscan/**/*.hpp"))
missing = [f"{header.relative_to(root)} includes {name}, which is not installed"
           for header in headers
           for name in re.findall(r"^#include <(turnscan/[^>]+)>", header.read_text(), re.MULTILINE)
           if not (root / name).exists()]
print("\n".join(missing) or f"{len(headers)} headers")
sys.exit(1 if missing or not headers else 0)
