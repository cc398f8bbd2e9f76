"""Trees made of a few files, for the tests of the rules."""

import os
import tempfile
import unittest

from tree import Tree


def found(rule, files):
    """What a rule finds in a tree of these files (path -> text)."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            full = os.path.join(root, path)
            os.makedirs(os.path.dirname(full), exist_ok=True)
            with open(full, "w", encoding="utf-8") as file:
                file.write(text)
        return [(path, number) for path, number, _ in rule(Tree(root, list(files)))]


class RuleTest(unittest.TestCase):
    def quiet(self, rule, path, text, files=None):
        self.assertEqual(found(rule, {path: text, **(files or {})}), [])

    def speaks(self, rule, path, text, line=1, files=None):
        self.assertIn((path, line), found(rule, {path: text, **(files or {})}))
