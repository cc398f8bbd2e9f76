#!/usr/bin/env python3
"""What a new user asks is answered by the site's own search: the right page is among the first two hits.

    site_search_test.py SITE [NODE]    a site that scripts/docs has built; Node.js runs its search
"""

import json
import subprocess
import sys

# Words as people type them, and the pages that answer. One of them must be among the first two.
QUESTIONS = {
    "why is my base flat": ["how-to/underside", "faq"],
    "how accurate is my scan": ["how-to/accuracy"],
    "can I use my iPhone": ["tutorials/phone", "faq"],
    "what does amber mean": ["how-to/bad-scan", "reference/report", "faq"],
    "how do I print it": ["how-to/print"],
    "my turntable has no encoder": ["how-to/calibrate", "tutorials/kinect", "faq"],
    "shiny object": ["how-to/bad-scan", "faq"],
    "mesh is too small in the slicer": ["how-to/print", "faq"],
    "which sensor should I buy": ["faq", "reference/devices", "reference/accuracy"],
    "kinect not found": ["how-to/connect-a-sensor", "tutorials/kinect"],
    "depth images from my own camera": ["how-to/import", "tutorials/bear", "how-to/own-driver"],
    "holes in the mesh": ["how-to/bad-scan", "how-to/finish", "reference/stages/finish"],
    "scan both sides": ["how-to/underside", "tutorials/cup"],
    "program crashed while recording": ["how-to/repair", "faq"],
    "object is smeared and doubled": ["how-to/bad-scan"],
    "use it without a calibration board": ["faq", "how-to/calibrate"],
}

# The page's own script on a page without a window: it only has to find the box that it would fill.
RUN = """
const box = {addEventListener() {}, value: ''};
globalThis.window = globalThis;
globalThis.location = {search: ''};
globalThis.document = {getElementById: () => box};
console.log = () => {};
const script = require('fs').readFileSync(process.argv[1], 'utf8');
const search = new Function('exports', script + '; return search;')()  // as a browser has none;
const hits = JSON.parse(process.argv[2]).map(q => search(q).slice(0, 5).map(hit => hit.location));
process.stdout.write(JSON.stringify(hits));
"""


def main(site, node="node"):
    asked = subprocess.run([node, "-e", RUN, f"{site}/search/main.js", json.dumps(list(QUESTIONS))],
                           capture_output=True, text=True)
    if asked.returncode != 0:
        sys.exit(f"the search does not run: {asked.stderr}")
    missed = 0
    for (question, pages), hits in zip(QUESTIONS.items(), json.loads(asked.stdout)):
        answers = {f"docs/{page}.html" for page in pages}
        if not answers & {hit.split("#")[0] for hit in hits[:2]}:
            missed += 1
            print(f"'{question}' finds {', '.join(hits) or 'nothing'}; it should find {' or '.join(pages)}")
    return missed


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
