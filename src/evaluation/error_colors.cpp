#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/geometry/closest_point.hpp>
#include <turnscan/geometry/mesh_check.hpp>

namespace turnscan {
namespace {

/// Ten evenly spaced colours of viridis, which its authors gave to the public domain (CC0).
constexpr std::array<std::array<int, 3>, 10> kViridis = {{{68, 1, 84},
                                                          {72, 40, 120},
                                                          {62, 74, 137},
                                                          {49, 104, 142},
                                                          {38, 130, 142},
                                                          {31, 158, 137},
                                                          {53, 183, 121},
                                                          {110, 206, 88},
                                                          {181, 222, 43},
                                                          {253, 231, 37}}};

Rgb viridis(double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * double(kViridis.size() - 1);
  const auto low = std::min(std::size_t(place), kViridis.size() - 2);
  const double t = place - double(low);
  std::array<std::uint8_t, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = std::uint8_t(std::lround((1.0 - t) * kViridis[low][i] + t * kViridis[low + 1][i]));
  }
  return {c[0], c[1], c[2]};
}

}  // namespace

Result<TriangleMesh> color_by_error(const TriangleMesh& mesh, const TriangleMesh& reference,
                                    double max_error_m, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh, "mesh"));
  TURNSCAN_TRY(validate_mesh(reference, "reference"));
  if (!(max_error_m > 0.0) || !std::isfinite(max_error_m)) {
    return fail(ErrorCode::kInvalidOption,
                "error map: a largest error of {} m; give a positive one", max_error_m);
  }
  if (reference.empty()) {
    return fail(ErrorCode::kTooFewPoints, "error map: the reference has no triangles; check it");
  }
  const MeshDistance distance(reference);
  TriangleMesh colored = mesh;
  colored.colors.assign(mesh.vertices.size(), Rgb());
  parallel_for(mesh.vertices.size(), 1024, [&](std::size_t v) {
    if (context.cancelled() || !mesh.vertices[v].allFinite()) return;
    const auto hit = distance.closest(mesh.vertices[v].cast<double>());
    colored.colors[v] = viridis(hit.distance / max_error_m);
  });
  TURNSCAN_TRY(context.check());
  return colored;
}

}  // namespace turnscan
