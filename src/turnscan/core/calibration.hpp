#pragma once
// The result of a calibration: each figure with its standard deviation, and with a text that says
// how it was determined.

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <vector>

namespace turnscan {

/// How a calibration was made.
enum class CalibrationMethod { kPicked, kDetected, kMotion };
/// "picked points", "detected platter", "motion".
std::string_view name_of(CalibrationMethod method);

/// Correction of a depth camera's raw depth: depth = scale * (raw * unit) + bias.
struct DepthCorrection {
  double bias_m = 0.0;
  double scale = 1.0;
  double bias_sigma_m = std::numeric_limits<double>::quiet_NaN();
  double scale_sigma = std::numeric_limits<double>::quiet_NaN();
  std::string found;  ///< how
};

/// The calibration of a depth camera, which replaces what the recording says.
struct CameraCorrection {
  CameraIntrinsics intrinsics;
  std::optional<CameraIntrinsics> color_intrinsics;  ///< of colour that is not registered to depth
  Pose T_color_sensor = Pose::Identity();            ///< where color_intrinsics are
  std::string found;                                 ///< how
};

/// The pose of a sensor other than sensor 0.
struct SensorPlace {
  Pose T_table_sensor = Pose::Identity();  ///< with the platter at angle 0; table of sensor 0
  double heading_sigma_rad = std::numeric_limits<double>::quiet_NaN();  ///< about the axis
  double shift_sigma_m = std::numeric_limits<double>::quiet_NaN();      ///< in any direction
  std::string found;                                                    ///< how
  std::optional<DepthCorrection> depth;
  std::optional<CameraCorrection> camera;
};

/// A slip of the turntable during a recording.
struct TableSlip {
  std::size_t first_frame = 0;  ///< position of the first frame after it
  double turn_rad = 0.0;        ///< beyond its even rotation; sign as of the angles
};

/// The turntable in the frame of sensor 0. A standard deviation that is not known is NaN. The
/// texts `..._found` say how the figure was determined; empty: not known.
struct Calibration {
  CalibrationMethod method = CalibrationMethod::kDetected;
  std::string made_at;  ///< when its frames were taken, as utc_text(); empty: not known
  TurntableInfo table;
  double axis_sigma_rad = std::numeric_limits<double>::quiet_NaN();
  double center_sigma_m = std::numeric_limits<double>::quiet_NaN();  ///< across the axis
  double height_sigma_m = std::numeric_limits<double>::quiet_NaN();  ///< along the axis
  double radius_sigma_m = std::numeric_limits<double>::quiet_NaN();
  double speed_sigma_rad_s = std::numeric_limits<double>::quiet_NaN();
  std::string axis_found, center_found, height_found, radius_found, speed_found, angles_found;

  /// One per frame of the recording, in order; empty where only the place is known.
  std::vector<double> angles_rad;
  std::vector<double> angle_sigma_rad;
  std::vector<std::size_t> left_out;  ///< positions of frames whose angle was not found; not saved
  std::vector<TableSlip> slips;       ///< contained in the angles; not saved
  std::optional<double> start_s;      ///< when the table began to turn, in the frames' time

  double residual_rms_m = std::numeric_limits<double>::quiet_NaN();
  double residual_mean_abs_m = std::numeric_limits<double>::quiet_NaN();
  double rim_share = std::numeric_limits<double>::quiet_NaN();   ///< of the platter's rim seen
  double confidence = std::numeric_limits<double>::quiet_NaN();  ///< 0 to 1
  /// What the data did not determine, so that a prior was used: "speed", "angles", "axis".
  std::vector<std::string> undetermined;
  std::vector<std::string> notes;

  std::optional<DepthCorrection> depth;    ///< of sensor 0
  std::optional<CameraCorrection> camera;  ///< of sensor 0
  std::vector<SensorPlace> others;         ///< sensors 1, 2, ...; empty: nothing is known of them
};

/// Applies the calibration of depth and cameras to each sensor; that of a colour camera only where
/// the recording has unregistered colour of that size. Sensors that the calibration omits are
/// unchanged. Fails with kInvalidOption, and changes nothing, when images of a sensor differ in
/// size from its calibrated camera.
Result<> correct_sensors(const Calibration& calibration, std::vector<SensorInfo>& sensors);

/// The sequence with the calibration applied: its turntable, its angles in place of those of the
/// frames, its cameras and depth, the poses of its other sensors. What it leaves out is dropped.
/// Frames with poses of their own lose them, unless the calibration has neither angles nor speed.
/// `sequence` must outlive the result. Fails with kInvalidOption when the number of angles is not
/// that of the frames, when it knows more sensors than the sequence has, and as correct_sensors()
/// does.
Result<std::unique_ptr<FrameSequence>> with_calibration(const FrameSequence& sequence,
                                                        const Calibration& calibration);

}  // namespace turnscan
