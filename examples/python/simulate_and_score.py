"""Scans a virtual object with two voxel sizes, and compares the meshes with the truth."""

import turnscan

simulated = turnscan.simulate("builtin:letter-a", scanners=["kinect-v2"], frames=60, height=0.2,
                              noise="gaussian:1mm")
for voxel_size in ("3mm", "6mm"):
    made = turnscan.reconstruct(simulated, voxel_size=voxel_size)
    figures = simulated.evaluate(made.meshes[0], thresholds="1mm")
    print(f"voxel size {voxel_size}: "
          f"median error {figures['accuracy']['median_m'] * 1e3:.2f} mm, "
          f"F at 1 mm {figures['scores'][0]['f']:.3f}")
