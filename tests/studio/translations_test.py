"""Translations of the desktop program keep the places of their texts, and how many are missing.

    translations_test.py SOURCE_FOLDER

A missing translation is no failure: the text is shown in English.
"""
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as tree


def places(text):
    """%1 and %n, line ends, tabs before a key, and the endings of file dialogs."""
    return sorted(re.findall(r"%(?:\d|n)|\n|\t|\*\.\w+", text))


def faults_of(file):
    faults = []
    for context in tree.parse(file).getroot().iter("context"):
        for message in context.iter("message"):
            translation = message.find("translation")
            if translation.get("type") == "unfinished":
                continue
            source = message.findtext("source")
            forms = [f.text or "" for f in translation.iter("numerusform")] or [translation.text or ""]
            for form in forms:
                if not form.strip() and source.strip():
                    faults.append(f"{source!r} has an empty translation")
                elif places(form) != places(source):
                    faults.append(f"{source!r} and {form!r} have other places for values")
                elif source.count("&") == 1 and form.count("&") != 1 and len(source) < 60:
                    faults.append(f"{form!r} has no key for {source!r}")
    return faults


def main():
    source = pathlib.Path(sys.argv[1])
    files = sorted((source / "apps/turnscan-studio/i18n").glob("studio_*.ts"))
    assert files, "there are no translations"
    faults = [f"{file.name}: {fault}" for file in files for fault in faults_of(file)]
    print("\n".join(faults))
    counted = subprocess.run([source / "scripts/translate", "--check"], capture_output=True, text=True)
    print(counted.stdout or counted.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
