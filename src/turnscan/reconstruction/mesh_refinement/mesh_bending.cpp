// Offsets of the vertices: a compromise between the measurements around each and small bending.

#include <algorithm>
#include <cmath>
#include <optional>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr std::size_t kGrain = 4096;
/// Conjugate gradients stop at this residual, relative to that before anything has moved, or after
/// this many rounds.
constexpr double kTolerance = 1e-2;
constexpr int kMaxRounds = 80;
/// Weight with which each vertex stays in place, in measurements: hardly measured surface is also
/// known from the volume.
constexpr float kStay = 0.3f;
/// Single unmeasured vertices are filled in from their surroundings; patches wider than twice this
/// many rings are not part of the observed surface.
constexpr int kGapRings = 3;
/// Rounds of averaging with the neighbours that determine the bending of a vertex's surroundings.
constexpr int kSteadyRounds = 30;
/// The surface is also fitted with this many larger stiffnesses, each this many times the one
/// before: the width over which a fit averages grows with the fourth root, and doubles.
constexpr int kStiffer = 2;
constexpr float kTimesStiffer = 16.0f;
/// Rounds of averaging with the neighbours over which two fits are compared.
constexpr int kCompareRounds = 60;

/// What is fitted, and what the same fit makes of errors, side by side: one pass through the mesh.
using Columns = Eigen::Array4f;
static_assert(kErrorSamples + 1 == Columns::RowsAtCompileTime);

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
        typical_(typical_support(measured.support)) {}

  FittedOffsets offsets(std::span<const std::vector<float>> errors,
                        const std::vector<float>& known) {
    bends();
    weights();
    subtract_steady_bends();
    forget_unseen_bends();
    const std::size_t n = bend_.size();
    std::vector<Columns> right(n, Columns::Zero());
    for (std::size_t v = 0; v < n; ++v) {
      if (measured_.support[v] > 1e-3f) right[v][0] = measured_.offset[v];
      for (std::size_t e = 0; e < errors.size(); ++e) right[v][Eigen::Index(e) + 1] = errors[e][v];
    }
    std::vector<Columns> fit(n, Columns::Zero());
    solve(right, fit);
    std::vector<Columns> best = fit;
    std::vector<float> trust(errors.empty() ? 0 : n, 1.0f);
    for (int level = 0; level < kStiffer && !errors.empty(); ++level) {
      for (float& m : stiff_) m *= kTimesStiffer;
      std::vector<Columns> smoother = fit;
      solve(right, smoother);
      blend(fit, smoother, known, trust, best);
      fit.swap(smoother);
    }
    FittedOffsets out;
    out.offset.resize(n);
    out.errors.assign(errors.size(), std::vector<float>(n));
    parallel_for(n, kGrain, [&](std::size_t v) {
      out.offset[v] = best[v][0];
      for (std::size_t e = 0; e < errors.size(); ++e)
        out.errors[e][v] = best[v][Eigen::Index(e) + 1];
    });
    return out;
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

  /// Stiffness m and coupling c of fitted_offsets(), per vertex.
  void weights() {
    const float crease = float(scale_.crease_sigmas) * float(scale_.noise_m);
    stiff_.resize(bend_.size());
    coupling_.resize(bend_.size());
    fade_.resize(bend_.size());
    const float stiffness = float(scale_.stiffness) * typical_;
    parallel_for(bend_.size(), kGrain, [&](std::size_t v) {
      const float s = shared_bend(v) * std::sqrt(typical_) / crease;
      const float fade = 1.0f / ((1.0f + s * s) * (1.0f + s * s));
      stiff_[v] = stiffness * fade;
      fade_[v] = fade;
      coupling_[v] = float(scale_.crease_coupling) * (1.0f - fade);
    });
  }

  /// Bending like that of the surroundings, of a ball or a leg, is not penalised, measured or not:
  /// only deviations from it are. Creases are excluded from the surroundings.
  void subtract_steady_bends() {
    const std::size_t n = bend_.size();
    std::vector<Pair> sums(n);
    parallel_for(n, kGrain, [&](std::size_t v) { sums[v] = {fade_[v] * bend_[v], fade_[v]}; });
    sums = around(std::move(sums), kSteadyRounds);
    parallel_for(n, kGrain, [&](std::size_t v) {
      bend_[v] -= sums[v][1] > 1e-6f ? sums[v][0] / sums[v][1] : 0.0f;
    });
  }

  /// Two values of a vertex that are averaged alike.
  using Pair = Eigen::Array2f;

  std::vector<Pair> around(std::vector<Pair> values, int rounds) const {
    std::vector<Pair> next(values.size());
    for (int round = 0; round < rounds; ++round) {
      parallel_for(values.size(), kGrain, [&](std::size_t v) {
        Pair sum = values[v];
        neighbours_.each(v, [&](std::uint32_t u) { sum += values[u]; });
        next[v] = sum / (1.0f + neighbours_.count(v));
      });
      values.swap(next);
    }
    return values;
  }

  /// Moves the best fit towards a stiffer one as far as that is expected to err less. Their
  /// difference is noise of the weaker one, whose size the errors tell, and bias of the stiffer
  /// one. The error of fit + w (smoother - fit) is least at w = noise / (noise + bias), squared,
  /// if the stiffer fit and the difference err independently, as those of an efficient and of an
  /// inefficient estimate do (J. Hausman, "Specification tests in econometrics", 1978). trust: the
  /// product of the weights w so far.
  void blend(const std::vector<Columns>& fit, const std::vector<Columns>& smoother,
             const std::vector<float>& known, std::vector<float>& trust,
             std::vector<Columns>& best) const {
    std::vector<Pair> squares(fit.size(), Pair::Zero());
    parallel_for(fit.size(), kGrain, [&](std::size_t v) {
      if (!(known[v] > 1.0f)) return;
      const Columns d = (smoother[v] - fit[v]).square();
      squares[v] = {d.tail<kErrorSamples>().sum() / known[v], d[0]};
    });
    squares = around(std::move(squares), kCompareRounds);
    parallel_for(fit.size(), kGrain, [&](std::size_t v) {
      const auto [noise, all] = std::pair(squares[v][0], squares[v][1]);
      trust[v] *= all > noise ? noise / all : all > 0.0f ? 1.0f : 0.0f;
      best[v] += trust[v] * (smoother[v] - fit[v]);
    });
  }

  /// Unmeasured parts of the mesh have cliffs and webs: their bends must not move the measured
  /// surface beside them.
  void forget_unseen_bends() {
    std::vector<float> known = neighbours_.largest(measured_shares(measured_.support), kGapRings);
    known = neighbours_.least(std::move(known), kGapRings + 1);
    parallel_for(bend_.size(), kGrain, [&](std::size_t v) { bend_[v] *= known[v]; });
  }

  /// Effect on a vertex of a force on the bend at each vertex, here each neighbour's part of it.
  Columns force(const std::vector<Columns>& part, std::size_t v) const {
    Columns sum = neighbours_.count(v) * part[v];
    neighbours_.each(v, [&](std::uint32_t u) { sum -= part[u]; });
    return sum;
  }

  /// The part of each neighbour in the force on the bend at a vertex that offsets cause.
  Columns part_of(const std::vector<Columns>& delta, std::size_t v) const {
    const float count = std::max(1.0f, neighbours_.count(v));
    Columns sum = Columns::Zero();
    neighbours_.each(v, [&](std::uint32_t u) { sum += delta[u]; });
    return (stiff_[v] + coupling_[v]) / count * (delta[v] - sum / count);
  }

  /// The left side of the normal equations at a vertex.
  Columns image_of(const std::vector<Columns>& delta, const std::vector<Columns>& part,
                   std::size_t v) const {
    return (measured_.support[v] + kStay) * delta[v] + force(part, v);
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

  /// What the right side lacks at the given offsets. Bends are of the first column.
  std::vector<Columns> residual(const std::vector<Columns>& right,
                                const std::vector<Columns>& delta) const {
    std::vector<Columns> part(right.size()), out(right.size());
    parallel_for(out.size(), kGrain, [&](std::size_t v) {
      part[v] = part_of(delta, v);
      part[v][0] -= stiff_[v] * bend_[v] / std::max(1.0f, neighbours_.count(v));
    });
    parallel_for(out.size(), kGrain,
                 [&](std::size_t v) { out[v] = right[v] - image_of(delta, part, v); });
    return out;
  }

  using Sums = Eigen::Array4d;

  /// Sum of what a function gives for each vertex, in chunks whose length does not depend on the
  /// number of threads.
  template <class Term>
  static Sums sum_of(std::size_t count, const Term& term) {
    Sums sum = Sums::Zero();
    for (const Sums& part :
         parallel_chunks<Sums>(count, kGrain, [&](std::size_t begin, std::size_t end) {
           Sums of_chunk = Sums::Zero();
           for (std::size_t v = begin; v < end; ++v)
             of_chunk += Columns(term(v)).template cast<double>();
           return of_chunk;
         }))
      sum += part;
    return sum;
  }

  /// Conjugate gradients with the inverse diagonal as preconditioner (Hestenes and Stiefel 1952),
  /// each column with its own steps, from the given offsets on. They are required for long, hardly
  /// measured waves, which iterations with fixed steps leave unchanged.
  void solve(const std::vector<Columns>& right, std::vector<Columns>& delta) {
    const std::size_t n = right.size();
    const std::vector<float> scale = diagonal();
    std::vector<Columns> left = residual(right, delta), direction(n, Columns::Zero()), part(n),
                         image(n);
    Sums before = Sums::Ones();
    Sums now = sum_of(n, [&](std::size_t v) { return left[v].square() / scale[v]; });
    if (!goal_) goal_ = kTolerance * kTolerance * now;
    for (int round = 0; round < kMaxRounds && (now > *goal_).any(); ++round) {
      const Columns turn = (round == 0 ? Sums(Sums::Zero()) : ratio(now, before)).cast<float>();
      parallel_for(n, kGrain,
                   [&](std::size_t v) { direction[v] = left[v] / scale[v] + turn * direction[v]; });
      parallel_for(n, kGrain, [&](std::size_t v) { part[v] = part_of(direction, v); });
      const Sums bent = sum_of(n, [&](std::size_t v) {
        image[v] = image_of(direction, part, v);
        return direction[v] * image[v];
      });
      const Columns along = (now > *goal_).select(ratio(now, bent), 0.0).cast<float>();
      before = now;
      now = sum_of(n, [&](std::size_t v) {
        delta[v] += along * direction[v];
        left[v] -= along * image[v];
        return left[v].square() / scale[v];
      });
    }
  }

  /// 0 where there is nothing left to divide.
  static Sums ratio(const Sums& a, const Sums& b) { return (b > 0.0).select(a / b, 0.0); }

  const TriangleMesh& mesh_;
  const MeshNeighbours& neighbours_;
  const std::vector<Vec3f>& normals_;
  const VertexMeasurements& measured_;
  const MeshFitScale& scale_;
  float typical_;
  std::vector<float> bend_, stiff_, coupling_, fade_;
  std::optional<Sums> goal_;  // of solve()
};

}  // namespace

