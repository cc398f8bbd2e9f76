"""batch.py FOLDER RECORDING...: reconstructs each recording with two voxel sizes, several at a time.
A second run continues where the first was interrupted."""

import sys

import turnscan

result = turnscan.batch(sys.argv[2:], sys.argv[1], method="volumetric",
                        sweep={"voxel_size": ["4mm", "6mm"]}, engine={"jobs": 2})
print(f"{result['done']} of {result['tasks']} tasks done, {result['failed']} failed")
print("Wrote", *result["files"])
