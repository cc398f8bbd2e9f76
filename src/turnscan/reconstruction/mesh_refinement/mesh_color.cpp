#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_color.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr std::size_t kMaxColorViews = 256;
constexpr float kMinColorCosine = 0.2f;  // grazing rays mix adjacent surfaces
constexpr Rgb kPlain{190, 190, 190};

/// Sum of colours, and of their weights in the last component.
Eigen::Vector4f seen_color(const views::DepthView& view, const Vec3f& vertex, const Vec3f& normal,
                           float tolerance) {
  const Eigen::Vector4f nothing = Eigen::Vector4f::Zero();
  const Vec3f p = view.rotation * vertex + view.translation;
  const Vec3f ray = view.parallel ? Vec3f(Vec3f::UnitZ()) : Vec3f(p.normalized());
  const float cosine = -(view.rotation * normal).dot(ray);
  if (!(cosine > kMinColorCosine)) return nothing;
  const std::ptrdiff_t i = view.pixel_at(p);
  if (i < 0) return nothing;
  const std::uint32_t word = view.pixels[std::size_t(i)];
  if ((word & 0xffffu) == 0 || (word & views::DepthView::kEdge) != 0) return nothing;
  const float depth = float(word & 0xffffu) * view.unit_m + view.bias_m;
  if (!(std::abs(depth - p.z()) <= tolerance)) return nothing;
  const Rgb c = view.colors[std::size_t(i)];
  if (c == Rgb{}) return nothing;
  const float w = cosine * cosine * cosine * cosine;
  return {w * float(c.r), w * float(c.g), w * float(c.b), w};
}

/// The mean, rounded, in the first three components.
Rgb mean_color(const Eigen::Vector4f& sum) {
  const auto byte = [&](int a) {
    return std::uint8_t(std::clamp(sum[a] / sum[3] + 0.5f, 0.0f, 255.0f));
  };
  return {byte(0), byte(1), byte(2)};
}

/// Propagates colours from coloured vertices to the others, one ring per round.
void spread(TriangleMesh& mesh, std::vector<std::uint8_t> known) {
  std::vector<Eigen::Vector4f> sum(known.size());
  for (bool more = true; more;) {
    std::fill(sum.begin(), sum.end(), Eigen::Vector4f::Zero());
    for (const auto& t : mesh.triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t from = t[c];
        if (!known[from]) continue;
        const Rgb& color = mesh.colors[from];
        const Eigen::Vector4f own(float(color.r), float(color.g), float(color.b), 1.0f);
        for (const std::uint32_t to : {t[(c + 1) % 3], t[(c + 2) % 3]}) {
          if (!known[to]) sum[to] += own;
        }
      }
    }
    more = false;
    for (std::size_t v = 0; v < known.size(); ++v) {
      if (!(sum[v][3] > 0.0f)) continue;
      mesh.colors[v] = mean_color(sum[v]);
      known[v] = 1;
      more = true;
    }
  }
}

}  // namespace

Result<bool> color_from_views(TriangleMesh& mesh, std::span<const views::DepthView> views,
                              double tolerance_m, const RunContext& context) {
  std::vector<const views::DepthView*> colored;
  for (const views::DepthView& view : views) {
    if (!view.colors.empty()) colored.push_back(&view);
  }
  if (colored.empty()) return false;
  const std::size_t step = (colored.size() + kMaxColorViews - 1) / kMaxColorViews;
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  std::vector<std::uint8_t> known(mesh.vertices.size(), 0);
  mesh.colors.assign(mesh.vertices.size(), kPlain);
  TURNSCAN_TRY(parallel_for(mesh.vertices.size(), 512, context, [&](std::size_t v) {
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    for (std::size_t k = 0; k < colored.size(); k += step)
      sum += seen_color(*colored[k], mesh.vertices[v], normals[v], float(tolerance_m));
    if (!(sum[3] > 0.0f)) return;
    mesh.colors[v] = mean_color(sum);
    known[v] = 1;
  }));
  const bool any = std::any_of(known.begin(), known.end(), [](std::uint8_t k) { return k != 0; });
  if (any)
    spread(mesh, std::move(known));
  else
    mesh.colors.clear();
  return any;
}

void paint_invented(TriangleMesh& mesh, const std::vector<Evidence>& evidence) {
  if (mesh.colors.empty()) mesh.colors.assign(mesh.vertices.size(), kPlain);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (evidence[t] != Evidence::kInvented) continue;
    for (const std::uint32_t v : mesh.triangles[t]) mesh.colors[v] = kInventedColor;
  }
}

}  // namespace turnscan::mesh_refinement
