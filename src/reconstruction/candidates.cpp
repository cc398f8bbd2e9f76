#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/candidates.hpp>
#include <turnscan/reconstruction/sub_voxel_line.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kVoxelsAChunk = 4096;

Vec3f mean_direction(const MergedCloud& merged, const VoxelGrid& grid,
                     const VoxelGrid::Voxel& voxel) {
  Vec3d sum = Vec3d::Zero();
  merged.for_each_of(grid.order(), voxel.begin, voxel.end, [&](std::size_t, std::uint32_t i) {
    sum += merged.towards_sensor(i).cast<double>();
  });
  return (sum / voxel.count()).cast<float>();
}

Rgb mean_color(const MergedCloud& merged, const VoxelGrid& grid, const VoxelGrid::Voxel& voxel) {
  std::uint64_t r = 0, g = 0, b = 0;
  for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) {
    const Rgb& c = merged.cloud.colors[grid.order()[k]];
    r += c.r, g += c.g, b += c.b;
  }
  const std::uint64_t n = voxel.count(), half = n / 2;
  return {std::uint8_t((r + half) / n), std::uint8_t((g + half) / n), std::uint8_t((b + half) / n)};
}

Vec3f centroid(const MergedCloud& merged, const VoxelGrid& grid, const VoxelGrid::Voxel& voxel) {
  Vec3d sum = Vec3d::Zero();
  merged.for_each_of(grid.order(), voxel.begin, voxel.end, [&](std::size_t, std::uint32_t i) {
    sum += merged.cloud.points[i].cast<double>();
  });
  return (sum / voxel.count()).cast<float>();
}

void count_voxel(const MergedCloud& merged, const VoxelGrid& grid, const VoxelGrid::Voxel& voxel,
                 const CandidateOptions& options, std::vector<std::uint32_t>& counts) {
  const int s = options.subdivisions;
  counts.assign(std::size_t(s) * s * s, 0);
  const Vec3d low = voxel.index.cast<double>() * grid.size_m();
  const double scale = s / grid.size_m();
  merged.for_each_of(grid.order(), voxel.begin, voxel.end, [&](std::size_t, std::uint32_t i) {
    const Vec3d p = (merged.cloud.points[i].cast<double>() - low) * scale;
    walk_sub_voxels(p, merged.towards_sensor(i).cast<double>(), s,
                    options.line == SubVoxelLine::kChord,
                    [&](int x, int y, int z) { ++counts[std::size_t((z * s + y) * s + x)]; });
  });
}

/// Positions of the highest count, as points.
void add_best_sub_voxels(const VoxelGrid& grid, const VoxelGrid::Voxel& voxel, int s,
                         const std::vector<std::uint32_t>& counts, std::vector<Vec3f>& out) {
  const std::uint32_t highest = *std::max_element(counts.begin(), counts.end());
  for (int i = 0; i < s * s * s; ++i) {
    if (counts[std::size_t(i)] != highest) continue;
    const Vec3d cell(i % s + 0.5, i / s % s + 0.5, i / s / s + 0.5);
    out.push_back(((voxel.index.cast<double>() + cell / s) * grid.size_m()).cast<float>());
  }
}

Candidates candidates_of(const MergedCloud& merged, const VoxelGrid& grid,
                         const CandidateOptions& options, std::size_t begin, std::size_t end) {
  Candidates out;
  std::vector<std::uint32_t> counts;
  std::vector<Vec3f> points;
  for (std::size_t v = begin; v < end; ++v) {
    const VoxelGrid::Voxel& voxel = grid.voxels()[v];
    points.clear();
    if (options.method == CandidateMethod::kCentroid) {
      points.push_back(centroid(merged, grid, voxel));
    } else {
      count_voxel(merged, grid, voxel, options, counts);
      add_best_sub_voxels(grid, voxel, options.subdivisions, counts, points);
    }
    const Vec3f direction = mean_direction(merged, grid, voxel);
    for (const Vec3f& p : points) {
      out.cloud.points.push_back(p);
      out.cloud.weights.push_back(float(voxel.count()) / float(points.size()));
      if (!merged.cloud.colors.empty()) out.cloud.colors.push_back(mean_color(merged, grid, voxel));
      out.towards_sensor.push_back(direction);
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

OptionTable describe(CandidateOptions& o) {
  OptionTable table;
  table
      .choice("candidates", o.method, {"centroid", "sub-voxel"},
              "Candidate of a voxel: centroid of its points, or sub-voxel counting")
      .number("sub-voxels", o.subdivisions, {1, 16},
              "s: sub-voxel counting splits a voxel into s x s x s")
      .choice("sub-voxel-line", o.line, {"chord", "towards-sensor"},
              "Part of the line through sensor and point that is counted; towards-sensor is biased "
              "outwards");
  return table;
}

Result<Candidates> find_candidates(const MergedCloud& merged, const VoxelGrid& grid,
                                   const CandidateOptions& options, const RunContext& context) {
  CandidateOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  const std::size_t n = grid.voxels().size();
  context.begin_phase("candidate points", n);
  auto parts = parallel_chunks<Candidates>(n, kVoxelsAChunk, [&](std::size_t b, std::size_t e) {
    if (context.cancelled()) return Candidates();
    Candidates part = candidates_of(merged, grid, options, b, e);
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

std::vector<std::uint32_t> count_sub_voxels(const MergedCloud& merged, const VoxelGrid& grid,
                                            std::size_t voxel, const CandidateOptions& options) {
  std::vector<std::uint32_t> counts;
  count_voxel(merged, grid, grid.voxels().at(voxel), options, counts);
  return counts;
}

}  // namespace turnscan
