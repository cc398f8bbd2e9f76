#pragma once
// Options of a virtual scan, without the objects' meshes.

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
  double mixed_reach_m = 0.08;           ///< maximum distance behind the edge
  int noise_window_px = 1;               ///< see NoiseOptions
  double edge_fattening_px = 0.0;        ///< see NoiseOptions
  double exposure_s = 0.0;  ///< duration of a frame's exposure, centred at its time; 0: an instant
  double wiggling_m =
      0.0;  ///< maximum error of a time-of-flight scanner due to the phase of its light
  double wiggling_period_m = 0.75;  ///< in range; for four images at 50 MHz
  double warm_up_m = 0.0;           ///< depth offset of a scanner when it is switched on
  double warm_up_time_s = 900.0;    ///< until it has decayed to 1/e
  int seed = 1;
};

OptionTable describe(MeasureOptions& options);

enum class RecordedCalibration {
  kTrue,     ///< the turntable's true pose
  kNominal,  ///< its nominal pose: without TablePlacement
  kNone      ///< neither turntable nor poses
};

/// What the recording contains besides the frames.
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
  std::uint32_t first_instant = 0;  ///< for the random numbers; see VirtualPasses
};

/// Fails with kInvalidOption if an option is out of range, or there are no or more than 64
/// scanners. Options of the motion and of the noise are checked by their users.
Result<> check(const VirtualScanOptions& options);

/// The same if an event is after the end of the recording, or the exposure is longer than the frame
/// interval.
Result<> check_moments(const VirtualScanOptions& options, double end_s);

}  // namespace turnscan
