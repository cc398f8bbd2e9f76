#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>
#include <open3d/utility/Random.h>

#include <bench/pass_motion/open3d_motion.hpp>
#include <ctime>
#include <functional>

namespace turnscan::bench {

namespace {

namespace registration = open3d::pipelines::registration;
using Cloud = open3d::geometry::PointCloud;
using Result = registration::RegistrationResult;

constexpr double kVoxelShare = 0.025;
constexpr double kFineReach_m[] = {0.004, 0.002, 0.001};

Cloud cloud_of(const passes::PassSurface& surface) {
  Cloud out;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    out.points_.push_back(surface.points[i].cast<double>());
    out.normals_.push_back(surface.normals[i].cast<double>());
  }
  return out;
}

struct Prepared {
  Cloud all;
  std::shared_ptr<Cloud> thinned;
  std::shared_ptr<registration::Feature> features;

  Prepared(const passes::PassSurface& surface, double voxel_m) : all(cloud_of(surface)) {
    thinned = all.VoxelDownSample(voxel_m);
    features = registration::ComputeFPFHFeature(
        *thinned, open3d::geometry::KDTreeSearchParamHybrid(5.0 * voxel_m, 100));
  }
};

Result ransac(const Prepared& source, const Prepared& target, double voxel_m) {
  const double reach = 1.5 * voxel_m;
  const registration::CorrespondenceCheckerBasedOnEdgeLength edges(0.9);
  const registration::CorrespondenceCheckerBasedOnDistance distances(reach);
  return registration::RegistrationRANSACBasedOnFeatureMatching(
      *source.thinned, *target.thinned, *source.features, *target.features, true, reach,
      registration::TransformationEstimationPointToPoint(false), 3, {edges, distances},
      registration::RANSACConvergenceCriteria(100000, 0.999));
}

Result fast_global(const Prepared& source, const Prepared& target, double voxel_m) {
  registration::FastGlobalRegistrationOption option;
  option.use_absolute_scale_ = true;
  option.maximum_correspondence_distance_ = 0.5 * voxel_m;
  return registration::FastGlobalRegistrationBasedOnFeatureMatching(
      *source.thinned, *target.thinned, *source.features, *target.features, option);
}

OtherMotion refined(std::string name, const Prepared& source, const Prepared& target,
                    double voxel_m, const std::function<Result()>& find) {
  OtherMotion out;
  out.name = std::move(name);
  const std::clock_t start = std::clock();
  const registration::TransformationEstimationPointToPlane plane;
  Result result = find();
  result = registration::RegistrationICP(*source.thinned, *target.thinned, 0.4 * voxel_m,
                                         result.transformation_, plane);
  for (const double reach_m : kFineReach_m)
    result = registration::RegistrationICP(source.all, target.all, reach_m, result.transformation_,
                                           plane);
  out.T_first_pass.matrix() = result.transformation_;
  out.fitness = result.fitness_;
  out.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  return out;
}

}  // namespace

std::vector<OtherMotion> open3d_motions(const passes::PassSurface& first,
                                        const passes::PassSurface& pass) {
  open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  open3d::utility::random::Seed(7);
  const double voxel = kVoxelShare * bounds(first.points).size().maxCoeff();
  const Prepared target(first, voxel), source(pass, voxel);
  return {
      refined("ransac", source, target, voxel, [&] { return ransac(source, target, voxel); }),
      refined("fgr", source, target, voxel, [&] { return fast_global(source, target, voxel); })};
}

}  // namespace turnscan::bench
