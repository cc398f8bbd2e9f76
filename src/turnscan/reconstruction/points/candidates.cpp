#include <span>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/points/candidates.hpp>

namespace turnscan::points {

namespace {

constexpr std::size_t kVoxelsAChunk = 4096;

/// Weighted sums of a voxel's cells.
struct VoxelSums {
  Vec3d place = Vec3d::Zero(), towards = Vec3d::Zero(), color = Vec3d::Zero();
  double count = 0.0;
};

VoxelSums sum_up(const voxels::MeasuredCells& m, const voxels::VoxelGrid::Voxel& voxel) {
  VoxelSums sums;
  for (std::uint32_t i = voxel.begin; i < voxel.end; ++i) {
    const double n = m.count(i);
    sums.place += n * m.point(i).cast<double>();
    sums.towards += n * m.towards_sensor(i).cast<double>();
    if (!m.colors.empty()) sums.color += n * Vec3d(m.colors[i].r, m.colors[i].g, m.colors[i].b);
    sums.count += n;
  }
  return sums;
}

Rgb rounded(const Vec3d& color) {
  const Vec3d c = color.array() + 0.5;
  return {std::uint8_t(c.x()), std::uint8_t(c.y()), std::uint8_t(c.z())};
}

Candidates candidates_of(const voxels::MeasuredCells& m, const voxels::VoxelGrid& grid,
                         std::size_t begin, std::size_t end) {
  Candidates out;
  for (std::size_t v = begin; v < end; ++v) {
    const voxels::VoxelGrid::Voxel& voxel = grid.voxels()[v];
    const VoxelSums sums = sum_up(m, voxel);
    const Vec3f centroid = (sums.place / sums.count).cast<float>();
    std::span<const Vec3f> points(&centroid, 1);
    if (!m.peaks.empty()) {
      const voxels::Peak& peak = m.peaks[std::size_t(m.grid.find(voxel.index))];
      points = std::span(m.peak_points).subspan(peak.begin, peak.end - peak.begin);
    }
    for (const Vec3f& p : points) {
      out.cloud.points.push_back(p);
      out.cloud.weights.push_back(float(voxel.count()) / float(points.size()));
      if (!m.colors.empty()) out.cloud.colors.push_back(rounded(sums.color / sums.count));
      out.towards_sensor.push_back((sums.towards / sums.count).cast<float>());
      out.voxel.push_back(static_cast<std::uint32_t>(v));
    }
  }
  return out;
}

template <class T>
void extend(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

Result<Candidates> find_candidates(const voxels::MeasuredCells& measurements,
                                   const voxels::VoxelGrid& grid, const RunContext& context) {
  const std::size_t n = grid.voxels().size();
  context.begin_phase("candidate points", n);
  auto parts = parallel_chunks<Candidates>(n, kVoxelsAChunk, [&](std::size_t b, std::size_t e) {
    if (context.cancelled()) return Candidates();
    Candidates part = candidates_of(measurements, grid, b, e);
    context.advance(e - b);
    return part;
  });
  TURNSCAN_TRY(context.check());
  Candidates out;
  for (const Candidates& part : parts) {
    extend(out.cloud.points, part.cloud.points);
    extend(out.cloud.weights, part.cloud.weights);
    extend(out.cloud.colors, part.cloud.colors);
    extend(out.towards_sensor, part.towards_sensor);
    extend(out.voxel, part.voxel);
  }
  return out;
}

}  // namespace turnscan::points
