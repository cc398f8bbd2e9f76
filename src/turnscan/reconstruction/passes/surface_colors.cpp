#include <turnscan/reconstruction/passes/surface_colors.hpp>

#include <cmath>
#include <limits>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>

namespace turnscan::passes {

namespace {

constexpr float kMinCosine = 0.3f;  // grazing rays mix adjacent surfaces
constexpr float kGamma = 2.2f;      // approximately that of sRGB
constexpr float kDark = 4.0f;       // of 255: below it the logarithm is dominated by noise
/// Shading affects lightness more than hue.
constexpr float kLightnessWeight = 0.5f;
constexpr std::size_t kHarmonics = 8, kPointsAtOnce = 1024;
constexpr double kMinSeen = 0.2;  // of the points

using Basis = Eigen::Matrix<double, kHarmonics, 1>;

/// Colour of a point in a view, with its normal rotated to the view.
struct Sighting {
  Vec3f color, normal_view;
};

Vec3f color_of(const Rgb& c) {
  const auto log_of = [](std::uint8_t v) { return kGamma * std::log((float(v) + kDark) / 255.0f); };
  const float r = log_of(c.r), g = log_of(c.g), b = log_of(c.b);
  return {kLightnessWeight * (r + g + b) / std::sqrt(3.0f), (r - g) / std::sqrt(2.0f),
          (r + g - 2.0f * b) / std::sqrt(6.0f)};
}

/// Spherical harmonics of degrees 1 and 2, without their factors.
Basis harmonics(const Vec3f& n) {
  const double x = n.x(), y = n.y(), z = n.z();
  Basis out;
  out << x, y, z, x * y, y * z, x * z, x * x - y * y, 3.0 * z * z - 1.0;
  return out;
}

class ColorsOfPass {
 public:
  ColorsOfPass(const PassSurface& surface, std::span<const views::DepthView> views)
      : surface_(surface), tolerance_(float(3.0 * surface.noise_m + 0.002)) {
    for (const views::DepthView& view : views)
      if (!view.colors.empty()) views_.push_back(&view);
  }

  Result<std::vector<Vec3f>> run(const RunContext& context) {
    if (views_.empty()) return std::vector<Vec3f>();
    const Eigen::Matrix<double, kHarmonics, 3> light = light_of_pass();
    const float nothing = std::numeric_limits<float>::quiet_NaN();
    std::vector<Vec3f> out(surface_.points.size(), Vec3f(nothing, nothing, nothing));
    TURNSCAN_TRY(parallel_for(out.size(), kPointsAtOnce, context, [&](std::size_t i) {
      const std::vector<Sighting> seen = sightings(i);
      if (seen.empty()) return;
      for (int c = 0; c < 3; ++c) {
        std::vector<float> values;
        for (const Sighting& s : seen)
          values.push_back(s.color[c] - float(harmonics(s.normal_view).dot(light.col(c))));
        out[i][c] = float(median(values));
      }
    }));
    std::size_t known = 0;
    for (const Vec3f& color : out) known += color.allFinite() ? 1 : 0;
    if (double(known) < kMinSeen * double(out.size())) out.clear();
    return out;
  }

 private:
  std::vector<Sighting> sightings(std::size_t i) const {
    std::vector<Sighting> out;
    for (const views::DepthView* view : views_) {
      const Vec3f p = view->rotation * surface_.points[i] + view->translation;
      const Vec3f n = view->rotation * surface_.normals[i];
      const Vec3f ray = view->parallel ? Vec3f(Vec3f::UnitZ()) : Vec3f(p.normalized());
      if (!(-n.dot(ray) > kMinCosine)) continue;
      const std::ptrdiff_t at = view->pixel_at(p);
      if (at < 0) continue;
      const std::uint32_t word = view->pixels[std::size_t(at)];
      if ((word & 0xffffu) == 0 || (word & views::DepthView::kEdge) != 0) continue;
      const float depth = float(word & 0xffffu) * view->unit_m + view->bias_m;
      if (!(std::abs(depth - p.z()) <= tolerance_)) continue;
      const Rgb& color = view->colors[std::size_t(at)];
      if (color == Rgb{}) continue;
      out.push_back({color_of(color), n});
    }
    return out;
  }

  struct Sums {
    Eigen::Matrix<double, kHarmonics, kHarmonics> matrix;
    Eigen::Matrix<double, kHarmonics, 3> vector;
    double count = 0.0;
    Sums() { matrix.setZero(), vector.setZero(); }
  };

  /// Estimates the light from the variation of each point while it turns, independent of its own
  /// colour.
  Eigen::Matrix<double, kHarmonics, 3> light_of_pass() const {
    const auto parts = parallel_chunks<Sums>(surface_.points.size(), kPointsAtOnce,
                                             [&](std::size_t begin, std::size_t end) {
                                               Sums sums;
                                               for (std::size_t i = begin; i < end; ++i)
                                                 add_changes(sightings(i), sums);
                                               return sums;
                                             });
    Sums all;
    for (const Sums& part : parts) {
      all.matrix += part.matrix;
      all.vector += part.vector;
      all.count += part.count;
    }
    // Sets unobserved coefficients to 0.
    all.matrix.diagonal().array() += 1e-3 * (all.count + 1.0);
    return estimation::solve_ldlt(all.matrix, all.vector);
  }

  static void add_changes(const std::vector<Sighting>& seen, Sums& sums) {
    if (seen.size() < 3) return;
    Basis mean = Basis::Zero();
    Vec3f mean_color = Vec3f::Zero();
    for (const Sighting& s : seen) {
      mean += harmonics(s.normal_view) / double(seen.size());
      mean_color += s.color / float(seen.size());
    }
    for (const Sighting& s : seen) {
      const Basis change = harmonics(s.normal_view) - mean;
      sums.matrix += change * change.transpose();
      sums.vector += change * (s.color - mean_color).cast<double>().transpose();
      sums.count += 1.0;
    }
  }

  const PassSurface& surface_;
  float tolerance_;
  std::vector<const views::DepthView*> views_;
};

}  // namespace

Result<std::vector<Vec3f>> surface_colors(const PassSurface& surface,
                                          std::span<const views::DepthView> views,
                                          const RunContext& context) {
  return ColorsOfPass(surface, views).run(context);
}

}  // namespace turnscan::passes
