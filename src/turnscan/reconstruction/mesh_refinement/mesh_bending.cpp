// Offsets of the vertices: a compromise between the measurements around each and small bending.

#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr std::size_t kGrain = 4096;
/// Support from which a bend beside a vertex may be a crease: a pixel or two on an edge.
constexpr float kCreaseSupport = 0.15f;
/// Fitted to scans of 36 to 460 frames.
constexpr double kStiffer = 1.31, kMaxStiffer = 16.0;
/// The same if neighbours have common errors.
constexpr double kStifferInCommon = 0.45, kPowerInCommon = 2.5, kMaxStifferInCommon = 32.0;
/// Conjugate gradients stop at this relative residual, or after this many rounds; more of them for
/// high stiffness, since they grow with the square root of the condition number.
constexpr double kTolerance = 1e-4;
constexpr int kMaxRounds = 80;
constexpr double kRoundsSufficeFor = 8.0;  // times the usual stiffness
/// Weight with which each vertex stays in place, in measurements: hardly measured surface is also
/// known from the volume.
constexpr float kStay = 0.3f;
/// Single unmeasured vertices are filled in from their surroundings; patches wider than twice this
/// many rings are not part of the observed surface.
constexpr int kGapRings = 3;
/// Rounds of averaging with the neighbours that determine the bending of a vertex's surroundings.
constexpr int kSteadyRounds = 30;

class OffsetSolver {
 public:
  OffsetSolver(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
               const std::vector<Vec3f>& normals, const VertexMeasurements& measured,
               const MeshFitScale& scale)
      : mesh_(mesh),
        neighbours_(neighbours),
        normals_(normals),
        measured_(measured),
        scale_(scale),
        typical_(typical_support(measured.support)),
        stiffer_(stiffening(scale.noise_m, scale.correlation, scale.spacing_m, scale.edge_m,
                            typical_)) {}

  std::vector<float> offsets() {
    bends();
    weights();
    subtract_steady_bends();
    forget_unseen_bends();
    return solve();
  }

  /// The solution is linear in what was measured and in the bends.
  std::vector<float> without_bends() {
    bends();
    weights();
    std::fill(bend_.begin(), bend_.end(), 0.0f);
    return solve();
  }

 private:
  /// Depth of each vertex below the mean of its neighbours, along its normal.
  void bends() {
    const auto& p = mesh_.vertices;
    bend_.resize(p.size());
    parallel_for(p.size(), kGrain, [&](std::size_t v) {
      bend_[v] = (neighbours_.mean(p, v, Vec3f(Vec3f::Zero())) - p[v]).dot(normals_[v]);
    });
  }

  /// Bends averaged with those of the neighbours: a ridge bends along a line of vertices, while a
  /// single vertex displaced by noise bends its neighbours the other way, which cancels.
  float shared_bend(std::size_t v) const {
    const float count = neighbours_.count(v);
    return (bend_[v] + count * neighbours_.mean(bend_, v, 0.0f)) / (1.0f + count);
  }

  /// Degree to which a vertex and its neighbours were measured, 0 to 1. A bend beside unmeasured
  /// surface is not a crease: measurements end there raggedly.
  std::vector<float> seen() const {
    std::vector<float> out(bend_.size());
    parallel_for(out.size(), kGrain, [&](std::size_t v) {
      out[v] = below_floor(mesh_.vertices[v], scale_)
                   ? 1.0f
                   : std::min(1.0f, measured_.support[v] / kCreaseSupport);
    });
    return neighbours_.least(std::move(out), 1);
  }

  /// Stiffness m and coupling c of fitted_offsets(), per vertex.
  void weights() {
    seen_ = seen();
    const float crease = float(scale_.crease_sigmas) * float(scale_.noise_m);
    stiff_.resize(bend_.size());
    coupling_.resize(bend_.size());
    fade_.resize(bend_.size());
    const float stiffness = float(scale_.stiffness * stiffer_) * typical_;
    parallel_for(bend_.size(), kGrain, [&](std::size_t v) {
      // Where fewer measurements than usual exist, only a larger bend exceeds the noise.
      const float around =
          0.5f * (measured_.support[v] + neighbours_.mean(measured_.support, v, 0.0f)) / typical_;
      const float share =
          below_floor(mesh_.vertices[v], scale_) ? 1.0f : std::clamp(around, 0.02f, 1.0f);
      const float s = seen_[v] * shared_bend(v) * std::sqrt(share * typical_) / crease;
      const float fade = 1.0f / ((1.0f + s * s) * (1.0f + s * s));
      stiff_[v] = stiffness * fade;
      fade_[v] = fade;
      coupling_[v] = float(scale_.crease_coupling) * (1.0f - fade);
    });
  }

