#include <turnscan/reconstruction/voxels/merge.hpp>

namespace turnscan::voxels {

Vec3f MergedCloud::towards_sensor(std::size_t i) const {
  // In single precision, which is that of the points: called for every point by several stages.
  const Viewpoint& viewpoint = viewpoints[cloud.frame[i]];
  const Vec3f value = viewpoint.value.cast<float>();
  if (viewpoint.parallel) return value;
  const Vec3f d = value - cloud.points[i];
  const float squared = d.squaredNorm();
  return squared > 0.0f ? Vec3f(d * (1.0f / std::sqrt(squared))) : Vec3f::Zero();
}

Result<FramePart> process_frame(const Frame& frame, const FrameRecipe& recipe,
                                const Pose& T_table_sensor) {
  const std::size_t sensor = frame.info.sensor;
  TURNSCAN_ASSIGN(FramePoints points,
                  points_of(frame, recipe.header->sensors.at(sensor), recipe.rays.at(sensor)));
  FramePart part;
  part.returns = points.cloud.size();
  if (recipe.cylinder) points = crop(points, SensorCrop(*recipe.cylinder, T_table_sensor));
  if (recipe.share)
    points = kept_points(points, [&](const Vec3f& p) {
      return recipe.share->contains((T_table_sensor * p.cast<double>()).cast<float>());
    });
  part.inside_crop = points.cloud.size();
  std::vector<std::uint8_t> keep(points.cloud.size(), 1);
  if (recipe.outliers.enabled && !keep.empty()) {
    TURNSCAN_ASSIGN(keep, outliers::statistical_outlier_mask(points.cloud.points, recipe.outliers));
  }
  const Pose T = recipe.T_object_table ? *recipe.T_object_table * T_table_sensor : T_table_sensor;
  const Eigen::Matrix3f rotation = T.linear().cast<float>();
  const Vec3f translation = T.translation().cast<float>();
  const bool colored = !points.cloud.colors.empty();
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    part.cloud.points.push_back(rotation * points.cloud.points[i] + translation);
    if (colored) part.cloud.colors.push_back(points.cloud.colors[i]);
  }
  return part;
}

void append(const FramePart& part, const Viewpoint& viewpoint, MergedCloud& merged) {
  const PointCloud& in = part.cloud;
  PointCloud& out = merged.cloud;
  const bool colored =
      out.colors.size() == out.points.size() && in.colors.size() == in.points.size();
  if (colored)
    out.colors.insert(out.colors.end(), in.colors.begin(), in.colors.end());
  else
    out.colors.clear();
  out.points.insert(out.points.end(), in.points.begin(), in.points.end());
  out.frame.insert(out.frame.end(), in.points.size(), std::uint32_t(merged.viewpoints.size()));
  merged.viewpoints.push_back(viewpoint);
  merged.returns += part.returns;
  merged.inside_crop += part.inside_crop;
  merged.kept += in.points.size();
  ++merged.frames;
}

}  // namespace turnscan::voxels
