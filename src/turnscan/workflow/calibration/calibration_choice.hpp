#pragma once
// Which calibration a reconstruction uses.

#include <memory>
#include <optional>
#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/turntable/checks/axis_offset.hpp>
#include <turnscan/turntable/checks/closure.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <vector>

namespace turnscan {

/// What speaks for and against a calibration; nullopt: it was not measured, or cannot be.
struct CalibrationChecks {
  std::optional<ClosureError> closure;
  std::optional<AxisOffset> axis_offset;  ///< only where the closure is good

  /// How far a point 0.1 m from the axis lies from where the calibration has it, by the worse of
  /// the two; 0 where neither was measured.
  double misfit_m() const;
};

struct CalibrationChoice {
  std::optional<Calibration> calibration;  ///< nullopt: the recording's own
  std::vector<Pose> poses;            ///< T_table_sensor put right after a disturbance; else empty
  std::vector<std::size_t> left_out;  ///< positions of frames that cannot be placed
  std::string note;                   ///< one sentence for people; empty: nothing to say
  std::vector<Disturbance> disturbances;  ///< that were found, put right or not
  CalibrationChecks checks;               ///< of the recording's calibration, if it was checked
};

struct CalibrationRequest {
  /// "recorded" keeps the recording's calibration; "motion" makes one from the object's motion;
  /// "auto" does that where the recording has none, or one whose closure error or axis offset is
  /// bad (turntable/checks/closure.hpp, axis_offset.hpp). Both then move the frames to where they
  /// belong after a disturbance (turntable/placement/find_disturbances.hpp); "recorded" only says
  /// that there was one.
  std::string mode = "auto";
  std::optional<double> speed_rad_s;  ///< that somebody stated; a doubt about it is a note
  bool table_given = false;           ///< by somebody, for this recording; a doubt is a note
};

/// Fails with kInvalidOption for another mode, with kMissingData when there is no calibration and
/// none can be made, with kCancelled, and as the sequence's frames do. That "auto" finds nothing
/// better is no failure, but the note says it.
Result<CalibrationChoice> choose_calibration(const FrameSequence& sequence,
                                             const CalibrationRequest& request,
                                             const RunContext& context);

/// The sequence as the choice places its frames; it must outlive the result. Fails as
/// with_calibration().
Result<std::unique_ptr<FrameSequence>> with_choice(const FrameSequence& sequence,
                                                   const CalibrationChoice& choice);

}  // namespace turnscan