  /// Bending like that of the surroundings, of a ball or a leg, is not penalised, measured or not:
  /// only deviations from it are. Creases and unmeasured surface are excluded from the
  /// surroundings.
  void subtract_steady_bends() {
    const std::size_t n = bend_.size();
    std::vector<float> sum(n), weight(n);
    parallel_for(n, kGrain, [&](std::size_t v) {
      weight[v] = fade_[v] * seen_[v];
      sum[v] = weight[v] * bend_[v];
    });
    for (int round = 0; round < kSteadyRounds; ++round) {
      std::vector<float> next_sum(n), next_weight(n);
      parallel_for(n, kGrain, [&](std::size_t v) {
        const float count = neighbours_.count(v);
        next_sum[v] = (sum[v] + count * neighbours_.mean(sum, v, 0.0f)) / (1.0f + count);
        next_weight[v] = (weight[v] + count * neighbours_.mean(weight, v, 0.0f)) / (1.0f + count);
      });
      sum.swap(next_sum);
      weight.swap(next_weight);
    }
    parallel_for(n, kGrain,
                 [&](std::size_t v) { bend_[v] -= weight[v] > 1e-6f ? sum[v] / weight[v] : 0.0f; });
  }

  /// Unmeasured parts of the mesh have cliffs and webs: their bends must not move the measured
  /// surface beside them.
  void forget_unseen_bends() {
    std::vector<float> known(bend_.size());
    parallel_for(known.size(), kGrain, [&](std::size_t v) {
      known[v] = std::min(1.0f, measured_.support[v] / (kUnseenShare * typical_));
    });
    known = neighbours_.largest(std::move(known), kGapRings);
    known = neighbours_.least(std::move(known), kGapRings + 1);
    parallel_for(bend_.size(), kGrain, [&](std::size_t v) { bend_[v] *= known[v]; });
  }

  /// Adds the effect on the vertices of a force on the bend at each vertex, here each neighbour's
  /// part of it.
  void add_forces(const std::vector<float>& part, std::vector<float>& to) const {
    parallel_for(to.size(), kGrain, [&](std::size_t v) {
      float sum = to[v] + neighbours_.count(v) * part[v];
      neighbours_.each(v, [&](std::uint32_t u) { sum -= part[u]; });
      to[v] = sum;
    });
  }

  /// The left side of the normal equations.
  void apply(const std::vector<float>& delta, std::vector<float>& part,
             std::vector<float>& out) const {
    parallel_for(delta.size(), kGrain, [&](std::size_t v) {
      part[v] = (stiff_[v] + coupling_[v]) * (delta[v] - neighbours_.mean(delta, v, 0.0f)) /
                std::max(1.0f, neighbours_.count(v));
      out[v] = (measured_.support[v] + kStay) * delta[v];
    });
    add_forces(part, out);
  }

  std::vector<float> diagonal() const {
    std::vector<float> out(bend_.size());
    parallel_for(out.size(), kGrain, [&](std::size_t v) {
      out[v] = measured_.support[v] + kStay + stiff_[v] + coupling_[v];
      neighbours_.each(v, [&](std::uint32_t u) {
        out[v] += (stiff_[u] + coupling_[u]) / (neighbours_.count(u) * neighbours_.count(u));
      });
    });
    return out;
  }

  /// The right side: with all vertices at their start.
  std::vector<float> residual() const {
    std::vector<float> part(bend_.size()), out(bend_.size());
    parallel_for(out.size(), kGrain, [&](std::size_t v) {
      part[v] = stiff_[v] * bend_[v] / std::max(1.0f, neighbours_.count(v));
      out[v] = measured_.support[v] > 1e-3f ? measured_.offset[v] : 0.0f;
    });
    add_forces(part, out);
    return out;
  }

