#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/coverage/coverage_count.hpp>
#include <turnscan/simulator/noise/noise.hpp>

namespace turnscan::coverage {

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Predicted sigma of one scanner, tabulated over distance, incidence and albedo.
class SigmaTable {
 public:
  explicit SigmaTable(const ScannerModel& model)
      : near_(float(model.near_m)), scale_(float(kDistances / (model.far_m - model.near_m))) {
    const double scale = focal_baseline(model);
    values_.reserve(std::size_t(kDistances) * kAngles * CoveragePatches::kAlbedoSteps);
    for (int albedo = 0; albedo < CoveragePatches::kAlbedoSteps; ++albedo)
      for (int angle = 0; angle < kAngles; ++angle)
        for (int distance = 0; distance < kDistances; ++distance)
          values_.push_back(static_cast<float>(
              predicted_sigma_m(model.noise, scale, near_ + (distance + 0.5) / scale_,
                                std::acos((angle + 0.5) / kAngles),
                                double(albedo) / (CoveragePatches::kAlbedoSteps - 1))));
  }

  float at(float z, float cosine, std::uint8_t albedo) const {
    const int distance = std::clamp(int((z - near_) * scale_), 0, kDistances - 1);
    const int angle = std::clamp(int(cosine * kAngles), 0, kAngles - 1);
    return values_[(std::size_t(albedo) * kAngles + std::size_t(angle)) * kDistances +
                   std::size_t(distance)];
  }

 private:
  static constexpr int kDistances = 128, kAngles = 64;
  float near_, scale_;
  std::vector<float> values_;
};

/// Counts updated by several threads. Sums and extremes of integers do not depend on the order;
/// non-negative floats are ordered like their bits.
struct Counts {
  explicit Counts(const CoveragePatches& surface)
      : patch_samples(surface.patches.size()),
        samples(surface.cells.size()),
        views(surface.cells.size()),
        cosine(surface.cells.size()),
        sigma(surface.cells.size()) {
    const auto never = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
    for (auto& s : sigma) s.store(never, std::memory_order_relaxed);
  }
  using Numbers = std::vector<std::atomic<std::uint32_t>>;
  Numbers patch_samples, samples, views, cosine, sigma;
};

void add(std::atomic<std::uint32_t>& to, std::uint32_t n) {
  to.fetch_add(n, std::memory_order_relaxed);
}
void raise(std::atomic<std::uint32_t>& to, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  std::uint32_t now = to.load(std::memory_order_relaxed);
  while (bits > now && !to.compare_exchange_weak(now, bits, std::memory_order_relaxed)) {
  }
}
void lower(std::atomic<std::uint32_t>& to, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  std::uint32_t now = to.load(std::memory_order_relaxed);
  while (bits < now && !to.compare_exchange_weak(now, bits, std::memory_order_relaxed)) {
  }
}

/// Directions of the pixels of a scanner, (x, y, 1).
struct PixelRays {
  RayTable table;
  int width;
  explicit PixelRays(const CameraIntrinsics& camera) : table(camera), width(camera.width) {}
  Vec3f at(int column, int row) const {
    const std::size_t i = std::size_t(row) * std::size_t(width) + std::size_t(column);
    return {table.x()[i], table.y()[i], 1.0f};
  }
};

class SampleCounter {
 public:
  SampleCounter(const CoverageJob& job, const CoveragePatches& surface, Counts& counts)
      : job_(job), surface_(surface), counts_(counts) {}

  Result<> prepare() {
    for (const ScannerModel& model : job_.scanners) {
      TURNSCAN_ASSIGN(SampleTracer tracer, SampleTracer::create(model));
      tracers_.push_back(std::move(tracer));
      rays_.emplace_back(model.camera);
      sigmas_.emplace_back(model);
    }
    return {};
  }

