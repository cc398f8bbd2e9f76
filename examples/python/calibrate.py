"""calibrate.py RECORDING FILE.json: finds the turntable from the motion of the object, and keeps it
for `turnscan reconstruct --turntable FILE.json`."""

import sys

import turnscan

calibration = turnscan.calibrate(sys.argv[1], way="motion")
table = calibration.turntable
print("axis   ", *(f"{value:7.4f}" for value in table.axis))
print("centre ", *(f"{value:7.4f}" for value in table.center),
      f"m, standard deviation {calibration.center_sigma * 1e3:.2f} mm across the axis")
if table.speed is not None:
    print(f"speed   {table.speed:7.4f} rad/s")
calibration.save(sys.argv[2])
print("Wrote", sys.argv[2])