  /// Sums in chunks whose length does not depend on the number of threads.
  static double dot(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (const double part :
         parallel_chunks<double>(a.size(), kGrain, [&](std::size_t begin, std::size_t end) {
           double of_chunk = 0.0;
           for (std::size_t v = begin; v < end; ++v) of_chunk += double(a[v]) * double(b[v]);
           return of_chunk;
         }))
      sum += part;
    return sum;
  }

  /// Conjugate gradients with the inverse diagonal as preconditioner (Hestenes and Stiefel 1952).
  /// They are required for long, hardly measured waves, which iterations with fixed steps leave
  /// unchanged.
  std::vector<float> solve() const {
    const std::size_t n = bend_.size();
    const std::vector<float> scale = diagonal();
    std::vector<float> delta(n, 0.0f), left = residual(), scaled(n), direction(n, 0.0f), part(n),
                                       image(n);
    double before = 0.0, first = 0.0;
    const int most = int(kMaxRounds * std::sqrt(std::max(1.0, stiffer_ / kRoundsSufficeFor)));
    for (int round = 0; round < most; ++round) {
      parallel_for(n, kGrain, [&](std::size_t v) { scaled[v] = left[v] / scale[v]; });
      const double now = dot(left, scaled);
      if (round == 0) first = now;
      if (!(now > kTolerance * kTolerance * first)) break;
      const float turn = round == 0 ? 0.0f : float(now / before);
      parallel_for(n, kGrain,
                   [&](std::size_t v) { direction[v] = scaled[v] + turn * direction[v]; });
      apply(direction, part, image);
      const float along = float(now / dot(direction, image));
      parallel_for(n, kGrain, [&](std::size_t v) {
        delta[v] += along * direction[v];
        left[v] -= along * image[v];
      });
      before = now;
    }
    return delta;
  }

  const TriangleMesh& mesh_;
  const MeshNeighbours& neighbours_;
  const std::vector<Vec3f>& normals_;
  const VertexMeasurements& measured_;
  const MeshFitScale& scale_;
  float typical_;
  double stiffer_;
  std::vector<float> bend_, stiff_, coupling_, fade_, seen_;
};

}  // namespace

float typical_support(const std::vector<float>& support) {
  std::vector<float> some;
  std::copy_if(support.begin(), support.end(), std::back_inserter(some),
               [](float s) { return s > 0.01f; });
  return float(median(some, 1.0));
}

std::vector<std::uint8_t> unseen_vertices(const std::vector<float>& support) {
  const float least = kUnseenShare * typical_support(support);
  std::vector<std::uint8_t> out(support.size());
  std::transform(support.begin(), support.end(), out.begin(),
                 [&](float s) { return std::uint8_t(s < least); });
  return out;
}

double stiffening(double noise_m, double correlation, double spacing_m, double edge_m,
                  float typical_support) {
  const double alone =
      noise_m * spacing_m / (edge_m * edge_m * std::sqrt(std::max(1e-3, double(typical_support))));
  const double all = correlation * alone;
  const double in_common =
      kStifferInCommon * (std::pow(all, kPowerInCommon) - std::pow(alone, kPowerInCommon));
  return std::max(std::clamp(kStiffer * all, 1.0, kMaxStiffer),
                  std::min(in_common, kMaxStifferInCommon));
}

/// Offsets d that minimise sum w (d - own)^2 + sum m (bend + mean of the neighbours' d - d)^2 + sum
/// c (mean of the neighbours' d - d)^2 + kStay sum d^2. A bend that is too large to be noise is a
/// crease, where m fades (Geman and McClure) while c grows: the crease keeps its shape, and moves
/// with its neighbours rather than each vertex with its own noise.
std::vector<float> fitted_offsets(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
                                  const std::vector<Vec3f>& normals,
                                  const VertexMeasurements& measured, const MeshFitScale& scale) {
  return OffsetSolver(mesh, neighbours, normals, measured, scale).offsets();
}

std::vector<float> fitted_errors(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
                                 const std::vector<Vec3f>& normals,
                                 const VertexMeasurements& errors, const MeshFitScale& scale) {
  return OffsetSolver(mesh, neighbours, normals, errors, scale).without_bends();
}

}  // namespace turnscan::mesh_refinement
