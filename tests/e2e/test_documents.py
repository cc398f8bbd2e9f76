"""Every example of README.md and of the pages below docs works as written.

Blocks marked ```sh are run in order, one shell per block, all blocks of a document in one empty
folder with the program on the PATH. Blocks marked ```sh no-test are left out (installing packages,
data that a reader has and we have not), and so are those marked bare: scripts/test-on runs them on a
bare system.
"""

import os
import pathlib
import re
import subprocess

import harness
from harness import BIN, ROOT

BLOCK = re.compile(r"^```(\S+)([^\n]*)\n(.*?)^```", re.M | re.S)


def examples(text):
    return [body for kind, info, body in BLOCK.findall(text)
            if kind == "sh" and not {"no-test", "bare"} & set(info.split())]


class Documents(harness.TestCase):
    def run_document(self, path):
        bin_folder = self.dir / ".bin"
        bin_folder.mkdir()
        (bin_folder / "turnscan").symlink_to(pathlib.Path(BIN).resolve())
        env = {**os.environ, "PATH": f"{bin_folder}:{os.environ['PATH']}",
               "XDG_STATE_HOME": str(self.dir / ".state")}  # a scan keeps its calibration there
        for body in examples(path.read_text()):
            result = subprocess.run(["sh", "-e", "-c", body], cwd=self.dir, env=env, text=True,
                                    capture_output=True, stdin=subprocess.DEVNULL, timeout=900)
            self.assertEqual(result.returncode, 0,
                             f"{path.name}:\n{body}\n{result.stdout}\n{result.stderr}")


def add_document(path):
    name = "test_" + re.sub(r"\W", "_", str(path.relative_to(ROOT)))
    setattr(Documents, name, lambda self: self.run_document(path))


for document in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
    if document.exists() and examples(document.read_text()):
        add_document(document)


class Reader(harness.TestCase):
    def test_only_blocks_marked_sh_are_run(self):
        text = "```sh\na\n```\n```sh no-test\nb\n```\n```sh bare demo\ne\n```\n```console\nc\n```\n```\nd\n```\n"
        self.assertEqual(examples(text), ["a\n"])


if __name__ == "__main__":
    harness.main()