float typical_support(const std::vector<float>& support) {
  std::vector<float> some;
  std::copy_if(support.begin(), support.end(), std::back_inserter(some),
               [](float s) { return s > 0.01f; });
  return float(median(some, 1.0));
}

std::vector<float> measured_shares(const std::vector<float>& support) {
  const float enough = kMeasuredShare * typical_support(support);
  std::vector<float> out(support.size());
  std::transform(support.begin(), support.end(), out.begin(),
                 [&](float s) { return std::min(1.0f, s / enough); });
  return out;
}

std::vector<std::uint8_t> unseen_vertices(const std::vector<float>& support) {
  std::vector<std::uint8_t> out;
  for (const float share : measured_shares(support)) out.push_back(share < 1.0f ? 1 : 0);
  return out;
}

/// Offsets d that minimise sum w (d - own)^2 + sum m (bend + mean of the neighbours' d - d)^2 + sum
/// c (mean of the neighbours' d - d)^2 + kStay sum d^2. A bend that is too large to be noise is a
/// crease, where m fades (Geman and McClure) while c grows: the crease keeps its shape, and moves
/// with its neighbours rather than each vertex with its own noise.
FittedOffsets fitted_offsets(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
                             const std::vector<Vec3f>& normals, const VertexMeasurements& measured,
                             const MeshFitScale& scale, std::span<const std::vector<float>> errors,
                             const std::vector<float>& known) {
  return OffsetSolver(mesh, neighbours, normals, measured, scale).offsets(errors, known);
}

}  // namespace turnscan::mesh_refinement
