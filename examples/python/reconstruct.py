"""reconstruct.py RECORDING MESH: what `turnscan reconstruct RECORDING -o MESH` does."""

import sys

import turnscan


def show(phase, fraction):
    print(f"\r{phase:<30} {fraction:4.0%}", end="", file=sys.stderr)


recording = turnscan.Recording(sys.argv[1])
for note in recording.notes:
    print("Note:", note)
made = turnscan.reconstruct(recording, progress=show)
print(file=sys.stderr)
for verdict, report in zip(made.verdicts, made.report["objects"]):
    mesh = report["mesh"]
    print(f"{verdict}: watertight {mesh['watertight']}, {mesh['volume_cm3']:.1f} cm3")
print("Wrote", *made.save(sys.argv[2], report=sys.argv[2] + ".json"))
