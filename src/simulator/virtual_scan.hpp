#pragma once
// An ideal pinhole depth camera that looks at objects on a turntable. To the rest of turnscan it is
// a recording like any other.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/simulator/scene.hpp>
#include <vector>

namespace turnscan {

enum class ScannerPreset {
  kKinectV2,  ///< 512 x 424, f = 365.5 px, centre (255.5, 211.5)
  kIdeal      ///< 640 x 640, f = 700 px, centre (319.5, 319.5)
};

CameraIntrinsics intrinsics_of(ScannerPreset preset);

struct VirtualScanOptions {
  ScannerPreset scanner = ScannerPreset::kKinectV2;
  /// Goes before the preset's. Not an option of the command line.
  std::optional<CameraIntrinsics> intrinsics;
  double distance_m = 0.9;                     ///< camera to the point it looks at
  double elevation_rad = 0.29670597283903605;  ///< 17 deg above the horizontal
  double aim_height_m = 0.09;                  ///< of the point on the axis that it looks at
  int frames = 920;
  double turns = 1.0;  ///< the frames are spread over these, the last turn's end left out
  double fps = 30.0;   ///< frames a second
  std::optional<double> speed_rad_s;     ///< goes before turns: angle = speed * index / fps
  std::string noise = "gaussian:1.5mm";  ///< see parse_noise
  double mixed_pixels = 0.5;             ///< share of the silhouette's pixels, 0 to 1
  double mixed_reach_m = 0.08;           ///< how far behind the edge they may lie
  int seed = 1;
  bool platter = true;
  double platter_radius_m = 0.15;
  bool color = false;  ///< also give each frame a colour image, registered to depth
};

OptionTable describe(VirtualScanOptions& options);

/// Depth noise: "none", or "gaussian:SIGMA" (normal, on the depth along z). Returns sigma in
/// metres; fails with kInvalidOption.
Result<double> parse_noise(std::string_view text);

/// A pixel that sees something, one of whose four neighbours sees nothing or something farther by
/// more than this, is a pixel of the silhouette. Two neighbours on the platter never are.
inline constexpr double kSilhouetteStep_m = 0.02;

/// Geometry: with the platter at angle 0 the camera is at distance and elevation from the aim
/// point (0, aim_height, 0), on the side of -Z, its x axis horizontal; this is the table frame that
/// the turntable's axis and centre give (thesis eq. 3.10: X = axis x centre in the sensor frame).
/// Frame i shows the objects turned by angle_i about +Y, so that
/// p_table = Ry(-angle_i) * T_table_sensor * p_sensor.
///
/// Depth is along z in steps of 0.1 mm, rounded, 0 where nothing is hit or depth is beyond 6.5534
/// m. Of the silhouette's pixels the share mixed_pixels, chosen at random, is moved backwards by
/// U(0, min(mixed_reach, step to the deepest of the four neighbours)); then noise is added to all.
/// Each value is a function of (seed, sensor, frame, pixel) alone.
class VirtualScan : public FrameSequence {
 public:
  /// objects: table frame, platter at angle 0. Fails with kInvalidOption when an option is out of
  /// range, and as Scene::create does.
  static Result<VirtualScan> create(std::vector<TriangleMesh> objects,
                                    const VirtualScanOptions& options);
  VirtualScan(VirtualScan&&) noexcept;
  VirtualScan& operator=(VirtualScan&&) noexcept;
  ~VirtualScan() override;

  const SequenceHeader& header() const override;
  /// With time, true angle, turn; sensor 0, pass 0.
  const std::vector<FrameInfo>& frames() const override;
  /// Rendered anew at each call (about a millisecond, on the calling thread).
  Result<Frame> read(std::size_t position) const override;

  /// The truth: the objects at angle 0.
  const std::vector<TriangleMesh>& objects() const;
  const Scene& scene() const;
  /// Ry(-angle) * T_table_sensor of a frame: takes its points to the table frame.
  Pose T_table_sensor(std::size_t position) const;

 private:
  struct Impl;
  explicit VirtualScan(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
