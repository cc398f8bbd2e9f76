#pragma once
// What went wrong while a recording was made, and where its frames were seen from all the same.

#include <optional>
#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/detection/detect.hpp>
#include <vector>

namespace turnscan {

enum class DisturbanceKind {
  kCalibration,  ///< the sensor stands elsewhere than believed; only beside something else
  kSpeed,        ///< the table turned faster or slower than believed
  kSlip,         ///< the table slipped
  kHalt,         ///< the table slowed down or stopped for a while
  kObject,       ///< the object moved on the table
  kSensor,       ///< the sensor was knocked
  kWobble,       ///< the table's axis wobbles
  kHidden        ///< something came between sensor and object
};

struct Disturbance {
  DisturbanceKind kind = DisturbanceKind::kObject;
  std::size_t first_frame = 0;  ///< position of the first frame that it changed
  std::size_t last_frame = 0;   ///< and of the last: of a moved object the end of the recording
  double size_m = 0.0;          ///< by which it moved the object's points in the sensor's view
  std::string text;             ///< "the object moved by 6.0 mm at 15.3 s"
};

struct Placement {
  std::vector<Disturbance> disturbances;  ///< none: T_table_sensor is as it was believed
  std::vector<Pose> T_table_sensor;       ///< of each frame, as corrected
  std::vector<std::size_t> left_out;      ///< positions of frames that cannot be placed
};

/// Compares up to 72 frames of the first sensor with each other where they are believed to be, and
/// names what explains their differences clearly better than noise does. What the object's shape
/// does not determine stays as it was believed. nullopt where there is not one depth camera alone,
/// or several passes, fewer than 12 frames, or too little of an object to be seen. Fails with
/// kInvalidOption when the poses do not fit the frames, kCancelled, and what reading fails with.
Result<std::optional<Placement>> find_disturbances(const FrameSequence& sequence,
                                                   const std::vector<Pose>& T_table_sensor,
                                                   const RunContext& context,
                                                   PlatterMemory* memory = nullptr);

/// What a slip that the angles of a calibration follow did to its recording.
Disturbance disturbance_of(const TableSlip& slip, const Calibration& calibration,
                           const FrameSequence& recording);

}  // namespace turnscan
