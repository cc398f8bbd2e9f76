#pragma once
// A frame in the form that the volumetric method uses: the window of a depth image that contains
// the object, with the depth that each pixel measured and the free space that it certainly
// observed.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/lens.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::views {

/// Depth of a window of an image, packed in one word per pixel, with an empty border of one pixel.
/// p_view = rotation * p_table + translation; z forward. The image point of p_view is (fx x/z + cx,
/// fy y/z + cy) in window pixels, after lens distortion; for parallel rays there is no division by
/// z and fx, fy are pixels per metre.
struct DepthView {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Vec3f translation = Vec3f::Zero();
  float fx = 1.0f, fy = 1.0f, cx = 0.0f, cy = 0.0f;
  BrownConrady<float> lens{};  ///< as CameraIntrinsics::lens()
  bool distorted = false;
  bool parallel = false;
  float unit_m = 1e-4f, bias_m = 0.0f;  ///< depth = raw * unit + bias
  int width = 0, height = 0;            ///< with the border
  /// Bits 0 to 15: raw depth, 0 if nothing was measured. Bits 17 to 31: half the raw depth up to
  /// which the pixel and its neighbours observed free space, 0 if that is not known. Bit 16: on a
  /// depth edge, hence possibly a mixture of both sides.
  std::vector<std::uint32_t> pixels;
  std::uint16_t nearest = 0;  ///< of the raw depths; 0 if it is not known
  std::vector<Rgb> colors;    ///< per pixel, black if there is none; or empty
  std::uint32_t returns = 0;  ///< of the whole frame
  std::uint32_t kept = 0;     ///< of these, those inside the crop

  static constexpr std::uint32_t kEdge = 1u << 16;
  static std::uint32_t pack(std::uint32_t raw, bool edge, std::uint32_t free) {
    return raw | (edge ? kEdge : 0u) | (free >> 1 << 17);
  }
  bool empty() const { return pixels.empty(); }
  /// Image point, in window pixels, of a point in front of the view, in its frame.
  Eigen::Vector2f project(const Vec3f& p_view) const {
    const float z = parallel ? 1.0f : p_view.z();
    float x = p_view.x() / z, y = p_view.y() / z;
    if (distorted) distort_any(lens, x, y);
    return {x * fx + cx, y * fy + cy};
  }
  /// Position in `pixels` of the pixel that sees a point of the view's frame; -1 if there is none.
  std::ptrdiff_t pixel_at(const Vec3f& p_view) const {
    if (!parallel && !(p_view.z() > 0.0f)) return -1;
    const Eigen::Vector2f image = project(p_view);
    const float u = image.x() + 0.5f, v = image.y() + 0.5f;
    if (!(u >= 0.0f && v >= 0.0f && u < float(width) && v < float(height))) return -1;
    return std::ptrdiff_t(int(v)) * width + int(u);
  }
  /// Position of the sensor, or direction towards it, in the table frame.
  Viewpoint viewpoint() const;
};

/// Number of evenly spread views to use for statistics: at most `most`, limited so that their
/// windows have at most 4 million pixels in total, but at least four if there are as many.
std::size_t views_for_statistics(std::span<const DepthView> views, std::size_t most);

/// Parameters of the conversion of a frame to a view.
struct ViewScale {
  double edge_step_m = 0.012;  ///< a neighbour farther away than this makes an edge
  double spacing_m = 0.001;    ///< of the points of one frame; the pixel of resampled scans
  bool colored = false;        ///< views carry colours where frames have any
  /// Points that keep() does not accept are no measurements in depth images, either; they still
  /// limit the free space.
  bool only_kept = false;
  /// For depth images. Sensor frame: where x * p.x + y * p.y + z * p.z + w < 0, a pixel that is
  /// only known to be empty within a crop has not observed anything.
  std::optional<Eigen::Vector4f> seen_above = std::nullopt;
};

/// The window around the pixels whose point keep() accepts (sensor frame). T_table_sensor is the
/// frame's own. Range scans are resampled to an image from their viewpoint: the triangles between
/// neighbours in their grid, or only the points if there is no grid. An empty view if nothing is
/// accepted. rays must match the sensor. Fails as points_of does.
using KeepPoint = std::function<bool(const Vec3f& p_sensor)>;
Result<DepthView> make_view(const Frame& frame, const SensorInfo& sensor, const RayTable& rays,
                            const Pose& T_table_sensor, const ViewScale& scale,
                            const KeepPoint& keep);

}  // namespace turnscan::views
