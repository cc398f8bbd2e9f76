#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/arc_tangent.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/quality/vertex_visibility.hpp>

namespace turnscan::quality {

namespace {

constexpr std::size_t kMaxViews = 128;
constexpr float kMinCosine = 0.1f;
constexpr float kFacingCosine = 0.4f;  ///< any surface that is not nearly black returns at these
                                       ///< angles
constexpr std::size_t kMinNoReturnViews = 3;

/// The pixel of a view's window that contains a vertex facing it by the cosine; -1 if there is
/// none.
struct PixelOfVertex {
  std::ptrdiff_t pixel = -1;
  float z = 0.0f, along = 1.0f, cosine = 0.0f;  ///< along: a ray's length relative to its z
                                                ///< component
};
PixelOfVertex pixel_of(const views::DepthView& view, const Vec3f& vertex, const Vec3f& normal,
                       float least_cosine) {
  const Vec3f p = view.rotation * vertex + view.translation;
  if (!view.parallel && !(p.z() > 0.0f)) return {};
  const Vec3f ray = view.parallel ? Vec3f(Vec3f::UnitZ()) : Vec3f(p / p.z());
  const float cosine = -(view.rotation * normal).dot(ray) / ray.norm();
  if (!(cosine > least_cosine)) return {};
  return {view.pixel_at(p), p.z(), ray.norm(), cosine};
}

bool saw(const views::DepthView& view, const Vec3f& vertex, const Vec3f& normal,
         float tolerance_m) {
  const PixelOfVertex at = pixel_of(view, vertex, normal, kMinCosine);
  if (at.pixel < 0) return false;
  const std::uint32_t word = view.pixels[std::size_t(at.pixel)];
  if ((word & 0xffffu) == 0) return false;
  const float depth = float(word & 0xffffu) * view.unit_m + view.bias_m;
  return std::abs(depth - at.z) * at.along * at.cosine <= tolerance_m;
}

/// The sector, over all bands, of a view as seen from a point.
int sector_of(const Viewpoint& viewpoint, const Vec3f& p) {
  const Vec3f to = viewpoint.direction_from(p.cast<double>()).cast<float>();
  const float turn = arc_tangent(to.z(), to.x()) / float(kTurn) + 0.5f;
  const float height =
      std::asin(std::clamp(to.y(), -1.0f, 1.0f)) / std::numbers::pi_v<float> + 0.5f;
  return std::clamp(int(height * kBands), 0, kBands - 1) * kSectors +
         std::clamp(int(turn * kSectors), 0, kSectors - 1);
}

}  // namespace

Result<VertexVisibility> vertex_visibility(const TriangleMesh& mesh,
                                           std::span<const views::DepthView> views,
                                           double tolerance_m, const RunContext& context) {
  VertexVisibility out;
  out.frames.assign(mesh.vertices.size(), 0);
  out.directions.assign(mesh.vertices.size(), 0);
  const auto chosen = evenly_spread(views.size(), kMaxViews);
  if (chosen.empty()) return out;
  std::vector<Viewpoint> viewpoints;
  for (const std::size_t i : chosen) viewpoints.push_back(views[i].viewpoint());
  const auto normals = vertex_normals(mesh);
  TURNSCAN_TRY(context.check());
  const double share = double(views.size()) / double(chosen.size());
  parallel_for(mesh.vertices.size(), 256, [&](std::size_t v) {
    std::size_t count = 0;
    std::uint64_t sectors = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Vec3f& p = mesh.vertices[v];
      if (!saw(views[chosen[i]], p, normals[v], float(tolerance_m))) continue;
      ++count;
      sectors |= std::uint64_t(1) << sector_of(viewpoints[i], p);
    }
    out.frames[v] = std::uint16_t(std::min(65535.0, std::round(share * double(count))));
    out.directions[v] = std::uint8_t(std::popcount(sectors));
  });
  TURNSCAN_TRY(context.check());
  return out;
}

float nearest_depth_m(std::span<const views::DepthView> views) {
  float out = std::numeric_limits<float>::infinity();
  for (const views::DepthView& view : views)
    if (view.nearest > 0) out = std::min(out, float(view.nearest) * view.unit_m + view.bias_m);
  return std::isfinite(out) ? out : 0.0f;
}

Result<std::vector<NoReturn>> without_return(const TriangleMesh& mesh,
                                             std::span<const views::DepthView> views,
                                             const std::vector<std::uint8_t>& asked,
                                             const RunContext& context) {
  std::vector<NoReturn> out(mesh.vertices.size(), NoReturn::kNone);
  const float nearest_m = nearest_depth_m(views);
  const auto chosen = evenly_spread(views.size(), kMaxViews);
  const auto normals = vertex_normals(mesh);
  TURNSCAN_TRY(context.check());
  parallel_for(out.size(), 256, [&](std::size_t v) {
    if (!asked[v]) return;
    std::size_t facing = 0, no_return = 0, near = 0;
    for (const std::size_t i : chosen) {
      const views::DepthView& view = views[i];
      const PixelOfVertex at = pixel_of(view, mesh.vertices[v], normals[v], kFacingCosine);
      if (at.pixel < 0) continue;
      const auto x = at.pixel % view.width, y = at.pixel / view.width;
      if (x == 0 || y == 0 || x + 1 == view.width || y + 1 == view.height) continue;  // border
      ++facing;
      if (view.pixels[std::size_t(at.pixel)] != 0) continue;
      ++no_return;
      near += at.z < nearest_m ? 1 : 0;
    }
    if (no_return >= kMinNoReturnViews && 2 * no_return >= facing)
      out[v] = 2 * near >= no_return ? NoReturn::kTooNear : NoReturn::kNothing;
  });
  TURNSCAN_TRY(context.check());
  return out;
}

}  // namespace turnscan::quality
