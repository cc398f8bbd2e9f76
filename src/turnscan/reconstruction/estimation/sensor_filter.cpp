#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/estimation/sensor_filter.hpp>
#include <turnscan/reconstruction/views/view_drawing.hpp>

namespace turnscan::estimation {

namespace {

/// Differences over this many pixels are not affected by a filter over three.
constexpr int kApart = 3;
constexpr std::size_t kMin = 2000;  // differences required for an estimate
/// Maximum ratio of the differences to the noise, half of which a filter hides; beyond it they show
/// the rotation of the surface.
constexpr double kNoiseSlack = 3.0;
/// Smaller shares have no relevant effect on edges.
constexpr double kMinShare = 0.1;
/// Maximum misfit of the ratios of variances, relative to a mesh: errors of the mesh fit no filter.
constexpr double kMaxMiss = 0.12;
constexpr std::size_t kMaxDrawn = 24;  // views for which a mesh is rendered
/// In units of the noise: points farther from the mesh are not on its surface.
constexpr double kFarthestOff = 8.0;

/// Absolute second differences over 1, 2 and 3 pixels along the rows of the difference of two
/// images.
struct Differences {
  std::array<std::vector<double>, kApart> over;
  void append(const Differences& other) {
    for (std::size_t n = 0; n < over.size(); ++n)
      over[n].insert(over[n].end(), other.over[n].begin(), other.over[n].end());
  }
};

/// Whether they are less than 1.5 degrees apart, like successive frames of a turning platter.
bool nearly_same_place(const views::DepthView& a, const views::DepthView& b) {
  const float cosine = 0.5f * ((a.rotation * b.rotation.transpose()).trace() - 1.0f);
  return cosine > 0.99966f && (a.translation - b.translation).norm() < 0.02f && a.fx == b.fx &&
         a.fy == b.fy && a.unit_m == b.unit_m && !a.parallel && !b.parallel;
}

using Row = std::vector<std::optional<float>>;

void append_row(const Row& row, Differences& out) {
  for (std::size_t x = kApart; x + kApart < row.size(); ++x) {
    const auto around = row.begin() + std::ptrdiff_t(x);
    if (!std::all_of(around - kApart, around + kApart + 1,
                     [](const auto& d) { return d.has_value(); }))
      continue;
    for (std::size_t n = 1; n <= kApart; ++n)
      out.over[n - 1].push_back(std::abs(*row[x - n] - 2.0f * *row[x] + *row[x + n]));
  }
}

/// 0 outside the image, and if nothing was measured.
std::uint32_t pixel_at(const views::DepthView& view, int x, int y) {
  return x < 0 || y < 0 || x >= view.width || y >= view.height
             ? 0u
             : view.pixels[std::size_t(y) * std::size_t(view.width) + std::size_t(x)];
}

bool measured_off_edges(std::uint32_t pixel) {
  return (pixel & 0xffffu) != 0 && (pixel & views::DepthView::kEdge) == 0;
}

Differences differences(const views::DepthView& a, const views::DepthView& b) {
  Differences out;
  const int du = int(std::lround(b.cx - a.cx)), dv = int(std::lround(b.cy - a.cy));
  Row row(std::size_t(a.width));
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const std::uint32_t p = pixel_at(a, x, y), q = pixel_at(b, x + du, y + dv);
      row[std::size_t(x)] = measured_off_edges(p) && measured_off_edges(q)
                                ? std::optional(float(p & 0xffffu) - float(q & 0xffffu))
                                : std::nullopt;
    }
    append_row(row, out);
  }
  return out;
}

/// Differences between a view and the mesh rendered from it, in units of the view.
Differences differences(const views::DepthView& view, const TriangleMesh& mesh, double noise_m) {
  Differences out;
  const views::ViewDrawing drawing(view, mesh);
  const float most = float(kFarthestOff * noise_m) / view.unit_m;
  Row row(std::size_t(view.width));
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      row[std::size_t(x)].reset();
      const std::uint32_t p = pixel_at(view, x, y);
      if (!measured_off_edges(p)) continue;
      const auto drawn = drawing.received(x, y);
      if (!(drawn.light > 0.0f)) continue;
      const float off = float(p & 0xffffu) - (drawn.mean() - view.bias_m) / view.unit_m;
      if (std::abs(off) < most) row[std::size_t(x)] = off;
    }
    append_row(row, out);
  }
  return out;
}

