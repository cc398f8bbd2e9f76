#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>

#include "bench/free_registration/free_registration.hpp"

namespace turnscan {

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr cloud_of(std::span<const Vec3f> points) {
  auto cloud = std::make_shared<Cloud>();
  for (const Vec3f& p : points) {
    if (p.allFinite()) cloud->emplace_back(p.x(), p.y(), p.z());
  }
  return cloud;
}

Result<Pose> align(pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>& registration,
                   const Cloud::Ptr& source, const Cloud::Ptr& target, const Pose& start,
                   double max_distance_m, int iterations) {
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.setMaxCorrespondenceDistance(max_distance_m);
  registration.setMaximumIterations(iterations);
  registration.setTransformationEpsilon(1e-10);
  Cloud moved;
  registration.align(moved, start.matrix().cast<float>());
  const Eigen::Matrix4f found = registration.getFinalTransformation();
  if (!registration.hasConverged() || !found.allFinite())
    return fail(ErrorCode::kLibrary, "free registration: not converged");
  Pose pose;
  pose.matrix() = found.cast<double>();
  pose.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return pose;
}

}  // namespace

Result<Pose> pairwise_icp(std::span<const Vec3f> source, std::span<const Vec3f> target,
                          const Pose& start, FreeMethod method, double max_distance_m,
                          int iterations) {
  const Cloud::Ptr from = cloud_of(source), to = cloud_of(target);
  if (from->size() < 20 || to->size() < 20)
    return fail(ErrorCode::kTooFewPoints, "free registration: {} and {} points; 20 are needed",
                from->size(), to->size());
  if (method == FreeMethod::kGicp) {
    pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
    return align(gicp, from, to, start, max_distance_m, iterations);
  }
  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  return align(icp, from, to, start, max_distance_m, iterations);
}

}  // namespace turnscan
