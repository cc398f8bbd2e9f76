#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/merge.hpp>

namespace turnscan {

namespace {

/// Frames in flight: enough to keep the cores busy, few enough to keep memory flat.
constexpr std::size_t kBatch = 64;

void append(const FramePart& part, std::uint32_t frame, MergedCloud& merged) {
  const PointCloud& in = part.cloud;
  PointCloud& out = merged.cloud;
  // Colours are kept for all points or for none.
  if (!in.colors.empty() && out.colors.size() == out.points.size())
    out.colors.insert(out.colors.end(), in.colors.begin(), in.colors.end());
  out.points.insert(out.points.end(), in.points.begin(), in.points.end());
  out.frame.insert(out.frame.end(), in.points.size(), frame);
  merged.returns += part.returns;
  merged.cropped += part.cropped;
  merged.kept += in.points.size();
}

}  // namespace

OptionTable describe(MergeOptions& o) {
  OptionTable table;
  table
      .number("speed", o.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
              "Angular speed of the platter, counter-clockwise from above positive; automatic: as "
              "recorded")
      .flag("cloud-outliers", o.cloud_outliers,
            "Run the statistical filter once more, on the merged cloud");
  return table;
}

Vec3f MergedCloud::towards_sensor(std::size_t i) const {
  return viewpoints[cloud.frame[i]].direction_from(cloud.points[i].cast<double>()).cast<float>();
}

FrameRecipe FrameRecipe::make(const SequenceHeader& header) {
  FrameRecipe recipe;
  recipe.header = &header;
  for (const SensorInfo& sensor : header.sensors) {
    recipe.rays.push_back(sensor.kind == SensorKind::kDepthCamera ? RayTable(sensor.intrinsics)
                                                                  : RayTable());
  }
  return recipe;
}

Result<FramePart> process_frame(const Frame& frame, const FrameRecipe& recipe,
                                const Pose& T_table_sensor) {
  const std::size_t sensor = frame.info.sensor;
  TURNSCAN_ASSIGN(FramePoints points,
                  points_of(frame, recipe.header->sensors.at(sensor), recipe.rays.at(sensor)));
  FramePart part;
  part.returns = points.cloud.size();
  if (recipe.cylinder) points = crop(points, SensorCrop(*recipe.cylinder, T_table_sensor));
  part.cropped = points.cloud.size();
  std::vector<std::uint8_t> keep(points.cloud.size(), 1);
  if (recipe.outliers.enabled && !keep.empty()) {
    TURNSCAN_ASSIGN(keep, statistical_outlier_mask(points, recipe.outliers));
  }
  const Eigen::Matrix3f rotation = T_table_sensor.linear().cast<float>();
  const Vec3f translation = T_table_sensor.translation().cast<float>();
  const bool colored = !points.cloud.colors.empty();
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    part.cloud.points.push_back(rotation * points.cloud.points[i] + translation);
    if (colored) part.cloud.colors.push_back(points.cloud.colors[i]);
  }
  return part;
}

Result<MergedCloud> merge_frames(const FrameSequence& sequence, const FrameRecipe& recipe,
                                 const std::vector<Pose>& T_table_sensor,
                                 const RunContext& context) {
  const auto& frames = sequence.frames();
  MergedCloud merged;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Viewpoint& own = sequence.header().sensors.at(frames[i].sensor).viewpoint;
    merged.viewpoints.push_back(own.transformed(T_table_sensor[i]));
  }
  context.begin_phase("read and filter frames", frames.size());
  for (std::size_t begin = 0; begin < frames.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, frames.size() - begin);
    std::vector<Result<FramePart>> parts(count);
    parallel_for(count, 1, [&](std::size_t b) {
      const std::size_t i = begin + b;
      if (frames[i].status == FrameStatus::kDropped || context.cancelled()) return;
      parts[b] = sequence.read(i).and_then(
          [&](const Frame& frame) { return process_frame(frame, recipe, T_table_sensor[i]); });
      context.advance();
    });
    TURNSCAN_TRY(context.check());
    for (std::size_t b = 0; b < count; ++b) {
      TURNSCAN_TRY(parts[b]);
      if (frames[begin + b].status == FrameStatus::kDropped) {
        ++merged.dropped_frames;
        continue;
      }
      append(*parts[b], static_cast<std::uint32_t>(begin + b), merged);
      ++merged.frames;
    }
  }
  if (merged.cloud.colors.size() != merged.cloud.size()) merged.cloud.colors.clear();
  return merged;
}

}  // namespace turnscan
