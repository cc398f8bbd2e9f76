#include "explorer/cloud_sequence.hpp"

#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::studio {

namespace {

/// Directions to the 26 neighbours of a cell.
std::vector<Viewpoint> directions() {
  std::vector<Viewpoint> out;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x != 0 || y != 0 || z != 0) out.push_back({Vec3d(x, y, z).normalized(), true});
  return out;
}

std::size_t side_of(const PointCloud& cloud, std::size_t i, const Vec3d& middle,
                    const std::vector<Viewpoint>& from) {
  const Vec3d outward = cloud.normals.empty() ? Vec3d(cloud.points[i].cast<double>() - middle)
                                              : Vec3d(cloud.normals[i].cast<double>());
  std::size_t best = 0;
  for (std::size_t d = 1; d < from.size(); ++d)
    if (outward.dot(from[d].value) > outward.dot(from[best].value)) best = d;
  return best;
}

void take(const PointCloud& from, std::size_t i, PointCloud& to) {
  to.points.push_back(from.points[i]);
  if (!from.colors.empty()) to.colors.push_back(from.colors[i]);
}

SequenceHeader scanners_at(const std::vector<Viewpoint>& viewpoints) {
  SequenceHeader header;
  for (const Viewpoint& viewpoint : viewpoints) {
    SensorInfo sensor;
    sensor.kind = SensorKind::kPointScanner;
    sensor.viewpoint = viewpoint;
    sensor.T_table_sensor = Pose::Identity();
    header.sensors.push_back(sensor);
  }
  return header;
}

}  // namespace

std::unique_ptr<FrameSequence> sequence_of(const PointCloud& cloud,
                                           const std::vector<Viewpoint>& viewpoints) {
  const bool known = !viewpoints.empty() && cloud.frame.size() == cloud.size();
  const std::vector<Viewpoint> from = known ? viewpoints : directions();
  std::vector<Frame> frames(from.size());
  const Vec3d middle = bounds(cloud.points).center();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::size_t f = known ? cloud.frame[i] : side_of(cloud, i, middle, from);
    if (f < frames.size()) take(cloud, i, frames[f].points);
  }
  for (std::size_t f = 0; f < frames.size(); ++f) {
    FrameInfo& info = frames[f].info;
    info.index = static_cast<std::uint32_t>(f);
    info.sensor = info.index;
    info.T_table_sensor = Pose::Identity();
    if (frames[f].points.empty()) info.status = FrameStatus::kDropped;
  }
  return std::make_unique<MemoryFrames>(scanners_at(from), std::move(frames));
}

}  // namespace turnscan::studio
