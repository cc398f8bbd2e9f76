#pragma once
// Chooses the calibration for a reconstruction.

#include <memory>
#include <optional>
#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/checks/axis_offset.hpp>
#include <turnscan/turntable/checks/closure.hpp>
#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <vector>

namespace turnscan {

/// Evidence for and against a calibration; nullopt: not measured, or cannot be measured.
struct CalibrationChecks {
  std::optional<ClosureError> closure;
  std::optional<AxisOffset> axis_offset;  ///< only if the closure is good

  /// Displacement of a point 0.1 m from the axis due to the error of the calibration, by the larger
  /// of the two checks; 0 if neither was measured.
  double misfit_m() const;
};

struct CalibrationChoice {
  std::optional<Calibration> calibration;  ///< nullopt: use the recording's own
  std::vector<Pose> poses;            ///< T_table_sensor corrected after a disturbance; else empty
  std::vector<std::size_t> left_out;  ///< positions of frames that cannot be placed
  bool may_be_mirrored = false;  ///< depth images whose object turns against the recorded angles
  std::string note;              ///< one sentence for the user; empty: nothing to report
  std::vector<Disturbance> disturbances;   ///< all that were found, corrected or not
  CalibrationChecks checks;                ///< of the recording's calibration, if it was checked
  std::optional<DetectedPlatter> platter;  ///< that a check saw in frames of the whole recording
};

struct CalibrationRequest {
  /// "recorded" keeps the recording's calibration; "motion" estimates one from the object's motion;
  /// "auto" does so if the recording has none, or if its closure error or axis offset is bad
  /// (turntable/checks/closure.hpp, axis_offset.hpp). Both then correct the poses of frames after a
  /// disturbance (turntable/placement/find_disturbances.hpp); "recorded" only reports the
  /// disturbance.
  std::string mode = "auto";
  std::optional<double> speed_rad_s;  ///< stated by the user; doubts about it become a note
  bool table_given = false;  ///< stated by the user for this recording; doubts become a note
};

/// Fails with kInvalidOption for another mode, with kMissingData if there is no calibration and
/// none can be estimated, with kCancelled, and as the sequence's frames do. If "auto" finds nothing
/// better, that is not a failure but is mentioned in the note.
Result<CalibrationChoice> choose_calibration(const FrameSequence& sequence,
                                             const CalibrationRequest& request,
                                             const RunContext& context);

/// The sequence with frames posed according to the choice; the argument must outlive the result.
/// Fails as with_calibration().
Result<std::unique_ptr<FrameSequence>> with_choice(const FrameSequence& sequence,
                                                   const CalibrationChoice& choice);

}  // namespace turnscan
