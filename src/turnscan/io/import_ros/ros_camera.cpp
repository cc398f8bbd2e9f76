#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/import_ros/ros_camera.hpp>

namespace turnscan::importers {

namespace {

using rosbag::CameraInfoMessage;

constexpr double kMaxMisfit_px = 0.3;
constexpr int kGrid = 24;  // image points per side to which a lens is fitted

using Coefficients = Eigen::Matrix<double, 5, 1>;  // k1 k2 p1 p2 k3
using Rows = Eigen::Matrix<double, 2, 5>;

/// Contribution of each coefficient to the point.
Rows terms_of(const Eigen::Vector2d& p) {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
  Rows rows;
  rows << x * r2, x * r2 * r2, 2 * x * y, r2 + 2 * x * x, x * r2 * r2 * r2,  //
      y * r2, y * r2 * r2, r2 + 2 * y * y, 2 * x * y, y * r2 * r2 * r2;
  return rows;
}

/// The lens that maps undistorted points back, by least squares.
Result<Coefficients> inverted(const Coefficients& inverse, const CameraIntrinsics& camera) {
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Coefficients right = Coefficients::Zero();
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pairs;  // undistorted, distorted
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= kGrid; ++j) {
      const Eigen::Vector2d seen((double(i) / kGrid * camera.width - camera.cx) / camera.fx,
                                 (double(j) / kGrid * camera.height - camera.cy) / camera.fy);
      const Eigen::Vector2d straight = seen + terms_of(seen) * inverse;
      const Rows rows = terms_of(straight);
      normal += rows.transpose() * rows;
      right += rows.transpose() * (seen - straight);
      pairs.emplace_back(straight, seen);
    }
  }
  const Coefficients fitted = normal.ldlt().solve(right);
  double misfit = 0.0;
  for (const auto& [straight, seen] : pairs) {
    const Eigen::Vector2d off = straight + terms_of(straight) * fitted - seen;
    misfit = std::max(misfit, std::hypot(off.x() * camera.fx, off.y() * camera.fy));
  }
  if (misfit <= kMaxMisfit_px) return fitted;
  return fail(ErrorCode::kUnsupported,
              "the lens (Inverse Brown Conrady) is {:.2f} pixels off the nearest one that turnscan "
              "has",
              misfit);
}

Result<> take_lens(const CameraInfoMessage& info, CameraIntrinsics& camera) {
  const bool straight =
      std::all_of(info.d.begin(), info.d.end(), [](double value) { return value == 0.0; });
  if (straight) return {};
  const std::string_view model = info.distortion_model;
  const auto& d = info.d;
  const std::size_t room = camera.distortion.size();
  const bool fits = d.size() <= room || std::all_of(d.begin() + std::ptrdiff_t(room), d.end(),
                                                    [](double value) { return value == 0.0; });
  const bool polynomial = model == "plumb_bob" || model == "rational_polynomial" ||
                          model == "Brown Conrady" || model.empty();
  if (polynomial && fits) {
    std::copy_n(d.begin(), std::min(d.size(), room), camera.distortion.begin());
    return {};
  }
  if (model != "Inverse Brown Conrady" || d.size() != 5)
    return fail(ErrorCode::kUnsupported, "the lens model '{}' with {} coefficients is not known",
                file::clean_name(model.substr(0, 60)), d.size());
  TURNSCAN_ASSIGN(const Coefficients lens,
                  inverted(Coefficients(Eigen::Map<const Coefficients>(d.data())), camera));
  std::copy_n(lens.data(), 5, camera.distortion.begin());
  return {};
}

}  // namespace

Result<CameraIntrinsics> ros_camera(const CameraInfoMessage& info, bool rectified) {
  CameraIntrinsics camera;
  camera.width = int(std::min<std::uint32_t>(info.width, 1U << 20));
  camera.height = int(std::min<std::uint32_t>(info.height, 1U << 20));
  const bool projection = rectified && info.p[0] > 0.0;
  camera.fx = projection ? info.p[0] : info.k[0];
  camera.fy = projection ? info.p[5] : info.k[4];
  camera.cx = projection ? info.p[2] : info.k[2];
  camera.cy = projection ? info.p[6] : info.k[5];
  TURNSCAN_TRY(camera.check());
  if (!projection) TURNSCAN_TRY(take_lens(info, camera));
  TURNSCAN_TRY(camera.check());
  return camera;
}

}  // namespace turnscan::importers
