#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/poisson/poisson_kernel.hpp>
#include <turnscan/reconstruction/poisson/poisson_levels.hpp>

namespace turnscan::poisson {
namespace {

constexpr std::size_t kChunk = 64;  // bricks per partial sum
/// Steps of a level: smooth errors are reduced by the coarser levels; the error left after these is
/// below a hundredth of a millimetre on a figure of 40 cm.
constexpr int kMaxSteps = 40;
constexpr double kTolerance = 1e-2;  // of the residual
/// Diagonal of the stiffness matrix.
constexpr float kDiagonal = 3.0f * (66.0f / 120.0f) * (66.0f / 120.0f);

/// Quadratic B-splines' stiffness, plus the points' screening term, which pulls the indicator
/// towards zero.
class ScreenedOperator {
 public:
  ScreenedOperator(const OctreeLevel& level, const OrientedSamples& samples, double point_weight)
      : level_(level), clusters_(samples.clusters(level.bricks)), weight_(float(point_weight)) {}

  /// out += factor times the points' contribution to the equation for u + offset.
  void add_points(const Field& u, float offset, float factor, Field& out) const {
    for_each_cluster([&](const SampleCluster& cluster, const Neighbours& around) {
      const float v = factor * weight_ * cluster.area * (value(cluster.spot, around, u) + offset);
      for_each_cell(cluster.spot, around,
                    [&](std::size_t cell, float weight) { out[cell] += weight * v; });
    });
  }

  Field inverse_diagonal() const {
    Field d(level_.bricks.size() * kCells, kDiagonal);
    for_each_cluster([&](const SampleCluster& cluster, const Neighbours& around) {
      for_each_cell(cluster.spot, around, [&](std::size_t cell, float weight) {
        d[cell] += weight_ * cluster.area * weight * weight;
      });
    });
    parallel_for(d.size(), 65536, [&](std::size_t i) { d[i] = 1.0f / d[i]; });
    return d;
  }

  /// q = operator times p in the bricks that are solved; p and q have all bricks.
  void apply(const Field& p, Field& q) const {
    parallel_for(level_.solved, 16, [&](std::size_t s) {
      Block block;
      level_.bricks.gather(p, s, block);
      stiffness(block.data(), &q[s * kCells]);
    });
    add_points(p, 0.0f, 1.0f, q);
  }

 private:
  static float value(const SplineFootprint& spot, const Neighbours& around, const Field& u) {
    float sum = 0.0f;
    for_each_cell(spot, around, [&](std::size_t cell, float weight) { sum += weight * u[cell]; });
    return sum;
  }

  template <class Body>
  void for_each_cluster(const Body& body) const {
    for (const auto& runs : clusters_.runs) {
      parallel_for(runs.size(), 8, [&](std::size_t r) {
        const Neighbours around = level_.bricks.neighbours(runs[r].brick);
        for (std::size_t c = runs[r].begin; c < runs[r].end; ++c) body(clusters_.all[c], around);
      });
    }
  }

  const OctreeLevel& level_;
  SampleClusters clusters_;
  float weight_;
};

template <class Term>
double sum_over(std::size_t bricks, const Term& term) {
  double sum = 0.0;
  for (const double part : parallel_chunks<double>(
           bricks, kChunk,
           [&](std::size_t b, std::size_t e) { return term(b * kCells, (e - b) * kCells); }))
    sum += part;
  return sum;
}

/// Conjugate gradients with the inverse diagonal as preconditioner (Hestenes and Stiefel 1952); r
/// is the residual of x = 0. All fields have all bricks; only those solved change.
Result<> solve(const ScreenedOperator& equation, std::size_t bricks, const Field& inverse, Field& r,
               Field& x, const RunContext& context) {
  Field p(r.size(), 0.0f), q(r.size(), 0.0f);
  double rz = sum_over(bricks, [&](std::size_t b, std::size_t n) {
    update_direction(0.0f, &inverse[b], &r[b], &p[b], n);
    return dot(&p[b], &r[b], n);
  });
  const double enough = kTolerance * kTolerance * rz;
  for (int step = 0; step < kMaxSteps && rz > enough; ++step) {
    TURNSCAN_TRY(context.check());
    equation.apply(p, q);
    const double pq =
        sum_over(bricks, [&](std::size_t b, std::size_t n) { return dot(&p[b], &q[b], n); });
    if (!(pq > 0.0)) break;
    const float along = float(rz / pq);
    const double next = sum_over(bricks, [&](std::size_t b, std::size_t n) {
      return update_solution(along, &p[b], &q[b], &inverse[b], &x[b], &r[b], n);
    });
    const float beta = float(next / rz);
    rz = next;
    parallel_for(bricks, kChunk, [&](std::size_t b) {
      update_direction(beta, &inverse[b * kCells], &r[b * kCells], &p[b * kCells], kCells);
    });
  }
  return {};
}

}  // namespace

Result<double> solve_level(OctreeLevels& levels, std::size_t l, const OrientedSamples& samples,
                           double point_weight, const RunContext& context) {
  OctreeLevel& level = levels[l];
  Field residual = prolong(levels, l);
  const ScreenedOperator equation(level, samples, point_weight);
  equation.add_points(level.indicator, float(kOutside), -1.0f, residual);
  Field x(residual.size(), 0.0f);
  TURNSCAN_TRY(solve(equation, level.solved, equation.inverse_diagonal(), residual, x, context));
  parallel_for(level.solved, 64, [&](std::size_t s) {
    for (std::size_t n = s * kCells; n < (s + 1) * kCells; ++n) level.indicator[n] += x[n];
  });
  return kOutside + double(samples.median(level.bricks, level.indicator));
}

}  // namespace turnscan::poisson
