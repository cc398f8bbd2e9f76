// How far vertices go: between what was measured around each and a surface that bends little.

#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/mesh_fit_parts.hpp>

namespace turnscan::detail {

namespace {

constexpr std::size_t kGrain = 4096;
/// Support from which on a bend beside a vertex may be a feature: a pixel or two on an edge.
constexpr float kSeen = 0.15f;
constexpr int kRounds = 40;
constexpr float kDamping =
    0.35f;  // of Jacobi's steps; the bending's matrix has large off-diagonals

class Bending {
 public:
  Bending(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
          const std::vector<Vec3f>& normals, const VertexMeasurements& measured,
          const MeshFitScale& scale)
      : mesh_(mesh),
        neighbours_(neighbours),
        normals_(normals),
        measured_(measured),
        scale_(scale),
        typical_(typical_support(measured.support)) {}

  /// Damped Jacobi.
  std::vector<float> offsets() {
    bends();
    weights();
    const std::size_t n = bend_.size();
    std::vector<float> own(n), diagonal(n), delta(n), rest(n);
    parallel_for(n, kGrain, [&](std::size_t v) {
      const float support = measured_.support[v];
      own[v] = support > 1e-3f ? measured_.offset[v] / support : 0.0f;
      diagonal[v] = support + stiff_[v] + alike_[v] + 1e-6f;
      neighbours_.each(v, [&](std::uint32_t u) {
        diagonal[v] += (stiff_[u] + alike_[u]) / (neighbours_.count(u) * neighbours_.count(u));
      });
    });
    for (int round = 0; round < kRounds; ++round) {
      parallel_for(n, kGrain, [&](std::size_t v) {
        rest[v] = stiff_[v] * bend_[v] +
                  (stiff_[v] + alike_[v]) * (neighbours_.mean(delta, v, 0.0f) - delta[v]);
      });
      parallel_for(n, kGrain, [&](std::size_t v) {
        float gradient = measured_.support[v] * (own[v] - delta[v]) + rest[v];
        neighbours_.each(v, [&](std::uint32_t u) { gradient -= rest[u] / neighbours_.count(u); });
        delta[v] += kDamping * gradient / diagonal[v];
      });
    }
    return delta;
  }

 private:
  /// How far each vertex lies below the mean of its neighbours, along its normal.
  void bends() {
    const auto& p = mesh_.vertices;
    bend_.resize(p.size());
    parallel_for(p.size(), kGrain, [&](std::size_t v) {
      bend_[v] = (neighbours_.mean(p, v, Vec3f(Vec3f::Zero())) - p[v]).dot(normals_[v]);
    });
  }

  /// Bends averaged with those of the neighbours: a ridge bends along a line of vertices, while one
  /// vertex that noise pulled out bends its neighbours the other way, and nothing is left.
  float shared_bend(std::size_t v) const {
    const float count = neighbours_.count(v);
    return (bend_[v] + count * neighbours_.mean(bend_, v, 0.0f)) / (1.0f + count);
  }

  /// How far a vertex and its neighbours were measured, 0 to 1. A bend beside what was not is no
  /// feature: measurements end there, and raggedly.
  std::vector<float> seen() const {
    std::vector<float> out(bend_.size());
    parallel_for(out.size(), kGrain, [&](std::size_t v) {
      out[v] =
          stands(mesh_.vertices[v], scale_) ? 1.0f : std::min(1.0f, measured_.support[v] / kSeen);
    });
    return neighbours_.chosen(std::move(out), 1, [](float a, float b) { return std::min(a, b); });
  }

  /// Of m and c below, per vertex.
  void weights() {
    const std::vector<float> seen = this->seen();
    const float feature = float(scale_.feature) * float(scale_.noise_m);
    stiff_.resize(bend_.size());
    alike_.resize(bend_.size());
    parallel_for(bend_.size(), kGrain, [&](std::size_t v) {
      // Where less was measured than usual, only a larger bend is more than noise.
      const float around =
          0.5f * (measured_.support[v] + neighbours_.mean(measured_.support, v, 0.0f)) / typical_;
      const float share =
          stands(mesh_.vertices[v], scale_) ? 1.0f : std::clamp(around, 0.02f, 1.0f);
      const float s = seen[v] * shared_bend(v) * std::sqrt(share * typical_) / feature;
      const float fade = 1.0f / ((1.0f + s * s) * (1.0f + s * s));
      stiff_[v] = float(scale_.stiffness) * typical_ * fade;
      alike_[v] = float(scale_.alike) * (1.0f - fade);
    });
  }

  const TriangleMesh& mesh_;
  const MeshNeighbours& neighbours_;
  const std::vector<Vec3f>& normals_;
  const VertexMeasurements& measured_;
  const MeshFitScale& scale_;
  float typical_;
  std::vector<float> bend_, stiff_, alike_;
};

}  // namespace

float typical_support(const std::vector<float>& support) {
  std::vector<float> some;
  std::copy_if(support.begin(), support.end(), std::back_inserter(some),
               [](float s) { return s > 0.01f; });
  return float(median(some, 1.0));
}

/// Offsets d that minimise sum w (d - own)^2 + sum m (bend + mean of the neighbours' d - d)^2 +
/// sum c (mean of the neighbours' d - d)^2. A bend that is too large to be noise is a feature, and
/// m fades (Geman and McClure) while c grows: the feature keeps its shape, and moves with its
/// neighbours rather than each vertex with its own noise.
std::vector<float> fitted_offsets(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
                                  const std::vector<Vec3f>& normals,
                                  const VertexMeasurements& measured, const MeshFitScale& scale) {
  return Bending(mesh, neighbours, normals, measured, scale).offsets();
}

}  // namespace turnscan::detail
