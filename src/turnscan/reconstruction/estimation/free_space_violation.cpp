#include <algorithm>
#include <cmath>
#include <optional>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/reconstruction/estimation/free_space_violation.hpp>

namespace turnscan::estimation {

namespace {

constexpr std::size_t kMaxWitnesses = 64;  // number of views used
constexpr std::size_t kPlaces = 3000, kMinPlaces = 100;
constexpr int kMinNear = 5;    // views that measured a point
constexpr double kNear = 3.0;  // times the noise: a depth this close to a point belongs to it
constexpr double kStep = 0.5;  // pixels
constexpr int kMaxSteps = 12;
/// Free space seen by fewer views than this share of those that measured a point is outvoted
/// anyway.
constexpr double kContested = 0.2;
constexpr double kShareOfPlaces = 0.98;

/// Observation of a point by a view: how much deeper its pixel measured, and observed free space.
struct Testimony {
  std::optional<float> measured, free;
};

Testimony ask(const views::DepthView& view, const Vec3f& p) {
  const Vec3f p_view = view.rotation * p + view.translation;
  const std::ptrdiff_t at = view.pixel_at(p_view);
  if (at < 0) return {};
  const std::uint32_t word = view.pixels[std::size_t(at)];
  const auto deeper = [&](std::uint32_t raw) -> std::optional<float> {
    if (raw == 0) return std::nullopt;
    return float(raw) * view.unit_m + view.bias_m - p_view.z();
  };
  const bool edge = (word & views::DepthView::kEdge) != 0;
  return {edge ? std::nullopt : deeper(word & 0xffffu), deeper(word >> 17 << 1)};
}

using Witnesses = std::vector<const views::DepthView*>;

/// Inward direction of the surface at p, as the views that measured it face it; nullopt if there
/// are too few.
struct Facing {
  Vec3f inward;
  int views;
};
std::optional<Facing> facing(const Witnesses& views, const Vec3f& p, float reach) {
  int near = 0;
  Vec3d outward = Vec3d::Zero();
  for (const views::DepthView* view : views) {
    const Testimony t = ask(*view, p);
    if (!t.measured || std::abs(*t.measured) > reach) continue;
    ++near;
    outward += view->viewpoint().direction_from(p.cast<double>());
  }
  if (near < kMinNear) return std::nullopt;
  return Facing{-outward.normalized().cast<float>(), near};
}

/// Distance behind p up to which all points are contested; nullopt if more views see past p than
/// measured it: static surface beside the table turns with it into space that all others see to be
/// free.
std::optional<double> contested_depth(const Witnesses& views, const Vec3f& p, const Facing& facing,
                                      float reach, double step_m) {
  const auto views_past = [&](const Vec3f& q) {
    return std::count_if(views.begin(), views.end(), [&](const views::DepthView* view) {
      const Testimony t = ask(*view, q);
      return t.free && *t.free > reach;
    });
  };
  if (views_past(p) > facing.views) return std::nullopt;
  int step = 0;
  for (; step < kMaxSteps; ++step) {
    const Vec3f q = p + float((step + 1) * step_m) * facing.inward;
    if (double(views_past(q)) < kContested * facing.views) break;
  }
  return step * step_m;
}

}  // namespace

double free_space_violation(std::span<const views::DepthView> views, std::span<const Vec3f> points,
                            double noise_m, double spacing_m) {
  if (points.empty()) return 0.0;
  Witnesses witnesses;
  for (const std::size_t i : evenly_spread(views.size(), kMaxWitnesses))
    witnesses.push_back(&views[i]);
  const auto reach = float(kNear * noise_m);
  std::vector<double> depths(kPlaces, -1.0);
  parallel_for(kPlaces, 16, [&](std::size_t i) {
    const Vec3f& p = points[mix64(i) % points.size()];
    if (const auto faced = facing(witnesses, p, reach))
      depths[i] = contested_depth(witnesses, p, *faced, reach, kStep * spacing_m).value_or(-1.0);
  });
  std::erase(depths, -1.0);
  if (depths.size() < kMinPlaces) return 0.0;
  const auto at = depths.begin() + std::ptrdiff_t(kShareOfPlaces * double(depths.size() - 1));
  std::nth_element(depths.begin(), at, depths.end());
  return *at;
}

}  // namespace turnscan::estimation