  /// seen: per cell the last frame counted on this thread, plus one.
  void count(std::size_t pose, SampleGrid& grid, std::vector<std::uint32_t>& seen) const {
    const CoveragePose& at = job_.poses[pose];
    const CoveragePass& pass = job_.passes[at.pass];
    const std::array<Body, 2> bodies{
        {{pass.scene, Pose::Identity()}, {job_.room, at.T_table_room}}};
    tracers_[at.scanner].trace(std::span(bodies).first(job_.room != nullptr ? 2 : 1),
                               at.T_table_sensor, grid);
    const Pose T = at.pass == 0 ? at.T_table_sensor : pass.T_first_pass * at.T_table_sensor;
    const Eigen::Matrix3f turn = T.linear().cast<float>();
    const Vec3f origin = T.translation().cast<float>();
    for (int row = grid.rect.top; row < grid.rect.bottom; ++row) {
      for (int column = grid.rect.left; column < grid.rect.right; ++column) {
        const std::size_t i = grid.index(column, row);
        if (!grid.counts(i) || grid.body(i) != 0 || !surface_.has(grid.object(i), grid.triangle[i]))
          continue;
        const Vec3f way = turn * rays_[at.scanner].at(column, row);
        take(at.scanner, std::uint32_t(pose), grid, i, origin + grid.z[i] * way, way, seen);
      }
    }
  }

 private:
  void take(std::uint32_t scanner, std::uint32_t pose, const SampleGrid& grid, std::size_t i,
            const Vec3f& p, const Vec3f& way, std::vector<std::uint32_t>& seen) const {
    const std::uint32_t object = grid.object(i), triangle = grid.triangle[i];
    const float cosine = std::abs(surface_.normal(object, triangle).dot(way)) / way.norm();
    const float sigma =
        sigmas_[scanner].at(grid.z[i], cosine, surface_.albedo_step(object, triangle));
    if (job_.options.noise && !(sigma >= 0.0f)) return;
    const std::uint32_t patch = surface_.patch_at(object, triangle, p);
    const std::uint32_t cell = surface_.patches[patch].cell;
    add(counts_.patch_samples[patch], 1);
    add(counts_.samples[cell], 1);
    raise(counts_.cosine[cell], cosine);
    if (sigma >= 0.0f) lower(counts_.sigma[cell], sigma);
    if (seen[cell] == pose + 1) return;
    seen[cell] = pose + 1;
    add(counts_.views[cell], 1);
  }

  const CoverageJob& job_;
  const CoveragePatches& surface_;
  Counts& counts_;
  std::vector<SampleTracer> tracers_;
  std::vector<PixelRays> rays_;
  std::vector<SigmaTable> sigmas_;
};

void store(const Counts& counts, CoveragePatches& surface) {
  for (std::size_t p = 0; p < surface.patches.size(); ++p)
    surface.patches[p].samples = counts.patch_samples[p];
  for (std::size_t c = 0; c < surface.cells.size(); ++c) {
    CoverageCell& cell = surface.cells[c];
    cell.samples = counts.samples[c];
    cell.views = counts.views[c];
    const float cosine = std::bit_cast<float>(counts.cosine[c].load());
    const float sigma = std::bit_cast<float>(counts.sigma[c].load());
    cell.best_incidence_rad = cell.samples > 0 ? std::acos(std::min(1.0f, cosine)) : kTurn / 4;
    cell.best_sigma_m = std::isfinite(sigma) ? sigma : kNaN;
  }
}

}  // namespace

/// Runs of consecutive frames are distributed to the threads.
Result<std::uint64_t> count_samples(const CoverageJob& job, CoveragePatches& surface,
                                    const RunContext& context) {
  constexpr std::size_t kRuns = 64;
  Counts counts(surface);
  SampleCounter counter(job, surface, counts);
  TURNSCAN_TRY(counter.prepare());
  context.begin_phase("coverage", job.poses.size());
  parallel_for(kRuns, 1, [&](std::size_t run) {
    SampleGrid grid;
    std::vector<std::uint32_t> seen(surface.cells.size(), 0);
    const std::size_t n = job.poses.size();
    for (std::size_t i = run * n / kRuns; i < (run + 1) * n / kRuns; ++i) {
      if (context.cancelled()) return;
      counter.count(i, grid, seen);
      context.advance();
    }
  });
  TURNSCAN_TRY(context.check());
  store(counts, surface);
  std::uint64_t sum = 0;
  for (const CoverageCell& cell : surface.cells) sum += cell.samples;
  return sum;
}

}  // namespace turnscan::coverage
