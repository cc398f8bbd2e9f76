#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/vertex_observations.hpp>

namespace turnscan::mesh_refinement {

namespace {

/// Each iteration uses twice as many views as the previous one, but at least this many.
constexpr std::size_t kMinFitViews = 128;
/// Maximum ratio of the local scatter to the noise; dark or oblique surface is noisier.
constexpr float kMaxSpread = 4.0f;
/// Ratio of scatter to noise above which it counts as larger: outliers cause some, too.
constexpr float kUsualSpread = 1.2f;
/// Rims scatter, too, because of adjacent surfaces, but they are narrow: noisy surface is wider
/// than twice this many rings of neighbours.
constexpr int kRimRings = 6;
/// Fewer views do not determine the scatter of measurements.
constexpr std::size_t kMinViewsForSpread = 24;
/// Views within this angle may err alike.
constexpr double kAlike_rad = 30.0 * kRadiansPerDegree;
constexpr std::size_t kGroups = 4;
/// The three ways of dividing four groups into halves.
constexpr std::array<std::array<float, kGroups>, 3> kHalves{
    {{1, 1, -1, -1}, {1, -1, 1, -1}, {1, -1, -1, 1}}};
/// Median of the root of a mean of three squares of standard normal values.
constexpr double kMedianOfThree = 0.888;
/// Noise that three iterations leave over that of the last one alone, since each spares the bends
/// that the ones before it left: halves of the views fitted by themselves differ by 1.2 to 1.5
/// times more (eight simulated scans).
constexpr double kIterated = 1.3;

/// Ratio of the scatter of measurements to the noise, from the share within kNear of its standard
/// deviations: for normal errors that is erf(kNear / (sqrt(2) times)).
float times_the_noise(float share) {
  float low = 1.0f, high = kMaxSpread * kUsualSpread;
  for (int round = 0; round < 12; ++round) {
    const float middle = 0.5f * (low + high);
    (std::erf(kNear / (1.4142136f * middle)) > share ? low : high) = middle;
  }
  return low;
}

class MeshFitter {
 public:
  MeshFitter(const TriangleMesh& mesh, std::span<const views::DepthView> views,
             const MeshFitScale& scale)
      : views_(views), scale_(scale), neighbours_(mesh), observer_(mesh) {
    fit_.mesh = mesh;
  }

  Result<MeshFit> run(const RunContext& context) {
    const std::size_t n = fit_.mesh.vertices.size();
    const bool estimates_spread = scale_.iterations > 0 && views_.size() >= kMinViewsForSpread;
    const int rounds = std::max(1, scale_.iterations), extra = estimates_spread ? 1 : 0;
    const ViewGroups groups = scale_.iterations > 0 ? independent_groups() : ViewGroups{every(1)};
    context.begin_phase("fit",
                        observer_.blocks() * (std::size_t(rounds + extra) + groups.size() - 1));
    spread_.assign(n, 1.0f);
    if (estimates_spread) {
      std::fill(spread_.begin(), spread_.end(), kMaxSpread * kMaxSpread);
      update_vertices(0);
      TURNSCAN_TRY(measure({every(view_stride(rounds - 1))}, context));
      estimate_spread();
    }
    for (int iteration = 0; iteration < rounds; ++iteration) {
      update_vertices(iteration);
      const int to_go = rounds - 1 - iteration;
      TURNSCAN_TRY(measure(to_go > 0 ? ViewGroups{every(view_stride(to_go))} : groups, context));
      discard_platter();
      if (scale_.iterations > 0) move(to_go == 0);
      if (scale_.iterations > 0 && iteration == 0 && scale_.fair_m > 0.0)
        fair(fit_.mesh, neighbours_, measured_.support, scale_);
    }
    if (scale_.iterations > 0 && scale_.floor_height_m)
      straighten_walls(fit_.mesh, neighbours_, measured_.support, scale_);
    fit_.support = std::move(measured_.support);
    return std::move(fit_);
  }

 private:
  /// Stride of the views used when this many iterations remain.
  std::size_t view_stride(int to_go) const {
    std::size_t stride = 1;
    for (; to_go > 0 && views_.size() / (2 * stride) >= kMinFitViews; --to_go) stride *= 2;
    return stride;
  }

  /// Updates positions and smoothed normals.
  void update_vertices(int iteration) {
    const std::size_t n = fit_.mesh.vertices.size();
    normals_ = vertex_normals(fit_.mesh);
    for (int round = 0; round < (iteration == 0 ? 3 : 2); ++round) {
      std::vector<Vec3f> next(n);
      parallel_for(n, 4096, [&](std::size_t v) {
        const Vec3f sum = normals_[v] + neighbours_.mean(normals_, v, Vec3f(Vec3f::Zero()));
        next[v] = sum.norm() > 1e-3f ? Vec3f(sum.normalized()) : normals_[v];
      });
      normals_.swap(next);
    }
    observer_.set_vertices(fit_.mesh.vertices, normals_, spread_);
  }

  /// Estimates the ratio of scatter to noise, including the neighbours' measurements.
  void estimate_spread() {
    parallel_for(spread_.size(), 1024, [&](std::size_t v) {
      const float count = neighbours_.count(v);
      const float all = measured_.support[v] + count * neighbours_.mean(measured_.support, v, 0.0f);
      const float near = near_[v] + count * neighbours_.mean(near_, v, 0.0f);
      const float times = times_the_noise(all > 1e-3f ? near / all : 1.0f) / kUsualSpread;
      const float spread = std::clamp(times, 1.0f, kMaxSpread);
      spread_[v] = spread * spread;
    });
    spread_ = neighbours_.least(std::move(spread_), kRimRings);
    spread_ = neighbours_.largest(std::move(spread_), kRimRings);
  }

