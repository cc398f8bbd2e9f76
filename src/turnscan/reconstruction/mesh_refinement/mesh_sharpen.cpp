#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_sharpen.hpp>
#include <turnscan/reconstruction/mesh_refinement/vertex_observations.hpp>
#include <turnscan/reconstruction/views/view_drawing.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr std::size_t kMaxDrawnViews = 64, kMinDrawnViews = 16;
constexpr std::size_t kMaxDrawnBytes = std::size_t(64) << 20;
/// Neighbours with a larger difference in depth do not mix: such pixels are rejected, or have
/// different phases.
constexpr float kApart_m = 0.06f;
/// Steps are averaged over the neighbourhood, without which rims would become jagged.
constexpr int kRings = 8;
constexpr float kMin_m = 1e-4f;  // shorter steps are mostly residual noise of the surface

void put(views::DepthView& view, std::size_t at, float z) {
  const float raw = std::round((z - view.bias_m) / view.unit_m);
  if (raw >= 1.0f && raw < 65534.0f) view.pixels[at] |= std::uint32_t(raw);
}

/// Depth of a pixel inside the border after the filter.
float filtered_depth(const std::vector<views::ViewDrawing::Received>& received, std::size_t at,
                     int width, float share) {
  const float taps[3] = {share, 1.0f - 2.0f * share, share};
  views::ViewDrawing::Received sum;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const auto& other = received[at + std::size_t(std::ptrdiff_t(j) * width + i)];
      if (!(other.light > 0.0f) || std::abs(other.mean() - received[at].mean()) > kApart_m)
        continue;
      sum.light += taps[j + 1] * taps[i + 1] * other.light;
      sum.depth += taps[j + 1] * taps[i + 1] * other.depth;
    }
  }
  return sum.mean();
}

/// The mesh as seen through the filter, where the view has measurements: the fit saw no more.
views::DepthView draw(const views::DepthView& view, const TriangleMesh& mesh, float share) {
  views::DepthView out = view;
  out.colors.clear();
  for (std::uint32_t& word : out.pixels) word &= views::DepthView::kEdge;
  const views::ViewDrawing drawing(view, mesh);
  std::vector<views::ViewDrawing::Received> received(view.pixels.size());
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x)
      received[std::size_t(y) * std::size_t(view.width) + std::size_t(x)] = drawing.received(x, y);
  }
  for (int y = 1; y + 1 < view.height; ++y) {
    for (int x = 1; x + 1 < view.width; ++x) {
      const std::size_t at = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
      if ((view.pixels[at] & 0xffffu) != 0 && received[at].light > 0.0f)
        put(out, at, filtered_depth(received, at, view.width, share));
    }
  }
  return out;
}

Result<std::vector<views::DepthView>> draw_some(const TriangleMesh& mesh,
                                                std::span<const views::DepthView> views,
                                                float share, const RunContext& context) {
  std::size_t pixels = 1;
  for (const views::DepthView& view : views) pixels = std::max(pixels, view.pixels.size());
  const std::size_t fit = kMaxDrawnBytes / (sizeof(std::uint32_t) * pixels);
  const auto chosen = evenly_spread(views.size(), std::clamp(fit, kMinDrawnViews, kMaxDrawnViews));
  std::vector<views::DepthView> out(chosen.size());
  TURNSCAN_TRY(parallel_for(out.size(), 1, context,
                            [&](std::size_t i) { out[i] = draw(views[chosen[i]], mesh, share); }));
  return out;
}

/// Replaces each value by the mean of itself and the mean around it.
template <class T>
void blend(std::vector<T>& values, const MeshNeighbours& neighbours, const T& zero) {
  std::vector<T> out(values.size(), zero);
  parallel_for(values.size(), 4096, [&](std::size_t v) {
    out[v] = 0.5f * (values[v] + neighbours.mean(values, v, zero));
  });
  values.swap(out);
}

/// The step of each vertex after which the filtered mesh would match the measurements.
std::vector<Vec3f> sharpening_steps(const TriangleMesh& mesh, const std::vector<Vec3f>& normals,
                                    const VertexMeasurements& measured,
                                    const VertexMeasurements& drawn, const MeshFitScale& scale) {
  const std::size_t n = mesh.vertices.size();
  const float typical = typical_support(drawn.support);
  std::vector<float> weight(n, 0.0f);
  std::vector<Vec3f> step(n, Vec3f::Zero());
  for (std::size_t v = 0; v < n; ++v) {
    if (!(measured.support[v] > 0.0f) || !(drawn.support[v] > 0.0f)) continue;
    weight[v] = std::min(drawn.support[v], typical);
    step[v] = weight[v] * normals[v] *
              (measured.offset[v] / measured.support[v] - drawn.offset[v] / drawn.support[v]);
  }
  const MeshNeighbours neighbours(mesh);
  for (int ring = 0; ring < kRings; ++ring) {
    blend(step, neighbours, Vec3f(Vec3f::Zero()));
    blend(weight, neighbours, 0.0f);
  }
  parallel_for(n, 1024, [&](std::size_t v) {
    const float length = weight[v] > 0.0f ? step[v].norm() / weight[v] : 0.0f;
    if (!(length > kMin_m) || below_floor(mesh.vertices[v], scale)) {
      step[v].setZero();
      return;
    }
    step[v] *= std::min(float(2.0 * scale.limit_m), length - kMin_m) / step[v].norm();
  });
  return step;
}

}  // namespace

Result<> sharpen_mesh(TriangleMesh& mesh, std::span<const views::DepthView> views, double share,
                      const MeshFitScale& scale, const RunContext& context) {
  TURNSCAN_ASSIGN(const std::vector<views::DepthView> drawn,
                  draw_some(mesh, views, float(share), context));
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  VertexObserver observer(mesh);
  observer.set_vertices(mesh.vertices, normals);
  context.begin_phase("sharpen", 2 * observer.blocks());
  TURNSCAN_ASSIGN(
      const auto filtered,
      observer.observe(drawn, evenly_spread(drawn.size(), drawn.size()), scale, context));
  TURNSCAN_ASSIGN(
      const auto found,
      observer.observe(views, evenly_spread(views.size(), views.size()), scale, context));
  take_steps(mesh, sharpening_steps(mesh, normals, found, filtered, scale));
  return {};
}

}  // namespace turnscan::mesh_refinement
