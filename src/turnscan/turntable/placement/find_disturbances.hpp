#pragma once
// Detects what disturbed a recording, and corrects the poses of its frames.

#include <optional>
#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>
#include <vector>

namespace turnscan {

enum class DisturbanceKind {
  kCalibration,  ///< the sensor's pose differs from the assumed one; only together with another
                 ///< kind
  kSpeed,        ///< the table turned faster or slower than assumed
  kSlip,         ///< the table slipped
  kHalt,         ///< the table slowed down or stopped for a while
  kObject,       ///< the object moved on the table
  kSensor,       ///< the sensor was knocked
  kWobble,       ///< the table's axis wobbles
  kHidden        ///< something came between sensor and object
};

struct Disturbance {
  DisturbanceKind kind = DisturbanceKind::kObject;
  std::size_t first_frame = 0;  ///< position of the first frame affected
  std::size_t last_frame = 0;   ///< position of the last; the end of the recording if the object
                                ///< moved
  double size_m = 0.0;          ///< displacement of the object's points in the sensor's view
  std::string text;             ///< "the object moved by 6.0 mm at 15.3 s"
};

struct Placement {
  std::vector<Disturbance> disturbances;  ///< none: T_table_sensor is the assumed one
  std::vector<Pose> T_table_sensor;       ///< of each frame, as corrected
  std::vector<std::size_t> left_out;      ///< positions of frames without a usable pose
};

/// Compares up to 72 frames of the first sensor with each other at their assumed poses, and names
/// the disturbances that explain the differences clearly better than noise does. What the object's
/// shape does not determine keeps its assumed value. nullopt if there is not exactly one depth
/// camera, if there are several passes, fewer than 12 frames, or too little of an object is
/// visible. Fails with kInvalidOption if the poses do not match the frames, with kCancelled, and
/// with the errors of reading.
Result<std::optional<Placement>> find_disturbances(const FrameSequence& sequence,
                                                   const std::vector<Pose>& T_table_sensor,
                                                   const RunContext& context,
                                                   PlatterMemory* memory = nullptr);

/// The effect on a recording of a slip that the angles of a calibration follow.
Disturbance disturbance_of(const TableSlip& slip, const Calibration& calibration,
                           const FrameSequence& recording);

}  // namespace turnscan
