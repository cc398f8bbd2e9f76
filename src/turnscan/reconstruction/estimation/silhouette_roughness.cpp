#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/estimation/silhouette_roughness.hpp>
#include <turnscan/reconstruction/views/view_drawing.hpp>

namespace turnscan::estimation {

namespace {

constexpr std::size_t kMaxOutlines = 24;       // views for which a mesh is rendered
constexpr std::size_t kMinOutside = 300;       // pixels required for a share
constexpr double kAlike = 2.5, kBehind = 7.5;  // of the noise, from the surface beside a pixel

struct Outside {
  std::size_t pixels = 0, with_surface = 0;
};

Outside outside_outlines(const views::DepthView& view, const TriangleMesh& mesh, double noise_m) {
  constexpr std::array<std::array<int, 2>, 4> kNeighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const views::ViewDrawing drawing(view, mesh);
  Outside out;
  for (int y = 1; y + 1 < view.height; ++y)
    for (int x = 1; x + 1 < view.width; ++x) {
      if (drawing.received(x, y).light > 0.0f) continue;
      const std::uint32_t raw =
          view.pixels[std::size_t(y) * std::size_t(view.width) + std::size_t(x)] & 0xffffu;
      const float measured = float(raw) * view.unit_m + view.bias_m;
      std::optional<float> behind;  // the adjacent surface that is closest to its measurement
      for (const auto& [dx, dy] : kNeighbours) {
        const auto drawn = drawing.received(x + dx, y + dy);
        if (!(drawn.light > 0.0f)) continue;
        const float off = measured - drawn.mean();
        if (!behind || std::abs(off) < std::abs(*behind)) behind = off;
      }
      if (!behind) continue;
      ++out.pixels;
      if (raw != 0 && *behind > float(-kAlike * noise_m) && *behind < float(kBehind * noise_m))
        ++out.with_surface;
    }
  return out;
}

}  // namespace

double ragged_share(std::span<const views::DepthView> views, const TriangleMesh& mesh,
                    double noise_m) {
  std::vector<Outside> each(views::views_for_statistics(views, kMaxOutlines));
  parallel_for(each.size(), 1, [&](std::size_t i) {
    each[i] = outside_outlines(views[i * views.size() / each.size()], mesh, noise_m);
  });
  Outside all;
  for (const Outside& one : each) {
    all.pixels += one.pixels;
    all.with_surface += one.with_surface;
  }
  return all.pixels < kMinOutside ? 0.0 : double(all.with_surface) / double(all.pixels);
}

}  // namespace turnscan::estimation
