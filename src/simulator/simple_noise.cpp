#include <algorithm>
#include <limits>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/simple_noise.hpp>

namespace turnscan {

namespace {

// Independent random numbers of one pixel; the noise takes the pixel's key itself.
constexpr std::uint64_t kChoiceSalt = 0x6d69786564ULL;
constexpr std::uint64_t kReachSalt = 0x7265616368ULL;

/// How far behind the pixel the deepest of its neighbours lies, 0 if it is no silhouette pixel.
double silhouette_step(const SampleGrid& grid, int column, int row, double step_m) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const std::size_t here = grid.index(column, row);
  const bool on_platter = grid.object(here) == kPlatter;
  double step = 0.0;
  const auto look = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= grid.width || y >= grid.height) return;
    if (!grid.contains(x, y) || !grid.hit(grid.index(x, y))) {
      step = kEndless;
      return;
    }
    const std::size_t there = grid.index(x, y);
    if (on_platter && grid.object(there) == kPlatter) return;
    const double behind = double(grid.z[there]) - double(grid.z[here]);
    if (behind > step_m) step = std::max(step, behind);
  };
  look(column - 1, row);
  look(column + 1, row);
  look(column, row - 1);
  look(column, row + 1);
  return step;
}

}  // namespace

void measure_simply(const SampleGrid& exact, const NoiseOptions& options, double step_m,
                    std::uint64_t seed, std::uint32_t scanner, std::uint32_t frame,
                    std::vector<float>& measured) {
  measured.assign(exact.size(), 0.0f);
  for (int y = exact.rect.top; y < exact.rect.bottom; ++y) {
    for (int x = exact.rect.left; x < exact.rect.right; ++x) {
      const std::size_t i = exact.index(x, y);
      if (!exact.counts(i)) continue;
      const std::uint64_t pixel = std::uint64_t(y) * std::uint64_t(exact.width) + std::uint64_t(x);
      const std::uint64_t key = hash_key(seed, scanner, frame, pixel);
      double z = exact.z[i];
      if (options.mixed_pixels > 0.0) {
        const double step = silhouette_step(exact, x, y, step_m);
        if (step > 0.0 && uniform01(mix64(key ^ kChoiceSalt)) < options.mixed_pixels)
          z += uniform01(mix64(key ^ kReachSalt)) * std::min(options.mixed_reach_m, step);
      }
      if (options.sigma_m > 0.0) z += options.sigma_m * standard_normal(key);
      measured[i] = static_cast<float>(z);
    }
  }
}

}  // namespace turnscan
