#include <Eigen/SVD>
#include <cmath>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/units.hpp>

namespace turnscan {

namespace {

Result<> check_translation(const Vec3d& translation_m) {
  if (translation_m.norm() <= kMaxDistance_m) return {};
  return fail(ErrorCode::kFormat,
              "pose lies {:.3g} m from its origin, and at most {:.0f} km are read",
              translation_m.norm(), kMaxDistance_m / 1000.0);
}

}  // namespace

Result<Pose> pose_from(const Vec3d& translation_m, double qx, double qy, double qz, double qw) {
  const Eigen::Quaterniond q(qw, qx, qy, qz);
  if (!translation_m.allFinite() || !q.coeffs().allFinite())
    return fail(ErrorCode::kFormat, "pose has a value that is not finite");
  TURNSCAN_TRY(check_translation(translation_m));
  if (!(q.norm() > 1e-6) || !std::isfinite(q.norm()))
    return fail(ErrorCode::kFormat, "pose has a quaternion of length {}", q.norm());
  Pose pose = Pose::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = translation_m;
  return pose;
}

Result<Pose> pose_from(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) return fail(ErrorCode::kFormat, "pose has a value that is not finite");
  TURNSCAN_TRY(check_translation(matrix.topRightCorner<3, 1>()));
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > 1e-6)
    return fail(ErrorCode::kFormat, "pose matrix: the last row is not 0 0 0 1");
  const Eigen::Matrix3d r = matrix.topLeftCorner<3, 3>();
  const double error = (r * r.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(error <= 1e-3) || r.determinant() < 0)
    return fail(ErrorCode::kFormat, "pose matrix: the upper left 3x3 block is not a rotation");
  Pose pose = Pose::Identity();
  pose.linear() = r;
  pose.translation() = matrix.topRightCorner<3, 1>();
  // A valid rotation is not changed at all: a pose that was written is read back identically.
  if (error < 1e-14) return pose;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  return pose;
}

Pose rotation_about_y(double angle_rad) {
  return Pose(Eigen::AngleAxisd(angle_rad, Vec3d::UnitY()));
}

}  // namespace turnscan
