"""A device of your own: whatever gives depth images can be recorded. Here it sees a tilted plane.
(A driver that all of turnscan can use is a plug-in in C: cpp/plugin.cpp.)"""

import sys

import numpy as np
import turnscan


class TiltedPlane:
    intrinsics = turnscan.Intrinsics(320, 240, fx=300, fy=300, cx=159.5, cy=119.5)

    def frames(self, count):
        for number in range(count):
            rows = np.arange(240)[:, None]
            yield number / 30, np.broadcast_to(0.5 + 1e-4 * rows, (240, 320))  # seconds, metres


device = TiltedPlane()
frames = turnscan.Frames([turnscan.Sensor(device.intrinsics, model="tilted-plane")])
for time, depth in device.frames(10):
    frames.add(depth, time=time)
frames.save(sys.argv[1])
kept = turnscan.Recording(sys.argv[1])
print(len(kept), "frames in", kept.path, "by a", kept.sensors[0].model)