  using ViewGroups = std::vector<std::vector<std::size_t>>;

  std::vector<std::size_t> every(std::size_t stride) const {
    return evenly_spread(views_.size(), (views_.size() + stride - 1) / stride);
  }

  /// All views by their direction about the middle of the mesh, in turn: those within 30 degrees,
  /// which may err alike, are of one group.
  ViewGroups independent_groups() const {
    const Vec3d middle = bounds(fit_.mesh.vertices).center();
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const Vec3d to = views_[i].viewpoint().direction_from(middle);
      order.emplace_back(std::atan2(to.z(), to.x()), i);
    }
    std::sort(order.begin(), order.end());
    ViewGroups out(kGroups);
    std::size_t group = 0;
    double begin = order.empty() ? 0.0 : order.front().first;
    for (const auto& [direction, view] : order) {
      if (direction - begin >= kAlike_rad) begin = direction, ++group;
      out[group % kGroups].push_back(view);
    }
    return out;
  }

  Result<> measure(const ViewGroups& groups, const RunContext& context) {
    const std::size_t n = fit_.mesh.vertices.size();
    measured_ = {std::vector<float>(n, 0.0f), std::vector<float>(n, 0.0f)};
    near_.assign(n, 0.0f);
    of_groups_.clear();
    for (const auto& group : groups) {
      TURNSCAN_ASSIGN(VertexObservations found, observer_.observe(views_, group, scale_, context));
      parallel_for(n, 4096, [&](std::size_t v) {
        measured_.support[v] += found.measured.support[v];
        measured_.offset[v] += found.measured.offset[v];
        near_[v] += found.near[v];
      });
      of_groups_.push_back(std::move(found.measured));
    }
    return {};
  }

  /// Measurements in the lower half of the margin may be of the platter.
  void discard_platter() {
    if (!scale_.floor_height_m) return;
    for (std::size_t v = 0; v < fit_.mesh.vertices.size(); ++v) {
      if (fit_.mesh.vertices[v].y() < 0.5f * float(*scale_.floor_height_m))
        measured_.support[v] = measured_.offset[v] = 0.0f;
    }
  }

  /// delta: fitted to all groups. The error of the sums of groups that err independently is as
  /// large as that of their differences: each half of the groups against the other.
  void measure_noise(const std::vector<float>& delta) {
    const std::size_t n = delta.size();
    std::vector<float> squares(n, 0.0f), known(n, 0.0f);
    for (const auto& sign : kHalves) {
      VertexMeasurements errors{measured_.support, std::vector<float>(n, 0.0f)};
      parallel_for(n, 4096, [&](std::size_t v) {
        if (!(measured_.support[v] > 0.0f)) return;
        float apart = 0.0f;
        for (std::size_t g = 0; g < kGroups; ++g) {
          const VertexMeasurements& group = of_groups_[g];
          errors.offset[v] += sign[g] * (group.offset[v] - delta[v] * group.support[v]);
          apart += sign[g] * group.support[v] / measured_.support[v];
        }
        // What remains of errors about a surface that was fitted to them.
        known[v] += 1.0f - apart * apart;
      });
      const auto moved = fitted_errors(fit_.mesh, neighbours_, normals_, errors, scale_);
      parallel_for(n, 4096, [&](std::size_t v) { squares[v] += moved[v] * moved[v]; });
    }
    std::vector<double> shares;
    for (std::size_t v = 0; v < n; ++v)
      if (known[v] > 1.0f)
        shares.push_back(std::sqrt(squares[v] / known[v] * (1.0 + double(measured_.support[v]))) /
                         scale_.noise_m);
    if (!shares.empty()) fit_.noise_share = kIterated * median(shares) / kMedianOfThree;
  }

  void move(bool last) {
    const std::vector<float> delta =
        fitted_offsets(fit_.mesh, neighbours_, normals_, measured_, scale_);
    if (last) measure_noise(delta);
    const float limit = float(scale_.limit_m);
    const auto& p = fit_.mesh.vertices;
    std::vector<Vec3f> step(p.size());
    parallel_for(p.size(), 4096, [&](std::size_t v) {
      step[v] = std::clamp(delta[v], -limit, limit) * normals_[v];
      if (below_floor(p[v], scale_)) step[v].y() = 0.0f;
    });
    take_steps(fit_.mesh, std::move(step));
  }

  std::span<const views::DepthView> views_;
  MeshFitScale scale_;
  MeshNeighbours neighbours_;
  VertexObserver observer_;
  MeshFit fit_;
  std::vector<Vec3f> normals_;
  VertexMeasurements measured_;
  std::vector<VertexMeasurements> of_groups_;
  std::vector<float> near_;    // as in VertexSums, per vertex
  std::vector<float> spread_;  // squared, as VertexColumns::spread
};

}  // namespace

Result<MeshFit> fit_mesh(const TriangleMesh& mesh, std::span<const views::DepthView> views,
                         const MeshFitScale& scale, const RunContext& context) {
  return MeshFitter(mesh, views, scale).run(context);
}

}  // namespace turnscan::mesh_refinement
