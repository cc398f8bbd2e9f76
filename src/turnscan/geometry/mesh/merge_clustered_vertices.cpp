#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/merge_clustered_vertices.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>

namespace turnscan {

namespace {

using mesh::kNone;

constexpr std::size_t kMaxAround = 40;  // triangles at one vertex
constexpr float kMinCosine = 0.5f;      // between a triangle's normals before and after
constexpr int kPasses = 2;

class EdgeCollapser {
 public:
  EdgeCollapser(TriangleMesh mesh, const ClusterScale& scale)
      : p_(std::move(mesh.vertices)), t_(std::move(mesh.triangles)), flat_(scale.flat_m) {
    const std::size_t n = p_.size();
    sample_.resize(n);
    parallel_for(n, 4096, [&](std::size_t v) {
      const Vec3d q = (p_[v].cast<double>() - scale.origin_m) / scale.cell_m;
      for (int a = 0; a < 3; ++a)
        sample_[v][std::size_t(a)] = int(std::lround(std::clamp(q[a], -1e9, 1e9)));
    });
    count_.assign(n, 1);
    first_.assign(n, kNone);
    last_.assign(n, kNone);
    next_.assign(3 * t_.size(), kNone);
    for (std::size_t h = 0; h < next_.size(); ++h) append(t_[h / 3][h % 3], std::uint32_t(h));
  }

  void run(const RunContext& context) {
    for (int pass = 0; pass < kPasses; ++pass) {
      for (std::size_t t = 0; t < t_.size(); ++t) {
        if (t % 65536 == 0 && context.cancelled()) return;
        for (std::size_t c = 0; c < 3 && alive(t); ++c) {
          const std::uint32_t a = t_[t][c], b = t_[t][(c + 1) % 3];
          if (sample_[a] == sample_[b]) join(std::min(a, b), std::max(a, b));
        }
      }
    }
  }

  TriangleMesh take(std::string name) {
    TriangleMesh out;
    out.name = std::move(name);
    out.vertices = std::move(p_);
    for (std::size_t t = 0; t < t_.size(); ++t) {
      if (alive(t)) out.triangles.push_back(t_[t]);
    }
    mesh::compact_vertices(out);
    return out;
  }

 private:
  bool alive(std::size_t t) const { return t_[t][0] != kNone; }

  void append(std::uint32_t v, std::uint32_t h) {
    (first_[v] == kNone ? first_[v] : next_[last_[v]]) = h;
    last_[v] = h;
  }

  /// Corners of the remaining triangles at v.
  bool corners(std::uint32_t v, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (std::uint32_t h = first_[v]; h != kNone; h = next_[h]) {
      if (alive(h / 3)) out.push_back(h);
    }
    return out.size() <= kMaxAround;
  }

  /// In a closed 2-manifold every neighbour follows v in exactly one triangle.
  void ring(const std::vector<std::uint32_t>& at, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const std::uint32_t h : at) out.push_back(t_[h / 3][(h % 3 + 1) % 3]);
    std::sort(out.begin(), out.end());
  }

  std::size_t valence(std::uint32_t v) const {
    std::size_t n = 0;
    for (std::uint32_t h = first_[v]; h != kNone; h = next_[h]) n += alive(h / 3) ? 1 : 0;
    return n;
  }

  Vec3f joined_position(std::uint32_t a, std::uint32_t b) const {
    if (flat_ && (p_[a].y() == *flat_) != (p_[b].y() == *flat_))
      return p_[a].y() == *flat_ ? p_[a] : p_[b];
    const float n = float(count_[a]), m = float(count_[b]);
    Vec3f mean = (n * p_[a] + m * p_[b]) / (n + m);
    if (flat_ && p_[a].y() == *flat_) mean.y() = *flat_;
    return mean;
  }

  /// Whether no triangle at v rotates too far if v moves; those that contain `gone` vanish.
  bool keeps_facing(const std::vector<std::uint32_t>& at, std::uint32_t gone,
                    const Vec3f& to) const {
    return std::all_of(at.begin(), at.end(), [&](std::uint32_t h) {
      const auto& t = t_[h / 3];
      const std::uint32_t b = t[(h % 3 + 1) % 3], c = t[(h % 3 + 2) % 3];
      if (b == gone || c == gone) return true;
      const Vec3f side = p_[c] - p_[b];
      const Vec3f before = (p_[b] - p_[t[h % 3]]).cross(side), after = (p_[b] - to).cross(side);
      return after.squaredNorm() > 0.0f &&
             before.dot(after) >= kMinCosine * before.norm() * after.norm();
    });
  }

  void join(std::uint32_t a, std::uint32_t b) {
    if (!corners(a, at_a_) || !corners(b, at_b_)) return;
    ring(at_a_, ring_a_);
    ring(at_b_, ring_b_);
    common_.clear();
    std::set_intersection(ring_a_.begin(), ring_a_.end(), ring_b_.begin(), ring_b_.end(),
                          std::back_inserter(common_));
    if (common_.size() != 2 || at_a_.size() + at_b_.size() < 7) return;
    if (valence(common_[0]) < 4 || valence(common_[1]) < 4) return;
    const Vec3f to = joined_position(a, b);
    if (!keeps_facing(at_a_, b, to) || !keeps_facing(at_b_, a, to)) return;
    p_[a] = to;
    count_[a] += count_[b];
    for (const std::uint32_t h : at_b_) {
      auto& t = t_[h / 3];
      if (std::find(t.begin(), t.end(), a) != t.end()) {
        t[0] = kNone;
        continue;
      }
      t[h % 3] = a;
      next_[h] = kNone;
      append(a, h);
    }
    first_[b] = kNone;
  }

  std::vector<Vec3f> p_;
  std::vector<std::array<std::uint32_t, 3>> t_;
  std::optional<float> flat_;
  std::vector<std::array<int, 3>> sample_;
  std::vector<std::uint32_t> count_;                // number of vertices merged into this one
  std::vector<std::uint32_t> first_, last_, next_;  // corners at a vertex, as lists
  std::vector<std::uint32_t> at_a_, at_b_, ring_a_, ring_b_, common_;
};

}  // namespace

Result<TriangleMesh> merge_clustered_vertices(TriangleMesh mesh, const ClusterScale& scale,
                                              const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  if (!(scale.cell_m > 0.0))
    throw std::invalid_argument("merge_clustered_vertices: cell_m must be positive");
  std::string name = std::move(mesh.name);
  EdgeCollapser collapser(std::move(mesh), scale);
  collapser.run(context);
  TURNSCAN_TRY(context.check());
  return collapser.take(std::move(name));
}

}  // namespace turnscan
