#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_look.hpp>
#include <turnscan/reconstruction/mesh_sharpen.hpp>
#include <turnscan/reconstruction/view_drawing.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMostViews = 64, kFewestViews = 16;  // that are drawn
constexpr std::size_t kMostBytes = std::size_t(64) << 20;  // of what is drawn
/// Neighbours this much nearer or farther do not mix: such pixels are rejected, or phases apart.
constexpr float kApart_m = 0.06f;
/// Each vertex goes with those around it: alone, rims would become saws.
constexpr int kRings = 8;
constexpr float kLeast_m = 1e-4f;   // shorter ways are mostly what noise left on the surface
constexpr float kTrusted = 0.005f;  // of the usual support; with less vertices go less far
constexpr float kUnseen = 1e-4f;    // with less they stay

void put(DepthView& view, std::size_t at, float z) {
  const float raw = std::round((z - view.bias_m) / view.unit_m);
  if (raw >= 1.0f && raw < 65534.0f) view.pixels[at] |= std::uint32_t(raw);
}

/// Depth of a pixel inside the border after the filter.
float filtered_depth(const std::vector<ViewDrawing::Received>& received, std::size_t at, int width,
                     float share) {
  const float taps[3] = {share, 1.0f - 2.0f * share, share};
  ViewDrawing::Received sum;
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

/// What the filter makes of the mesh, where the view measured something: the fit saw no more.
DepthView draw(const DepthView& view, const TriangleMesh& mesh, float share) {
  DepthView out = view;
  out.colors.clear();
  for (std::uint32_t& word : out.pixels) word &= DepthView::kEdge;
  const ViewDrawing drawing(view, mesh);
  std::vector<ViewDrawing::Received> received(view.pixels.size());
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

Result<std::vector<DepthView>> draw_some(const TriangleMesh& mesh, std::span<const DepthView> views,
                                         float share, const RunContext& context) {
  std::size_t pixels = 1;
  for (const DepthView& view : views) pixels = std::max(pixels, view.pixels.size());
  const std::size_t fit = kMostBytes / (sizeof(std::uint32_t) * pixels);
  const std::size_t count = std::min(views.size(), std::clamp(fit, kFewestViews, kMostViews));
  std::vector<DepthView> out(count);
  parallel_for(count, 1, [&](std::size_t i) {
    if (!context.cancelled()) out[i] = draw(views[i * views.size() / count], mesh, share);
  });
  TURNSCAN_TRY(context.check());
  return out;
}

/// Each value becomes the mean of itself and the mean around it.
template <class T>
void blend(std::vector<T>& values, const detail::MeshNeighbours& neighbours, const T& zero) {
  std::vector<T> out(values.size(), zero);
  parallel_for(values.size(), 4096, [&](std::size_t v) {
    out[v] = 0.5f * (values[v] + neighbours.mean(values, v, zero));
  });
  values.swap(out);
}

/// The way of each vertex to where the filter would make of it what was measured.
std::vector<Vec3f> ways(const TriangleMesh& mesh, const std::vector<Vec3f>& normals,
                        const detail::VertexMeasurements& measured,
                        const detail::VertexMeasurements& drawn, const MeshFitScale& scale) {
  const std::size_t n = mesh.vertices.size();
  const float typical = detail::typical_support(drawn.support);
  std::vector<float> weight(n, 0.0f);
  std::vector<Vec3f> way(n, Vec3f::Zero());
  for (std::size_t v = 0; v < n; ++v) {
    if (!(measured.support[v] > 0.0f) || !(drawn.support[v] > 0.0f)) continue;
    weight[v] = std::min(drawn.support[v], typical);
    way[v] = weight[v] * normals[v] *
             (measured.offset[v] / measured.support[v] - drawn.offset[v] / drawn.support[v]);
  }
  const detail::MeshNeighbours neighbours(mesh);
  for (int ring = 0; ring < kRings; ++ring) {
    blend(way, neighbours, Vec3f(Vec3f::Zero()));
    blend(weight, neighbours, 0.0f);
  }
  for (std::size_t v = 0; v < n; ++v) {
    const float length = weight[v] > 0.0f ? way[v].norm() / weight[v] : 0.0f;
    if (!(weight[v] > kUnseen * typical) || !(length > kLeast_m) ||
        detail::stands(mesh.vertices[v], scale)) {
      way[v].setZero();
      continue;
    }
    const float trust = std::min(1.0f, weight[v] / (kTrusted * typical));
    way[v] *= trust * std::min(float(2.0 * scale.limit_m), length - kLeast_m) / way[v].norm();
  }
  return way;
}

}  // namespace

Result<> sharpen_mesh(TriangleMesh& mesh, std::span<const DepthView> views, double share,
                      const MeshFitScale& scale, const RunContext& context) {
  TURNSCAN_ASSIGN(const std::vector<DepthView> drawn,
                  draw_some(mesh, views, float(share), context));
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  detail::MeshLook look(mesh);
  look.place(mesh.vertices, normals, {});
  context.begin_phase("sharpen", 2 * look.blocks());
  TURNSCAN_ASSIGN(const auto filtered, look.look(drawn, 1, scale, context));
  TURNSCAN_ASSIGN(const auto found, look.look(views, 1, scale, context));
  detail::take_steps(mesh, ways(mesh, normals, found.measured, filtered.measured, scale));
  return {};
}

}  // namespace turnscan
