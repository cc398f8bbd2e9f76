"""Depth images of your own, with an angle each. Here they show a ball with a radius of 40 mm on a
turntable, seen from 30 degrees above."""

import numpy as np
import turnscan

RADIUS, DISTANCE = 0.04, 0.5  # metres

camera = turnscan.Intrinsics(320, 240, fx=300, fy=300, cx=159.5, cy=119.5)
column, row = np.meshgrid(np.arange(320), np.arange(240))
a = ((column - camera.cx) / camera.fx) ** 2 + ((row - camera.cy) / camera.fy) ** 2 + 1
with np.errstate(invalid="ignore"):  # NaN, where a ray misses the ball, is no return
    depth = (DISTANCE - np.sqrt(DISTANCE**2 * (1 - a) + a * RADIUS**2)) / a

up = np.array([0, -np.sqrt(0.75), -0.5])  # sensor frame: y down, z forward
table = turnscan.Turntable(axis=up, center=np.array([0, 0, DISTANCE]) - RADIUS * up)
frames = turnscan.Frames([turnscan.Sensor(camera)], table)
for angle in np.linspace(0, 2 * np.pi, 36, endpoint=False):
    frames.add(depth, angle)

made = turnscan.reconstruct(frames, calibration="recorded")
share = made.report["objects"][0]["mesh"]["volume_cm3"] / (4e6 / 3 * np.pi * RADIUS**3)
print(made.meshes[0], f"with {share:.3f} of the ball's volume")
assert abs(share - 1) < 0.1  # the underside, which no image shows, is closed flat
