"""Rules of the manual: its kinds of pages, how long they may be, and that each has a place in the site."""

import posixpath
import re

# Folder of a kind of pages and the most lines of a page; pages that are looked things up in may be longer.
KINDS = {"docs/tutorials": 150, "docs/how-to": 80, "docs/explanation": 150, "docs": 150,
         "docs/reference": None, "docs/reference/stages": None, "docs/research": None, "docs/thesis": None}
TOP_PAGES = {"docs/index.md", "docs/faq.md", "docs/glossary.md"}
MOST_WORDS = 1500
MOST_LINES_TOGETHER = 3500
SITE = "mkdocs.yml"
QUOTED = re.compile(r"\bdocs/[\w-]+/[\w/-]+\.md\b")
PICTURE = re.compile(r"!\[[^\]]*\]\(([^)\s]+)\)")


def pages(tree):
    return [path for path in tree.paths if path.startswith("docs/") and path.endswith(".md")]


def pages_of_no_kind(tree):
    for path in pages(tree):
        folder = posixpath.dirname(path)
        if folder not in KINDS or (folder == "docs" and path not in TOP_PAGES):
            yield path, 1, "is of no kind: a tutorial, how-to, reference, explanation or research"


def long_pages(tree):
    together = 0
    for path in pages(tree):
        most = KINDS.get(posixpath.dirname(path))
        if most is None:
            continue
        lines = tree.lines(path)
        together += len(lines)
        if len(lines) > most:
            yield path, most + 1, f"{len(lines)} lines; a page of this kind has at most {most}"
        if (words := sum(len(line.split()) for line in lines)) > MOST_WORDS:
            yield path, 1, f"{words} words; a page of this kind has at most {MOST_WORDS}"
    if together > MOST_LINES_TOGETHER:
        yield "docs", 1, f"{together} lines besides reference and research; at most {MOST_LINES_TOGETHER}"


def pages_outside_the_site(tree):
    if SITE not in tree.known:
        return
    listed = {}
    for number, line in enumerate(tree.lines(SITE), 1):
        if match := re.search(r"(?:: |- )(\S+\.md)$", line):
            listed[match.group(1)] = number
    for path in pages(tree):
        if path not in listed:
            yield path, 1, f"is not in {SITE}, so that nobody finds it in the site"
    for path in sorted(set(listed) - tree.known):
        yield SITE, listed[path], f"{path} is not there"


def pictures_that_no_page_shows(tree):
    shown = {posixpath.normpath(posixpath.join(posixpath.dirname(path), link))
             for path in tree.paths if path.endswith(".md")
             for line in tree.lines(path) for link in PICTURE.findall(line)}
    for path in tree.paths:
        if path.startswith("docs/images/") and path not in shown:
            yield path, 1, "no page shows it"


def quoted_pages_that_are_not_there(tree):
    """Texts of the programs name pages for more: help, errors, verdicts."""
    for path in tree.code("src/", "apps/", "plugins/"):
        for number, line in enumerate(tree.lines(path), 1):
            for page in QUOTED.findall(line):
                if page not in tree.known:
                    yield path, number, f"{page} is not there"


RULES = [pages_of_no_kind, long_pages, pages_outside_the_site, pictures_that_no_page_shows,
         quoted_pages_that_are_not_there]
