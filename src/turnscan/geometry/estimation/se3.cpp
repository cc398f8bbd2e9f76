#include <turnscan/geometry/estimation/se3.hpp>

namespace turnscan::estimation {

Eigen::Matrix3d exp_so3(const Vec3d& turn) {
  const double angle = turn.norm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Pose exp_about(const Vec3d& center, const Twist& twist, double lever) {
  Pose out = Pose::Identity();
  out.linear() = exp_so3(twist.head<3>() / lever);
  out.translation() = center + twist.tail<3>() - out.linear() * center;
  return out;
}

Twist log_about(const Vec3d& center, const Pose& motion, double lever) {
  const Eigen::AngleAxisd turn(motion.linear());
  Twist out;
  out.head<3>() = lever * turn.angle() * turn.axis();
  out.tail<3>() = motion * center - center;
  return out;
}

Pose orthonormalised(Pose pose) {
  pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return pose;
}

}  // namespace turnscan::estimation
