#include <algorithm>
#include <cmath>
#include <numeric>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/estimation/sensor_filter.hpp>

namespace turnscan::estimation {

namespace {

/// Differences over this many pixels are free of a filter over three.
constexpr int kApart = 3;
constexpr std::size_t kFewest = 2000;  // differences that an estimate needs
/// What the differences may exceed the noise by, which a filter hides half of, before they show how
/// the surface turned.
constexpr double kNoiseSlack = 3.0;
/// Below, what neighbours have in common moves no edge that matters.
constexpr double kLeastShare = 0.1;
/// Of the ratios of variances, within one view: what a surface that bends adds fits no filter.
constexpr double kMostMiss = 0.08;

/// Absolute differences over 1, 2 and 3 pixels along rows: second ones of the difference of two
/// views, or third ones of one view.
struct Differences {
  std::array<std::vector<double>, kApart> over;
  void append(const Differences& other) {
    for (std::size_t n = 0; n < over.size(); ++n)
      over[n].insert(over[n].end(), other.over[n].begin(), other.over[n].end());
  }
};

/// Turned by less than 1.5 degrees, as a platter turns from frame to frame.
bool nearly_same_place(const views::DepthView& a, const views::DepthView& b) {
  const float cosine = 0.5f * ((a.rotation * b.rotation.transpose()).trace() - 1.0f);
  return cosine > 0.99966f && (a.translation - b.translation).norm() < 0.02f && a.fx == b.fx &&
         a.fy == b.fy && a.unit_m == b.unit_m && !a.parallel && !b.parallel;
}

Differences differences(const views::DepthView& a, const views::DepthView& b) {
  Differences out;
  const int du = int(std::lround(b.cx - a.cx)), dv = int(std::lround(b.cy - a.cy));
  const auto at = [](const views::DepthView& view, int x, int y) {
    return x < 0 || y < 0 || x >= view.width || y >= view.height
               ? 0u
               : view.pixels[std::size_t(y) * std::size_t(view.width) + std::size_t(x)];
  };
  std::vector<std::optional<int>> row(std::size_t(a.width));
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const std::uint32_t p = at(a, x, y), q = at(b, x + du, y + dv);
      const bool good =
          (p & 0xffffu) != 0 && (q & 0xffffu) != 0 && ((p | q) & views::DepthView::kEdge) == 0;
      row[std::size_t(x)] =
          good ? std::optional(int(p & 0xffffu) - int(q & 0xffffu)) : std::nullopt;
    }
    for (std::size_t x = kApart; x + kApart < row.size(); ++x) {
      const auto around = row.begin() + std::ptrdiff_t(x);
      if (!std::all_of(around - kApart, around + kApart + 1,
                       [](const auto& d) { return d.has_value(); }))
        continue;
      for (std::size_t n = 1; n <= kApart; ++n)
        out.over[n - 1].push_back(std::abs(*row[x - n] - 2 * *row[x] + *row[x + n]));
    }
  }
  return out;
}

/// Third differences, which smooth surfaces hardly have.
Differences differences(const views::DepthView& view) {
  Differences out;
  constexpr int kReach = 3 * kApart;
  for (int y = 0; y < view.height; ++y) {
    const auto row = view.pixels.begin() + std::ptrdiff_t(y) * view.width;
    for (int x = 0; x + kReach < view.width; ++x) {
      if (!std::all_of(row + x, row + x + kReach + 1, [](std::uint32_t p) {
            return (p & 0xffffu) != 0 && (p & views::DepthView::kEdge) == 0;
          }))
        continue;
      for (int n = 1; n <= kApart; ++n) {
        const auto at = [&](int k) { return int(row[x + k * n] & 0xffffu); };
        out.over[std::size_t(n - 1)].push_back(std::abs(at(3) - 3 * at(2) + 3 * at(1) - at(0)));
      }
    }
  }
  return out;
}

/// Standard deviation of normal errors, from their absolute values; the largest tenth may be
/// strays.
double spread(std::vector<double>& values) {
  const auto most = values.begin() + std::ptrdiff_t(9 * values.size() / 10);
  std::nth_element(values.begin(), most, values.end());
  return std::accumulate(values.begin(), most, 0.0) / double(most - values.begin()) / 0.6573;
}

/// Covariances of a filtered row at 0, 1 and 2 pixels' distance, of independent noise of
/// variance 1.
std::array<double, 3> covariances(double share) {
  const double own = 1.0 - 2.0 * share;
  return {own * own + 2.0 * share * share, 2.0 * share * own, share * share};
}

/// Variance of second differences over 1 or 2 pixels, over that of independent noise, which pixels
/// that lie 3 apart have.
std::array<double, 2> expected_of_second(double share) {
  const auto [none, one, two] = covariances(share);
  return {1.0 - (8.0 * one - 2.0 * two) / (6.0 * none), 1.0 - 8.0 * two / (6.0 * none)};
}

/// The same of third differences.
std::array<double, 2> expected_of_third(double share) {
  const auto [none, one, two] = covariances(share);
  return {1.0 - (30.0 * one - 12.0 * two) / (20.0 * none), 1.0 - 30.0 * two / (20.0 * none)};
}

/// The share whose ratios are nearest to those of the differences. variances: of a difference of
/// independent values. 0 where there are too few, where rounding or the surface makes them, or
/// where no share misses the ratios by less than most_miss.
double share_from(Differences& all, double variances, std::array<double, 2> (*expected)(double),
                  double most_miss, double unit_m, double noise_m) {
  if (all.over[0].size() < kFewest) return 0.0;
  std::array<double, kApart> deviation{};
  for (std::size_t n = 0; n < deviation.size(); ++n)
    deviation[n] = spread(all.over[n]) * unit_m / std::sqrt(variances);
  // Less than a unit is mostly rounding.
  if (!(deviation[2] > unit_m) || deviation[2] > kNoiseSlack * noise_m) return 0.0;
  const double one = std::pow(deviation[0] / deviation[2], 2),
               two = std::pow(deviation[1] / deviation[2], 2);
  double best = 0.0, least = 1e30;
  for (int step = 0; step <= 100; ++step) {
    const double share = step / 300.0;
    const auto [first, second] = expected(share);
    const double miss = std::hypot(one - first, two - second);
    if (miss < least) least = miss, best = share;
  }
  return best < kLeastShare || least > most_miss ? 0.0 : best;
}

}  // namespace

double share_of_neighbours(std::span<const views::DepthView> views, double noise_m) {
  if (views.empty()) return 0.0;
  const double unit_m = double(views[0].unit_m);
  std::vector<Differences> own(views.size());
  parallel_for(own.size() - 1, 1, [&](std::size_t v) {
    if (nearly_same_place(views[v], views[v + 1])) own[v] = differences(views[v], views[v + 1]);
  });
  const auto joined = [&] {
    Differences all;
    for (const Differences& one : own) all.append(one);
    return all;
  };
  Differences between = joined();
  if (between.over[0].size() >= kFewest)
    return share_from(between, 12.0, expected_of_second, 1e30, unit_m, noise_m);
  // Few frames a turn: no two from nearly the same place.
  parallel_for(own.size(), 1, [&](std::size_t v) {
    if (!views[v].parallel && views[v].unit_m == views[0].unit_m) own[v] = differences(views[v]);
  });
  Differences within = joined();
  return share_from(within, 20.0, expected_of_third, kMostMiss, unit_m, noise_m);
}

}  // namespace turnscan::estimation
