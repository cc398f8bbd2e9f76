#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <utility>

namespace turnscan {

namespace {

/// Triangles near another that are asked: a mesh that is not made to hurt has some 30. The slivers
/// of a face of a million corners are all near each other; their pairs are limited to what takes
/// about a second, or three times what those of a sound mesh of so many triangles take.
constexpr std::size_t kMostNear = 1000, kLeastNear = 100;
constexpr std::size_t kMostPairs = std::size_t(1) << 25;

std::size_t most_near(std::size_t triangles) {
  return std::clamp(kMostPairs / std::max<std::size_t>(1, triangles), kLeastNear, kMostNear);
}

constexpr std::size_t kChunk = 1024;  // triangles between two looks at the context
constexpr std::uint8_t kPierced = 8;  ///< of the flags; the bits below are of the triangle's edges

using Triangle = std::array<std::uint32_t, 3>;

/// Six times the volume that three edges span, or 0 if it may be due to rounding.
double spanned(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double volume = a.dot(b.cross(c));
  const double rounding = 1e-14 * a.lpNorm<1>() * b.lpNorm<1>() * c.lpNorm<1>();
  return std::abs(volume) > rounding ? volume : 0.0;
}

class SelfIntersectionSearch {
 public:
  SelfIntersectionSearch(const TriangleMesh& mesh, std::span<const std::uint8_t> moved,
                         MeshDistance tree, const RunContext& context)
      : mesh_(mesh),
        moved_(moved),
        context_(context),
        tree_(std::move(tree)),
        most_near_(most_near(mesh.triangles.size())) {}

  SelfIntersections run() {
    SelfIntersections out;
    out.triangles.assign(mesh_.triangles.size(), 0);
    const std::size_t n = mesh_.triangles.size();
    (void)parallel_for((n + kChunk - 1) / kChunk, 1, context_, [&](std::size_t c) {
      ask(c * kChunk, std::min(n, (c + 1) * kChunk), out.triangles);
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < out.triangles.size(); ++t) {
      const Triangle& corners = mesh_.triangles[t];
      for (std::size_t c = 0; c < 3; ++c)
        if (out.triangles[t] & (1 << c))
          edges.push_back(std::minmax(corners[c], corners[(c + 1) % 3]));
      out.triangles[t] = out.triangles[t] != 0 ? 1 : 0;
    }
    std::sort(edges.begin(), edges.end());
    out.edges = std::size_t(std::unique(edges.begin(), edges.end()) - edges.begin());
    return out;
  }

 private:
  Vec3d at(std::uint32_t v) const { return mesh_.vertices[v].cast<double>(); }
  bool moved(std::size_t t) const { return moved_.empty() || moved_[t] != 0; }

  void ask(std::size_t begin, std::size_t end, std::vector<std::uint8_t>& flags) const {
    std::vector<std::uint32_t> near;
    for (std::size_t t = begin; t < end; ++t) {
      if (!moved(t)) continue;
      const Triangle& own = mesh_.triangles[t];
      if (std::max({own[0], own[1], own[2]}) >= mesh_.vertices.size()) continue;
      const Vec3f &p = mesh_.vertices[own[0]], &q = mesh_.vertices[own[1]],
                  &r = mesh_.vertices[own[2]];
      near.clear();
      tree_.append_near(p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r), most_near_, near);
      for (const std::uint32_t other : near) {
        if (other == t || (other < t && moved(other)) || !straddles(mesh_.triangles[other], own))
          continue;
        mark(std::uint32_t(t), other, flags);
        mark(other, std::uint32_t(t), flags);
      }
    }
  }

  /// Whether a triangle has corners on both sides of another's plane; only then can they pass
  /// through each other.
  bool straddles(const Triangle& triangle, const Triangle& plane) const {
    const Vec3d x = at(plane[0]), y = at(plane[1]) - x, z = at(plane[2]) - x;
    double low = 0.0, high = 0.0;
    for (const std::uint32_t v : triangle) {
      const double above = spanned(at(v) - x, y, z);
      low = std::min(low, above);
      high = std::max(high, above);
    }
    return low < 0.0 && high > 0.0;
  }

  /// Marks the edges of one triangle that pass through another, or its border, and the other.
  void mark(std::uint32_t by, std::uint32_t through, std::vector<std::uint8_t>& flags) const {
    const Triangle &own = mesh_.triangles[by], &other = mesh_.triangles[through];
    std::array<bool, 3> shared{};
    for (std::size_t c = 0; c < 3; ++c)
      shared[c] = std::find(other.begin(), other.end(), own[c]) != other.end();
    if (int(shared[0]) + int(shared[1]) + int(shared[2]) > 1) return;
    const Vec3d x = at(other[0]), y = at(other[1]), z = at(other[2]);
    std::array<double, 3> above;
    for (std::size_t c = 0; c < 3; ++c) above[c] = spanned(at(own[c]) - x, y - x, z - x);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      if (shared[c] || shared[next] || !(above[c] * above[next] < 0.0)) continue;
      const Vec3d p = at(own[c]), along = at(own[next]) - p;
      const double u = spanned(along, x - p, y - p), v = spanned(along, y - p, z - p),
                   w = spanned(along, z - p, x - p);
      if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) continue;
      // Pairs of other threads may mark the same triangle.
      std::atomic_ref(flags[by]).fetch_or(std::uint8_t(1 << c), std::memory_order_relaxed);
      std::atomic_ref(flags[through]).fetch_or(kPierced, std::memory_order_relaxed);
    }
  }

  const TriangleMesh& mesh_;
  std::span<const std::uint8_t> moved_;
  const RunContext& context_;
  MeshDistance tree_;
  std::size_t most_near_;
};

}  // namespace

SelfIntersections self_intersections(const TriangleMesh& mesh, std::span<const std::uint8_t> moved,
                                     const RunContext& context) {
  auto tree = MeshDistance::create(mesh, context);
  if (!tree) return {0, std::vector<std::uint8_t>(mesh.triangles.size(), 0)};
  return SelfIntersectionSearch(mesh, moved, std::move(*tree), context).run();
}

}  // namespace turnscan
