"""evaluate.py MESH REFERENCE: how far a mesh is from its reference, after a rigid alignment."""

import sys

import turnscan

mesh, reference = (turnscan.Mesh.load(path) for path in sys.argv[1:3])
figures = turnscan.evaluate(mesh, reference, align="icp", thresholds="0.5mm,1mm,2mm")
for name in ("accuracy", "completeness"):
    print(f"{name:<13} median {figures[name]['median_m'] * 1e3:.3f} mm, "
          f"95 % within {figures[name]['p95_m'] * 1e3:.3f} mm")
for score in figures["scores"]:
    print(f"at {score['threshold_m'] * 1e3:.1f} mm: precision {score['precision']:.3f}, "
          f"recall {score['recall']:.3f}, F {score['f']:.3f}")
