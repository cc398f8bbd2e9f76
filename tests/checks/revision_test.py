"""apps/version/write_revision.cmake: the source that names tag and revision."""

import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "apps/version/write_revision.cmake"


class Revision(unittest.TestCase):
    def setUp(self):
        self.source = pathlib.Path(tempfile.mkdtemp(prefix="turnscan-revision-"))
        self.addCleanup(shutil.rmtree, self.source)
        self.out = self.source / "build" / "revision.cpp"
        (self.source / "file").write_text("one")
        (self.source / ".gitignore").write_text("build\n")

    def git(self, *args, folder=None):
        return subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e@example.org", *args],
                              cwd=folder or self.source, check=True, capture_output=True,
                              text=True).stdout.strip()

    def commit(self):
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "first")
        return self.git("rev-parse", "HEAD")[:8]

    def named(self, source=None):
        subprocess.run(["cmake", "-DGIT=git", f"-DSOURCE={source or self.source}",
                        f"-DOUT={self.out}", "-P", SCRIPT], check=True)
        return re.search(r'kRevision = "(.*)";', self.out.read_text())[1]

    def test_a_check_out_has_its_revision_and_a_tag_if_there_is_one(self):
        revision = self.commit()
        self.assertEqual(self.named(), revision)
        self.git("tag", "v1.2.3")
        self.assertEqual(self.named(), f"v1.2.3, {revision}")

    def test_files_that_differ_from_the_revision_are_said(self):
        revision = self.commit()
        (self.source / "file").write_text("two")
        self.assertEqual(self.named(), f"{revision}-dirty")

    def test_an_archive_has_none_even_inside_of_another_check_out(self):
        self.assertEqual(self.named(), "")
        archive = self.source / "turnscan-0.1.0"
        archive.mkdir()
        self.commit()
        self.assertEqual(self.named(archive), "")

    def test_the_source_is_left_alone_while_it_is_right(self):
        self.commit()
        self.named()
        before = self.out.stat().st_mtime_ns
        self.named()
        self.assertEqual(self.out.stat().st_mtime_ns, before)


if __name__ == "__main__":
    unittest.main()
