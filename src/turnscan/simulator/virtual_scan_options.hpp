#pragma once
// Everything that a virtual scan is made from but the objects' meshes.

#include <cstdint>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/simulator/color/color_camera.hpp>
#include <turnscan/simulator/scene/hand.hpp>
#include <turnscan/simulator/scene/object_move.hpp>
#include <turnscan/simulator/scene/rig.hpp>
#include <turnscan/simulator/scene/room.hpp>
#include <turnscan/simulator/scene/turntable_motion.hpp>
#include <vector>

namespace turnscan {

struct VirtualScanner {
  ScannerModel model;
  ScannerPlacement placement;
};

struct PlatterOptions {
  bool visible = true;
  double radius_m = 0.15;
  double thickness_m = 0.0;  ///< 0: a disc
};

OptionTable describe(PlatterOptions& options);

struct MeasureOptions {
  std::string noise = "gaussian:1.5mm";  ///< see parse_noise_options
  double mixed_pixels = 0.0;             ///< share of the silhouette's pixels, 0 to 1
  double mixed_reach_m = 0.08;           ///< how far behind the edge they may lie
  int noise_window_px = 1;               ///< see NoiseOptions
  double edge_fattening_px = 0.0;        ///< see NoiseOptions
  double exposure_s = 0.0;               ///< of a frame, about its time; 0: an instant
  double wiggling_m =
      0.0;  ///< greatest error of a time-of-flight scanner by the phase of its light
  double wiggling_period_m = 0.75;  ///< in range; of four images at 50 MHz
  double warm_up_m = 0.0;           ///< how much too far a scanner measures when it is switched on
  double warm_up_time_s = 900.0;    ///< until a third (1/e) of it is left
  int seed = 1;
};

OptionTable describe(MeasureOptions& options);

enum class RecordedCalibration {
  kTrue,     ///< where the turntable is
  kNominal,  ///< where it was meant to be: without TablePlacement
  kNone      ///< neither turntable nor poses
};

/// What the recording says beside the frames.
struct RecordOptions {
  RecordedCalibration calibration = RecordedCalibration::kTrue;
  bool angles = true;
  bool color = false;  ///< a colour image with each depth image, registered to it
  int pass = 0;
};

OptionTable describe(RecordOptions& options);

struct VirtualScanOptions {
  std::vector<VirtualScanner> scanners;
  MotionOptions motion;
  PlatterOptions platter;
  TablePlacement table;
  RoomOptions room;
  ObjectMove object_move;
  HandOptions hand;
  MeasureOptions measure;
  RecordOptions record;
  ColorCameraOptions color_camera;
  std::uint32_t first_instant = 0;  ///< of the random numbers; see VirtualPasses
};

/// Fails with kInvalidOption when an option is out of range, or there are no or more than 64
/// scanners. Those of the motion and of the noise are left to those who use them.
Result<> check(const VirtualScanOptions& options);

/// The same when something is to happen only after the end of the recording, or the exposure is
/// longer than from frame to frame.
Result<> check_moments(const VirtualScanOptions& options, double end_s);

}  // namespace turnscan
