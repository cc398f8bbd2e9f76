"""live_sensor.py URI MESH: integrates the frames of a sensor as they arrive. Without a device:
live_sensor.py 'virtual:letter-a?calibration=true&angles=1&frames=60' letter.ply"""

import sys

import turnscan

source = turnscan.Source(sys.argv[1])
sensor = source.sensors[0]
# The turntable must be known; for most devices it comes from a calibration.
stream = turnscan.Stream(source.turntable, sensor.depth_unit, sensor.pose)
for frame in source:
    if frame.dropped:
        continue
    stream.add(frame.depth, sensor.intrinsics, frame.angle, time=frame.time)
    if len(stream) % 20 == 0:
        print(f"{len(stream)} frames; the preview is a {stream.preview()}")
mesh = stream.finish()[0]
mesh.save(sys.argv[2])
print("Wrote", sys.argv[2], mesh)
