#!/usr/bin/env python3
"""Shows that each rule of manual.py is silent on a good sample and speaks on a bad one."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import manual  # noqa: E402  (needs the path above)
from sample import RuleTest, found  # noqa: E402


class Rules(RuleTest):
    def test_every_page_is_of_a_kind(self):
        for page in ("how-to/a", "tutorials/a", "explanation/a", "reference/stages/a", "research/a", "thesis/a", "faq"):
            self.quiet(manual.pages_of_no_kind, f"docs/{page}.md", "")
        for page in ("a", "notes/a", "how-to/more/a"):
            self.speaks(manual.pages_of_no_kind, f"docs/{page}.md", "")

    def test_pages_are_short_where_they_are_read(self):
        rule = manual.long_pages
        self.quiet(rule, "docs/how-to/a.md", "a\n" * 80)
        self.speaks(rule, "docs/how-to/a.md", "a\n" * 81, 81)
        self.quiet(rule, "docs/explanation/a.md", "a\n" * 150)
        self.speaks(rule, "docs/explanation/a.md", "a\n" * 151, 151)
        self.quiet(rule, "docs/tutorials/a.md", "a " * 1500)
        self.speaks(rule, "docs/tutorials/a.md", "a " * 1501)
        self.quiet(rule, "docs/reference/a.md", "a b c\n" * 9000)
        self.quiet(rule, "docs/research/a.md", "a b c\n" * 9000)

    def test_the_manual_is_short(self):
        rule, many = manual.long_pages, {f"docs/tutorials/{n}.md": "a\n" * 150 for n in range(23)}
        self.quiet(rule, "docs/faq.md", "a\n" * 50, files=many)
        self.assertIn(("docs", 1), found(rule, {"docs/faq.md": "a\n" * 51, **many}))

    def test_every_page_has_its_place_in_the_site(self):
        rule, site = manual.pages_outside_the_site, "nav:\n  - A: docs/faq.md\n"
        self.quiet(rule, "docs/faq.md", "", files={"mkdocs.yml": site})
        self.speaks(rule, "docs/index.md", "", files={"mkdocs.yml": site})
        self.speaks(rule, "mkdocs.yml", site, 2)

    def test_every_picture_is_shown(self):
        rule = manual.pictures_that_no_page_shows
        self.quiet(rule, "docs/images/a.png", "", files={"docs/how-to/a.md": "![a](../images/a.png)\n"})
        self.speaks(rule, "docs/images/a.png", "", files={"docs/how-to/a.md": "[a](../images/a.png)\n"})

    def test_pages_that_programs_quote_are_there(self):
        rule, page = manual.quoted_pages_that_are_not_there, {"docs/how-to/a.md": ""}
        self.quiet(rule, "apps/a.cpp", 'say("see docs/how-to/a.md");\n', files=page)
        self.speaks(rule, "src/a.cpp", '\nsay("see docs/how-to/b.md.");\n', 2, files=page)


if __name__ == "__main__":
    unittest.main()
