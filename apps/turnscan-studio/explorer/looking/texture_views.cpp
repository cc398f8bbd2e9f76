#include "explorer/looking/texture_views.hpp"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/evaluation/colormap.hpp>

namespace turnscan::studio {

namespace {

constexpr Rgb kNoViewColor{150, 150, 150};
constexpr std::size_t kMaxListed = 18;  // lines of the legend that fit into a small window

/// Degrees about the mesh's vertical axis, 0 to 360.
double azimuth_deg(const Vec3f& eye, const Vec3d& center) {
  const Vec3d from = eye.cast<double>() - center;
  const double angle = std::atan2(from.x(), from.z()) * 180.0 / std::numbers::pi;
  return angle < 0.0 ? angle + 360.0 : angle;
}

/// Indices of the views, sorted by direction around the mesh.
std::vector<std::size_t> around(const TextureReport& report, const Vec3d& center) {
  std::vector<std::size_t> order(report.used.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return azimuth_deg(report.used[a].eye, center) < azimuth_deg(report.used[b].eye, center);
  });
  return order;
}

/// Neighbouring views differ strongly in lightness, which everyone can distinguish.
std::vector<Rgb> colors_of(const std::vector<std::size_t>& order) {
  const std::size_t n = order.size();
  std::size_t stride = std::max<std::size_t>(1, std::size_t(0.382 * double(n)));
  while (stride < n && std::gcd(stride, n) != 1) ++stride;
  std::vector<Rgb> out(n);
  for (std::size_t k = 0; k < n; ++k)
    out[order[k]] = viridis(n > 1 ? double(k * stride % n) / double(n - 1) : 0.5);
  return out;
}

}  // namespace

ColoredMesh color_by_view(const TriangleMesh& mesh, const TextureReport& report) {
  if (!has_texture(mesh) || report.view_of_square.empty()) return {};
  const Vec3d center = bounds(mesh.vertices).center();
  const std::vector<std::size_t> order = around(report, center);
  const std::vector<Rgb> colors = colors_of(order);
  auto texture = std::make_shared<MeshTexture>();
  texture->corners = mesh.texture->corners;
  const auto& squares = report.view_of_square;
  texture->image = ColorImage(squares.width, squares.height, kNoViewColor);
  std::vector<std::size_t> count(report.used.size());
  std::size_t all = 0;
  for (std::size_t i = 0; i < squares.pixels.size(); ++i) {
    const std::uint16_t view = squares.pixels[i];
    if (view >= colors.size()) continue;
    texture->image.pixels[i] = colors[view];
    ++count[view];
    ++all;
  }
  std::vector<std::size_t> listed = order;
  std::erase_if(listed, [&](std::size_t v) { return count[v] == 0; });
  if (listed.size() > kMaxListed) {
    std::vector<std::size_t> largest = listed;
    std::nth_element(largest.begin(), largest.begin() + kMaxListed, largest.end(),
                     [&](std::size_t a, std::size_t b) { return count[a] > count[b]; });
    const std::size_t least = count[largest[kMaxListed]];
    std::erase_if(listed, [&](std::size_t v) { return count[v] <= least; });
  }
  ColoredMesh out;
  out.legend.title = QObject::tr("View of each place");
  for (const std::size_t v : listed)
    out.legend.entries.push_back(
        {to_color(colors[v]),
         QObject::tr("frame %1, from %2°: %3 %")
             .arg(report.used[v].frame)
             .arg(azimuth_deg(report.used[v].eye, center), 0, 'f', 0)
             .arg(100.0 * double(count[v]) / double(std::max<std::size_t>(all, 1)), 0, 'f', 0)});
  out.legend.entries.push_back(
      {to_color(kNoViewColor),
       QObject::tr("no view, filled: %1 %").arg(100.0 * report.filled_share, 0, 'f', 0)});
  TriangleMesh drawn = mesh;
  drawn.texture = std::move(texture);
  out.drawable = make_drawable(drawn, Shading::kSmooth, Texels::kSquares);
  return out;
}

}  // namespace turnscan::studio
