#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/vertex_observations.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr std::size_t kBlock = 256;  // vertices that are projected together
constexpr float kTukey = 4.685f;     // standard deviations; 95 % efficient for normal noise
constexpr float kMinCosine = 0.2f;   // grazing rays contribute little

/// Groups vertices with similar normals and positions, so that a view that sees one of them sees
/// most, and views that see none can be skipped.
std::vector<std::uint32_t> order_by_facing(const std::vector<Vec3f>& positions,
                                           const std::vector<Vec3f>& normals) {
  Box box = bounds(positions);
  const double side = std::max(box.size().maxCoeff(), 1e-9);
  // 10 interleaved bits of position per axis; before them one of 24 directions: the cube's face
  // that the normal points through, and the quarter of it.
  const auto spread = [](std::uint64_t v) {
    std::uint64_t out = 0;
    for (int bit = 0; bit < 10; ++bit) out |= (v >> bit & 1) << (3 * bit);
    return out;
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> key(positions.size());
  parallel_for(positions.size(), 4096, [&](std::size_t v) {
    int axis = 0;
    normals[v].cwiseAbs().maxCoeff(&axis);
    std::uint64_t code = std::uint64_t(axis);
    for (int a = 0; a < 3; ++a) code = 2 * code + (normals[v][a] < 0.0f ? 1 : 0);
    code <<= 30;
    for (int a = 0; a < 3; ++a) {
      const double at = (double(positions[v][a]) - box.min[a]) / side * 1023.0;
      code |= spread(std::uint64_t(std::clamp(at, 0.0, 1023.0))) << a;
    }
    key[v] = {code, std::uint32_t(v)};
  });
  std::sort(key.begin(), key.end());
  std::vector<std::uint32_t> order(key.size());
  for (std::size_t i = 0; i < key.size(); ++i) order[i] = key[i].second;
  return order;
}

VertexKernelView kernel_view(const views::DepthView& view) {
  VertexKernelView k{};
  k.pixels = view.pixels.data();
  k.width = view.width;
  k.height = view.height;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      k.rotation[row * 3 + column] = view.rotation(row, column);
    k.translation[row] = view.translation[row];
  }
  k.fx = view.fx, k.fy = view.fy, k.cx = view.cx, k.cy = view.cy;
  k.lens = view.lens;
  k.unit = view.unit_m, k.bias = view.bias_m;
  k.distorted = !view.distorted ? 0 : view.lens.rational() ? 2 : 1;
  k.parallel = view.parallel ? 1 : 0;
  return k;
}

std::size_t pad(std::size_t n) { return (n + kVertexRow - 1) / kVertexRow * kVertexRow; }

}  // namespace

VertexObserver::VertexObserver(const TriangleMesh& mesh)
    : order_(order_by_facing(mesh.vertices, vertex_normals(mesh))) {}

std::size_t VertexObserver::blocks() const { return (order_.size() + kBlock - 1) / kBlock; }

void VertexObserver::set_vertices(const std::vector<Vec3f>& positions,
                                  const std::vector<Vec3f>& normals) {
  for (auto& column : columns_) column.assign(pad(order_.size()), 1.0f);
  parallel_for(order_.size(), 4096, [&](std::size_t i) {
    const std::uint32_t v = order_[i];
    for (int a = 0; a < 3; ++a) {
      columns_[std::size_t(a)][i] = positions[v][a];
      columns_[std::size_t(a + 3)][i] = normals[v][a];
    }
  });
  patches_.resize(blocks());
  parallel_for(patches_.size(), 16, [&](std::size_t b) {
    patches_[b] = patch(b * kBlock, std::min(order_.size(), (b + 1) * kBlock));
  });
}

Result<VertexMeasurements> VertexObserver::observe(std::span<const views::DepthView> views,
                                                   std::span<const std::size_t> chosen,
                                                   const MeshFitScale& scale,
                                                   const RunContext& context) const {
  const std::size_t n = order_.size();
  const VertexColumns columns{columns_[0].data(), columns_[1].data(), columns_[2].data(),
                              columns_[3].data(), columns_[4].data(), columns_[5].data()};
  const VertexKernelScale how{float(1.0 / (scale.reach_m * scale.reach_m)),
                              float(scale.noise_m),
                              float(scale.floor_m),
                              kTukey,
                              kMinCosine,
                              scale.edge_weight};
  std::vector<VertexKernelView> kernels;
  for (const std::size_t v : chosen) kernels.push_back(kernel_view(views[v]));
  std::vector<float> weight(pad(n), 0.0f), offset(pad(n), 0.0f);
  TURNSCAN_TRY(parallel_for(blocks(), 1, context, [&](std::size_t b) {
    const std::size_t begin = b * kBlock, end = std::min(n, begin + kBlock);
    const Patch& around = patches_[b];
    VertexSums sums{weight.data(), offset.data()};
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const views::DepthView& view = views[chosen[k]];
      if (turned_away(view, around) || outside_window(view, around)) continue;
      VertexKernels::current().add_view(kernels[k], columns, begin, pad(end), how, sums);
    }
    context.advance();
  }));
  VertexMeasurements out{std::vector<float>(n), std::vector<float>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    out.support[order_[i]] = weight[i];
    out.offset[order_[i]] = offset[i];
  }
  return out;
}

/// For the vertices at [begin, end).
VertexObserver::Patch VertexObserver::patch(std::size_t begin, std::size_t end) const {
  const auto at = [&](std::size_t first, std::size_t i) {
    return Vec3f(columns_[first][i], columns_[first + 1][i], columns_[first + 2][i]);
  };
  Patch out;
  Box box;
  for (std::size_t i = begin; i < end; ++i) {
    box.add(at(0, i).cast<double>());
    out.axis += at(3, i);
  }
  out.center = box.center().cast<float>();
  out.radius = float(0.5 * box.size().norm());
  out.axis.normalize();
  float least = 1.0f;
  for (std::size_t i = begin; i < end; ++i) least = std::min(least, out.axis.dot(at(3, i)));
  out.opening = std::acos(std::clamp(least, -1.0f, 1.0f));
  return out;
}

/// Whether no vertex of the patch faces the view.
bool VertexObserver::turned_away(const views::DepthView& view, const Patch& patch) {
  constexpr float kHalfPi = 1.5707963f, kSlack = 0.01f;
  const Vec3f axis = view.rotation * patch.axis;
  const Vec3f c = view.rotation * patch.center + view.translation;
  const float distance = c.norm();
  // Directions to the sensor differ across the patch.
  float wide = patch.opening + kSlack;
  if (!view.parallel) {
    if (distance <= 2.0f * patch.radius) return false;
    wide += std::asin(patch.radius / distance);
  }
  const float facing = view.parallel ? -axis.z() : -axis.dot(c) / distance;
  return std::acos(std::clamp(facing, -1.0f, 1.0f)) - wide > std::acos(kMinCosine) &&
         wide < kHalfPi;
}

bool VertexObserver::outside_window(const views::DepthView& view, const Patch& patch) {
  const Vec3f c = view.rotation * patch.center + view.translation;
  const float radius = patch.radius;
  if (view.parallel || view.distorted) return false;
  if (c.z() <= radius) return true;
  const float reach = 1.1f * radius / (c.z() - radius);
  const float u = c.x() / c.z() * view.fx + view.cx, v = c.y() / c.z() * view.fy + view.cy;
  return u + reach * view.fx < 0.0f || v + reach * view.fy < 0.0f ||
         u - reach * view.fx > float(view.width) || v - reach * view.fy > float(view.height);
}

}  // namespace turnscan::mesh_refinement
