#pragma once
// What a virtual scanner is: where its rays go, what it can see, and where its light comes from.
// Where it stands is a matter of the rig.

#include <optional>
#include <string>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/sensors/noise_model.hpp>

namespace turnscan {

enum class ScannerKind {
  kMatrix,  ///< a depth camera: a grid of samples
  kLine     ///< a profile scanner: samples along a line
};

enum class Sensing { kIdeal, kTimeOfFlight, kStructuredLight, kStereo, kLaserLine };

/// A sample's ray starts at the origin of the sensor frame (x right, y down, z forward); its depth
/// is along z. It counts only if near_m <= z <= far_m, the surface is turned towards the ray by no
/// more than max_incidence_rad, and the other eye sees the point, too.
///
/// The ray of a matrix scanner starts at its receiver, and its other eye is the emitter (for
/// stereo: the second camera). The rays of a line scanner lie in its sheet of light, the plane
/// x = 0 of the sensor frame, and start at the laser; its other eye is the receiver, the camera
/// that looks at the line from the side. Such a scanner's camera has width 1 and its samples run
/// along y; turning it about its viewing axis turns the line.
struct ScannerModel {
  std::string name;  ///< for people, e.g. "kinect-v2"
  ScannerKind kind = ScannerKind::kMatrix;
  Sensing sensing = Sensing::kIdeal;
  double near_m = 0.1;
  double far_m = 6.5;
  CameraIntrinsics camera;                        ///< with the distortion of its lens
  Vec3d emitter_m = Vec3d::Zero();                ///< sensor frame; the origin of a line scanner
  Vec3d receiver_m = Vec3d::Zero();               ///< sensor frame; the origin of a matrix scanner
  double max_incidence_rad = 1.4835298641951802;  ///< 85 deg, between ray and normal
  double depth_unit_m = 1e-4;                     ///< step of the depth images of a matrix scanner
  NoiseModel noise;                               ///< used where the scan asks for it

  /// The eye that the rays do not start from.
  const Vec3d& other_eye_m() const { return kind == ScannerKind::kLine ? receiver_m : emitter_m; }
  /// Whether the other eye is a place of its own, so that it may be blocked.
  bool two_eyed() const { return other_eye_m() != Vec3d::Zero(); }
  /// Fails with kInvalidOption, naming the scanner, unless all values are usable: near < far, at
  /// least one sample, a camera that CameraIntrinsics::check accepts and that is 1 wide for a line.
  Result<> check() const;
};

/// A scanner as data sheets, people and files describe it (thesis chapter 4). Either a field of
/// view with its aspect ratio, or focal lengths and a principal point.
struct ScannerParameters {
  std::string name = "custom";
  ScannerKind kind = ScannerKind::kMatrix;
  Sensing sensing = Sensing::kIdeal;
  double near_m = 0.1;
  double far_m = 6.5;
  int columns = 0;                       ///< samples across; a line scanner has none to choose
  int rows = 0;                          ///< samples from top to bottom, or along the line
  std::optional<double> fov_y_rad;       ///< from edge to edge of the image, or of the line
  std::optional<double> aspect;          ///< width to height of the view; auto: square samples
  std::optional<double> fx, fy, cx, cy;  ///< pixels; cx, cy auto: the middle
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;
  double k4 = 0.0, k5 = 0.0, k6 = 0.0;  ///< of the rational model, see core/lens.hpp
  double baseline_m = 0.0;              ///< from emitter to receiver
  double baseline_direction_rad = 0.0;  ///< from the rays' start to the other eye: see describe()
  double max_incidence_rad = 1.4835298641951802;
  double depth_unit_m = 1e-4;
  NoiseModel noise;
};

/// Without the noise, which has a table of its own.
OptionTable describe(ScannerParameters& parameters);

/// Fails with kInvalidOption, naming the field: both or neither of field of view and focal length,
/// no samples, near not below far, and as ScannerModel::check.
///
/// The samples are spread evenly over the image plane. The field of view spans them with half a
/// sample on each side, at every distance; so the number of samples across the view at the nearest
/// distance, which the thesis states, is the number of the image's samples.
Result<ScannerModel> scanner_model(const ScannerParameters& parameters);

}  // namespace turnscan
