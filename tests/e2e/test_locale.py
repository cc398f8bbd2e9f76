"""The usage and result tests once more under a locale that writes 1,5 for 1.5. Without such a
locale on the machine, exit code 77 (skipped)."""

import os
import subprocess
import sys
import pathlib

HERE = pathlib.Path(__file__).parent


def comma_locale():
    installed = subprocess.run(["locale", "-a"], capture_output=True, text=True).stdout.split()
    for name in installed:
        env = {**os.environ, "LC_ALL": name}
        point = subprocess.run(["locale", "decimal_point"], capture_output=True, text=True, env=env)
        if point.stdout.strip() == ",":
            return name
    return None


if __name__ == "__main__":
    name = comma_locale()
    if name is None:
        print("no locale with a decimal comma is installed; skipped")
        sys.exit(77)
    print(f"LC_ALL={name}")
    env = {**os.environ, "LC_ALL": name}
    codes = [subprocess.run([sys.executable, HERE / test], env=env).returncode
             for test in ("test_usage.py", "test_results.py")]
    sys.exit(max(codes))
