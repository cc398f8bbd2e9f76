#pragma once
// The crop at the rate of the frames (thesis algorithm 2): from a raw depth image to the points in
// the cylinder; pixels outside it cost two comparisons.

#include <cstdint>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <vector>

namespace turnscan {

/// How far the live cylinder keeps away from the turntable.
struct LiveCropOptions {
  double margin_m = 0.006;  ///< above the platter
  double inset_m = 0.005;   ///< inside the platter's rim
  double height_m = 0.6;    ///< of the cylinder
};
/// Fields live-margin, live-inset, live-height.
OptionTable describe(LiveCropOptions& options);

/// The cylinder above a platter. Fails with kInvalidOption, and with kMissingData when the table
/// has no radius or the inset leaves nothing of it.
Result<Cylinder> live_cylinder(const TurntableInfo& table, const LiveCropOptions& options);

/// A cylinder is convex: of each pixel, the depths inside it are one interval of raw values. They
/// are found once; then a frame costs two comparisons a pixel. Keeps the same pixels as crop() of
/// points_of(), and gives the same points.
///
/// Immutable; its members may be called from several threads at once.
class LiveCrop {
 public:
  /// Fails with kUnsupported when the sensor gives points, kFormat when its intrinsics are not
  /// usable. Takes about 20 ms for 512 x 424 pixels, on all cores.
  static Result<LiveCrop> create(const SensorInfo& sensor, const Pose& T_table_sensor,
                                 const Cylinder& cylinder);

  /// As crop(points_of(frame, ...), SensorCrop(...)), sensor frame, without colours where color is
  /// empty. Fails with kFormat when the image is not of the sensor's size; a colour image of
  /// another size than the depth is left out.
  Result<FramePoints> points(const DepthImage& depth, const ColorImage& color = {}) const;

  /// The image with everything outside the cylinder marked kOutsideCrop; pixels without a return
  /// stay so. Fails as points().
  Result<DepthImage> image(const DepthImage& depth) const;

  /// The raw values that a pixel keeps: first to first + count - 1. For tests.
  struct Interval {
    std::uint16_t first = 0, count = 0;
  };
  Interval interval(int column, int row) const;

 private:
  LiveCrop() = default;
  Result<> check(const DepthImage& depth) const;
  template <class Take>
  void for_kept(const DepthImage& depth, const Take& take) const;

  SensorInfo sensor_;
  RayTable rays_;
  std::vector<std::uint16_t> first_, count_;  ///< to a multiple of 64 pixels
};

}  // namespace turnscan
