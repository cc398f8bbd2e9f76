#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <turnscan/io/image/depth_file.hpp>
#include <turnscan/io/import/importers_capture.hpp>

namespace turnscan::importers {

namespace {

constexpr double kStillPosition = 0.005;                        // metres
constexpr double kStillAngle = 0.5 * std::numbers::pi / 180.0;  // radians
constexpr double kGap = 1.6;                                    // relative to the median interval

double middle(std::vector<double> values) {
  const auto at = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The value that 19 of 20 do not exceed.
double nearly_largest(std::vector<double> values) {
  const auto at = values.begin() + std::ptrdiff_t((values.size() * 19 + 19) / 20 - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Median of each coordinate of the positions and of the quaternions (with consistent signs).
Pose median_of(const std::vector<Pose>& poses) {
  std::array<std::vector<double>, 7> columns;
  const Eigen::Quaterniond first(poses.front().linear());
  for (const Pose& pose : poses) {
    Eigen::Vector4d q = Eigen::Quaterniond(pose.linear()).coeffs();
    if (q.dot(first.coeffs()) < 0.0) q = -q;
    for (int i = 0; i < 3; ++i) columns[std::size_t(i)].push_back(pose.translation()[i]);
    for (int i = 0; i < 4; ++i) columns[std::size_t(i) + 3].push_back(q[i]);
  }
  Eigen::Quaterniond rotation(middle(columns[6]), middle(columns[3]), middle(columns[4]),
                              middle(columns[5]));
  Pose out = Pose::Identity();
  // The median of widely scattered rotations is nearly zero: any rotation will do.
  if (rotation.norm() > 1e-3) out.linear() = rotation.normalized().toRotationMatrix();
  for (int i = 0; i < 3; ++i) out.translation()[i] = middle(columns[std::size_t(i)]);
  return out;
}

struct Spread {
  double position_m = 0.0, angle_rad = 0.0;
  bool still() const { return position_m <= kStillPosition && angle_rad <= kStillAngle; }
};

/// Distance of 19 of 20 poses from the median.
Spread spread_of(const std::vector<Pose>& poses) {
  const Pose median = median_of(poses);
  std::vector<double> distances, angles;
  for (const Pose& pose : poses) {
    distances.push_back((pose.translation() - median.translation()).norm());
    angles.push_back(
        Eigen::AngleAxisd(Eigen::Matrix3d(median.linear().transpose() * pose.linear())).angle());
  }
  return {nearly_largest(std::move(distances)), nearly_largest(std::move(angles))};
}

std::string text_of(const Spread& spread) {
  return fmt::format("19 of 20 poses within {:.1f} mm and {:.2f} degrees of their median",
                     spread.position_m * 1e3, spread.angle_rad * 180.0 / std::numbers::pi);
}

/// Whether the poses are kept; notes the reason.
bool keeps_poses(DevicePoses wish, const std::vector<Pose>& known, SequenceHeader& header) {
  if (wish == DevicePoses::kIgnore) {
    add_note(header, "the poses of the device were ignored, as --device-poses says");
    return false;
  }
  if (wish == DevicePoses::kUse) {
    add_note(header, "frames are placed by the poses of the device, as --device-poses says");
    return true;
  }
  const Spread spread = spread_of(known);
  add_note(header,
           spread.still()
               ? fmt::format("the device stood still ({}): its poses were ignored, and the "
                             "turntable's motion places the frames; --device-poses use keeps them",
                             text_of(spread))
               : fmt::format("the device moved ({}): its poses place the frames; --device-poses "
                             "ignore leaves them out",
                             text_of(spread)));
  return !spread.still();
}

}  // namespace

Result<> settle_device_poses(const ImportOptions& options, std::vector<std::optional<Pose>>& poses,
                             SequenceHeader& header) {
  std::vector<Pose> known;
  for (const std::optional<Pose>& pose : poses) {
    if (pose) known.push_back(*pose);
  }
  if (known.empty()) {
    if (options.device_poses == DevicePoses::kUse)
      return fail(ErrorCode::kMissingData,
                  "there are no poses of the device; leave out --device-poses");
    return {};
  }
  const bool keep = keeps_poses(options.device_poses, known, header);
  for (std::optional<Pose>& pose : poses) {
    if (!keep) pose.reset();
    if (!pose) continue;
    TURNSCAN_ASSIGN(pose, placed_pose(*pose, options));
  }
  return {};
}

Pose from_gl_camera(const Pose& T_world_gl) {
  Pose flip = Pose::Identity();
  flip.linear().diagonal() = Vec3d(1.0, -1.0, -1.0);
  return T_world_gl * flip;
}

void mask_unsure(std::span<const std::uint8_t> confidence, std::uint8_t least, DepthImage& depth) {
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    if (confidence[i] < least) depth.pixels[i] = kNoReturn;
  }
}

std::uint8_t least_confidence(const ImportOptions& options) {
  switch (options.min_confidence) {
    case Confidence::kLow:
      return 0;
    case Confidence::kHigh:
      return 2;
    default:
      return 1;
  }
}

DepthImage depth_of_floats(std::string_view bytes, int width, int height) {
  static_assert(std::endian::native == std::endian::little);
  DepthImage depth(width, height, kNoReturn);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    float metres = 0.0f;
    std::memcpy(&metres, bytes.data() + 4 * i, 4);
    const double steps = double(metres) / kFloatDepthStep_m;
    // Also false for NaN.
    if (steps >= 0.5 && steps < 65534.5) depth.pixels[i] = std::uint16_t(steps + 0.5);
  }
  return depth;
}

CameraIntrinsics from_corner_coordinates(const CameraIntrinsics& camera, int width, int height) {
  const double x = double(width) / camera.width, y = double(height) / camera.height;
  CameraIntrinsics out = camera;
  out.width = width;
  out.height = height;
  out.fx *= x;
  out.fy *= y;
  out.cx = camera.cx * x - 0.5;
  out.cy = camera.cy * y - 0.5;
  return out;
}

bool times_from_first(std::vector<double>& times_s) {
  const bool increase = std::adjacent_find(times_s.begin(), times_s.end(), [](double a, double b) {
                          return !(b > a && b - a < 1e9);
                        }) == times_s.end();
  if (times_s.empty() || !increase || !std::isfinite(times_s.front())) return false;
  const double first = times_s.front();
  for (double& time : times_s) time -= first;
  return true;
}

std::vector<std::uint32_t> missing_before(std::span<const double> times_s) {
  std::vector<std::uint32_t> missing(times_s.size(), 0);
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times_s.size(); ++i) intervals.push_back(times_s[i] - times_s[i - 1]);
  if (intervals.size() < 3) return missing;
  const double median = middle(intervals);
  double all = 0.0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (!(intervals[i] > kGap * median) || !(median > 0.0)) continue;
    const double count = std::round(intervals[i] / median) - 1.0;
    all += count;
    // Treated as a pause rather than as dropped frames.
    if (!(all <= double(times_s.size()))) return std::vector<std::uint32_t>(times_s.size(), 0);
    missing[i + 1] = std::uint32_t(count);
  }
  return missing;
}

}  // namespace turnscan::importers
