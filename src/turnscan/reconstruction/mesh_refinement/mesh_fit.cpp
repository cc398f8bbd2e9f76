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
/// Views within this angle may err alike.
constexpr double kAlike_rad = 30.0 * kRadiansPerDegree;
constexpr std::size_t kGroups = 4;
/// The three ways of dividing four groups into halves.
constexpr std::array<std::array<float, kGroups>, kErrorSamples> kHalves{
    {{1, 1, -1, -1}, {1, -1, 1, -1}, {1, -1, -1, 1}}};
/// Median of the root of a mean of three squares of standard normal values.
constexpr double kMedianOfThree = 0.888;
/// Noise that remains over that of the last iteration, since it spares bends that the ones before
/// left, and since the errors that choose its stiffness are those that it leaves: balls of 8, 24
/// and 120 frames differ from the truth by 1.1 to 1.5 times more.
constexpr double kIterated = 1.5;

class MeshFitter {
 public:
  MeshFitter(const TriangleMesh& mesh, std::span<const views::DepthView> views,
             const MeshFitScale& scale)
      : views_(views), scale_(scale), neighbours_(mesh), observer_(mesh) {
    fit_.mesh = mesh;
  }

  Result<MeshFit> run(const RunContext& context) {
    const int rounds = std::max(1, scale_.iterations);
    const std::size_t groups = scale_.iterations > 0 ? kGroups : 1;
    context.begin_phase("fit", observer_.blocks() * std::size_t(rounds) * groups);
    for (int iteration = 0; iteration < rounds; ++iteration) {
      update_vertices(iteration);
      const int to_go = rounds - 1 - iteration;
      TURNSCAN_TRY(measure(groups > 1 ? independent_groups(view_stride(to_go))
                                      : ViewGroups{every(view_stride(to_go))},
                           context));
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
    observer_.set_vertices(fit_.mesh.vertices, normals_);
  }

  using ViewGroups = std::vector<std::vector<std::size_t>>;

  std::vector<std::size_t> every(std::size_t stride) const {
    return evenly_spread(views_.size(), (views_.size() + stride - 1) / stride);
  }

  /// Every so many views by their direction about the middle of the mesh, in turn: those within 30
  /// degrees, which may err alike, are of one group. If all are, each is taken for itself.
  ViewGroups independent_groups(std::size_t stride) const {
    const Vec3d middle = bounds(fit_.mesh.vertices).center();
    std::vector<std::pair<double, std::size_t>> order;
    for (const std::size_t i : every(stride)) {
      const Vec3d to = views_[i].viewpoint().direction_from(middle);
      order.emplace_back(std::atan2(to.z(), to.x()), i);
    }
    std::sort(order.begin(), order.end());
    const auto divided = [&](double alike) {
      ViewGroups out(kGroups);
      std::size_t group = 0;
      double begin = order.empty() ? 0.0 : order.front().first;
      for (const auto& [direction, view] : order) {
        if (direction - begin >= alike) begin = direction, ++group;
        out[group % kGroups].push_back(view);
      }
      return out;
    };
    ViewGroups out = divided(kAlike_rad);
    return out.back().empty() ? divided(0.0) : out;
  }

  Result<> measure(const ViewGroups& groups, const RunContext& context) {
    const std::size_t n = fit_.mesh.vertices.size();
    measured_ = {std::vector<float>(n, 0.0f), std::vector<float>(n, 0.0f)};
    of_groups_.clear();
    for (const auto& group : groups) {
      TURNSCAN_ASSIGN(VertexMeasurements found, observer_.observe(views_, group, scale_, context));
      parallel_for(n, 4096, [&](std::size_t v) {
        measured_.support[v] += found.support[v];
        measured_.offset[v] += found.offset[v];
      });
      of_groups_.push_back(std::move(found));
    }
    return {};
  }

  /// Measurements in the lower half of the margin may be of the platter.
  void discard_platter() {
    if (!scale_.floor_height_m) return;
    for (std::size_t v = 0; v < fit_.mesh.vertices.size(); ++v) {
      if (below_floor(fit_.mesh.vertices[v], scale_, 0.5f))
        measured_.support[v] = measured_.offset[v] = 0.0f;
    }
  }

  /// The error of the sums of groups that err independently is as large as that of their
  /// differences: each half of the groups against the other, about what was measured around each
  /// vertex. known: as for fitted_offsets().
  std::vector<std::vector<float>> sample_errors(std::vector<float>& known) const {
    const std::size_t n = fit_.mesh.vertices.size();
    std::vector<std::vector<float>> out;
    known.assign(n, 0.0f);
    for (const auto& sign : kHalves) {
      std::vector<float>& errors = out.emplace_back(n, 0.0f);
      parallel_for(n, 4096, [&](std::size_t v) {
        if (!(measured_.support[v] > 0.0f)) return;
        const float mean = measured_.offset[v] / measured_.support[v];
        float apart = 0.0f;
        for (std::size_t g = 0; g < kGroups; ++g) {
          const VertexMeasurements& group = of_groups_[g];
          errors[v] += sign[g] * (group.offset[v] - mean * group.support[v]);
          apart += sign[g] * group.support[v] / measured_.support[v];
        }
        // What remains of errors about a mean that includes them.
        known[v] += 1.0f - apart * apart;
      });
    }
    return out;
  }

  void measure_noise(const FittedOffsets& fitted, const std::vector<float>& known) {
    std::vector<double> shares;
    for (std::size_t v = 0; v < known.size(); ++v) {
      if (!(known[v] > 1.0f)) continue;
      double squares = 0.0;
      for (const auto& errors : fitted.errors) squares += double(errors[v]) * double(errors[v]);
      shares.push_back(
          std::sqrt(squares / double(known[v]) * (1.0 + double(measured_.support[v]))) /
          scale_.noise_m);
    }
    if (!shares.empty()) fit_.noise_share = kIterated * median(shares) / kMedianOfThree;
  }

  void move(bool last) {
    std::vector<float> known;
    const auto errors = sample_errors(known);
    const FittedOffsets fitted =
        fitted_offsets(fit_.mesh, neighbours_, normals_, measured_, scale_, errors, known);
    if (last) measure_noise(fitted, known);
    const std::vector<float>& delta = fitted.offset;
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
};

}  // namespace

Result<MeshFit> fit_mesh(const TriangleMesh& mesh, std::span<const views::DepthView> views,
                         const MeshFitScale& scale, const RunContext& context) {
  return MeshFitter(mesh, views, scale).run(context);
}

}  // namespace turnscan::mesh_refinement