/// Standard deviation of normal errors, from their absolute values; the largest tenth may be
/// outliers.
double spread(std::vector<double>& values) {
  const auto most = values.begin() + std::ptrdiff_t(9 * values.size() / 10);
  std::nth_element(values.begin(), most, values.end());
  return std::accumulate(values.begin(), most, 0.0) / double(most - values.begin()) / 0.6573;
}

/// Covariances of a filtered row at distances of 0, 1 and 2 pixels, for independent noise of
/// variance 1.
std::array<double, 3> covariances(double share) {
  const double own = 1.0 - 2.0 * share;
  return {own * own + 2.0 * share * share, 2.0 * share * own, share * share};
}

/// Variance of second differences over 1 or 2 pixels, relative to that of independent noise, which
/// pixels 3 apart have.
std::array<double, 2> expected_of_second(double share) {
  const auto [none, one, two] = covariances(share);
  return {1.0 - (8.0 * one - 2.0 * two) / (6.0 * none), 1.0 - 8.0 * two / (6.0 * none)};
}

/// The share whose ratios are closest to those of the differences; 0 if every share misses them by
/// more than most_miss. variances: of a difference of independent values. nullopt if there are too
/// few, or if they are due to rounding or the surface.
std::optional<double> share_from(Differences& all, double variances, double most_miss,
                                 double unit_m, double noise_m) {
  if (all.over[0].size() < kMin) return std::nullopt;
  std::array<double, kApart> deviation{};
  for (std::size_t n = 0; n < deviation.size(); ++n)
    deviation[n] = spread(all.over[n]) * unit_m / std::sqrt(variances);
  // Less than a unit is mostly rounding.
  if (!(deviation[2] > unit_m) || deviation[2] > kNoiseSlack * noise_m) return std::nullopt;
  const double one = std::pow(deviation[0] / deviation[2], 2),
               two = std::pow(deviation[1] / deviation[2], 2);
  double best = 0.0, least = 1e30;
  for (int step = 0; step <= 100; ++step) {
    const double share = step / 300.0;
    const auto [first, second] = expected_of_second(share);
    const double miss = std::hypot(one - first, two - second);
    if (miss < least) least = miss, best = share;
  }
  return best < kMinShare || least > most_miss ? 0.0 : best;
}

Differences joined(const std::vector<Differences>& parts) {
  Differences all;
  for (const Differences& one : parts) all.append(one);
  return all;
}

}  // namespace

std::optional<double> share_of_neighbours(std::span<const views::DepthView> views, double noise_m) {
  if (views.empty()) return std::nullopt;
  std::vector<Differences> own(views::views_for_statistics(views, views.size() - 1));
  parallel_for(own.size(), 1, [&](std::size_t i) {
    const std::size_t v = i * (views.size() - 1) / own.size();
    if (nearly_same_place(views[v], views[v + 1])) own[i] = differences(views[v], views[v + 1]);
  });
  Differences all = joined(own);
  return share_from(all, 12.0, 1e30, double(views[0].unit_m), noise_m);
}

double share_of_neighbours(std::span<const views::DepthView> views, const TriangleMesh& mesh,
                           double noise_m) {
  if (views.empty()) return 0.0;
  const float unit_m = views[0].unit_m;
  std::vector<Differences> own(views::views_for_statistics(views, kMaxDrawn));
  parallel_for(own.size(), 1, [&](std::size_t i) {
    const views::DepthView& view = views[i * views.size() / own.size()];
    if (!view.parallel && view.unit_m == unit_m) own[i] = differences(view, mesh, noise_m);
  });
  Differences all = joined(own);
  return share_from(all, 6.0, kMaxMiss, double(unit_m), noise_m).value_or(0.0);
}

}  // namespace turnscan::estimation
