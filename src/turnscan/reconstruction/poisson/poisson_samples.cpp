#include <algorithm>
#include <cmath>
#include <turnscan/core/morton.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/poisson/poisson_samples.hpp>
#include <turnscan/reconstruction/voxels/key_sort.hpp>

namespace turnscan::poisson {
namespace {

/// Samples per occupied cell at the level where their density is measured.
constexpr double kPerCell = 4.0;
/// Counts are spread and read with quadratic B-splines: a plane with one sample per face of a cell
/// then reads as this, within a tenth, at any position (0.50 to 0.59 for planes along the axes) and
/// inclination (the height of a Gaussian of the variance 1/2).
constexpr double kPlane = 0.555;
/// Share of the samples that must be within half a level of the deepest level.
constexpr double kFairShare = 0.1;
constexpr int kDeeper = 2;

std::array<float, 3> spline_weights(double t) {
  return {float(0.5 * (1.0 - t) * (1.0 - t)), float(0.5 + t - t * t), float(0.5 * t * t)};
}

}  // namespace

OrientedSamples::OrientedSamples(const PointCloud& oriented, const Cube& cube, int max_depth,
                                 double wanted)
    : max_depth_(max_depth) {
  const std::size_t n = oriented.size();
  const auto place = [&](std::size_t i) -> Vec3d {
    return (oriented.points[i].cast<double>() - cube.corner) / cube.side_m;
  };
  std::vector<voxels::KeyedItem> items(n);
  parallel_for(n, 4096, [&](std::size_t i) {
    const Vec3d p = place(i);
    std::array<std::uint64_t, 3> c;
    for (int a = 0; a < 3; ++a)
      c[std::size_t(a)] = std::uint64_t(std::clamp(std::floor(std::ldexp(p[a], max_depth)), 0.0,
                                                   std::ldexp(1.0, max_depth) - 1.0));
    items[i] = {morton_code(c[0], c[1], c[2]), std::uint32_t(i)};
  });
  voxels::sort_by_key(items, (std::uint64_t(1) << (3 * max_depth)) - 1);
  position_.resize(n), normal_.resize(n), code_.resize(n);
  parallel_for(n, 4096, [&](std::size_t i) {
    position_[i] = place(items[i].item);
    normal_[i] = oriented.normals[items[i].item];
    code_[i] = items[i].key;
  });
  choose_depths(wanted);
}

template <class Body>
void OrientedSamples::for_each_sample(const SparseBricks& bricks, const Body& body) const {
  for (const auto& runs_of_color : runs(bricks.depth())) {
    parallel_for(runs_of_color.size(), 4, [&](std::size_t r) {
      const BrickRun& run = runs_of_color[r];
      const Neighbours around = bricks.neighbours(run.brick);
      for (std::size_t i = run.begin; i < run.end; ++i) body(i, around);
    });
  }
}

void OrientedSamples::choose_depths(double wanted) {
  const int measured = density_depth();
  SparseBricks bricks(measured);
  for_each_occupied(measured, [&](const Index& c) {
    for (int n = 0; n < 8; ++n)
      bricks.add({(c[0] + (n & 1) * 2 - 1) >> 3, (c[1] + (n & 2) - 1) >> 3,
                  (c[2] + (n >> 2) * 2 - 1) >> 3});
  });
  Field counts(bricks.size() * kCells, 0.0f);
  for_each_sample(bricks, [&](std::size_t i, const Neighbours& around) {
    for_each_cell(spot(i, position_[i], measured), around,
                  [&](std::size_t cell, float weight) { counts[cell] += weight; });
  });
  const std::vector<float> density = read(bricks, counts);
  area_.resize(size());
  std::vector<float> depth(size());
  for (std::size_t i = 0; i < size(); ++i) {
    area_[i] = kPlane * std::ldexp(1.0, -2 * measured) / double(density[i]);
    depth[i] = float(
        std::clamp(-0.5 * std::log2(area_[i] * wanted), double(kCoarsest), double(max_depth_)));
  }
  std::vector<float> sorted = depth;
  const auto rank = std::ptrdiff_t((1.0 - kFairShare) * double(size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
  // A cloud of even density is about one level deeper than the level of measurement; many
  // coincident points must not make it much deeper.
  deepest_ = std::min(int(std::floor(sorted[std::size_t(rank)] + 0.5f)), measured + kDeeper);
  for (float& d : depth) d = std::min(d, float(deepest_));
  depth_ = std::move(depth);
}

int OrientedSamples::density_depth() const {
  for (int depth = max_depth_ - 1; depth > kCoarsest; --depth) {
    std::size_t cells = 0;
    for_each_occupied(depth, [&](const Index&) { ++cells; });
    if (double(size()) >= kPerCell * double(cells)) return depth;
  }
  return kCoarsest;
}

Index OrientedSamples::cell(std::size_t sample, int depth) const {
  Index out;
  const double cells = std::ldexp(1.0, depth);
  for (int a = 0; a < 3; ++a)
    out[std::size_t(a)] =
        int(std::clamp(std::floor(position_[sample][a] * cells), 0.0, cells - 1.0));
  return out;
}

SplineFootprint OrientedSamples::spot(std::size_t sample, const Vec3d& position, int depth) const {
  const Index c = cell(sample, depth);
  SplineFootprint out;
  for (std::size_t a = 0; a < 3; ++a) {
    out.cell[a] = std::int8_t(c[a] & 7);
    auto& w = out.weight[a];
    w = spline_weights(std::ldexp(position[Eigen::Index(a)], depth) - c[a]);
    // Beyond the faces of the cube coefficients are the negative of their mirror images.
    if (c[a] == 0) w[1] -= std::exchange(w[0], 0.0f);
    if (c[a] == (1 << depth) - 1) w[1] -= std::exchange(w[2], 0.0f);
  }
  return out;
}

ColoredRuns OrientedSamples::runs(int depth) const {
  ColoredRuns out;
  const int shift = 3 * (max_depth_ - depth + 3);  // a brick contains 8^3 cells
  for (std::size_t i = 0; i < size();) {
    const std::size_t begin = i;
    while (i < size() && code_[i] >> shift == code_[begin] >> shift) ++i;
    Index b = cell(begin, depth);
    for (int& x : b) x >>= 3;
    out[color_of(b)].push_back({std::uint32_t(begin), std::uint32_t(i), b});
  }
  return out;
}

std::vector<float> OrientedSamples::read(const SparseBricks& bricks, const Field& function) const {
  std::vector<float> out(size(), 0.0f);
  for_each_sample(bricks, [&](std::size_t i, const Neighbours& around) {
    for_each_cell(spot(i, position_[i], bricks.depth()), around,
                  [&](std::size_t cell, float weight) { out[i] += weight * function[cell]; });
  });
  return out;
}

float OrientedSamples::median(const SparseBricks& bricks, const Field& function) const {
  std::vector<float> values = read(bricks, function);
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void OrientedSamples::splat(const SparseBricks& bricks, Field& x, Field& y, Field& z) const {
  const int depth = bricks.depth();
  const double face = std::ldexp(1.0, 2 * depth);  // number of faces of cells in that of the cube
  for_each_sample(bricks, [&](std::size_t i, const Neighbours& around) {
    // A depth of 6.3 puts 0.7 of the sample on level 6 and 0.3 on level 7.
    const float share = 1.0f - std::abs(depth_[i] - float(depth));
    if (share <= 0.0f) return;
    const Vec3f v = share * float(area_[i] * face) * normal_[i];
    for_each_cell(spot(i, position_[i], depth), around, [&](std::size_t cell, float weight) {
      x[cell] += weight * v.x();
      y[cell] += weight * v.y();
      z[cell] += weight * v.z();
    });
  });
}

SampleClusters OrientedSamples::clusters(const SparseBricks& bricks) const {
  const int depth = bricks.depth(), shift = 3 * (max_depth_ - depth);
  const double face = std::ldexp(1.0, 2 * depth);
  SampleClusters out;
  for (const auto& runs_of_color : runs(depth)) {
    for (const BrickRun& run : runs_of_color) {
      if (bricks.slot(run.brick) < 0) continue;
      const std::size_t first = out.all.size();
      for (std::size_t i = run.begin; i < run.end;) {
        const std::size_t begin = i;
        Vec3d sum = Vec3d::Zero();
        double area = 0.0;
        for (; i < run.end && code_[i] >> shift == code_[begin] >> shift; ++i) {
          sum += area_[i] * position_[i];
          area += area_[i];
        }
        out.all.push_back({spot(begin, sum / area, depth), float(area * face)});
      }
      out.runs[color_of(run.brick)].push_back(
          {std::uint32_t(first), std::uint32_t(out.all.size()), run.brick});
    }
  }
  return out;
}

}  // namespace turnscan::poisson
