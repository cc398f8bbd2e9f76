#include <algorithm>
#include <cmath>
#include <turnscan/geometry/mesh/hole_patch.hpp>

namespace turnscan::mesh {
namespace {

constexpr double kMaxTriangles = 300000.0;
constexpr int kMaxInsertionRounds = 40;
constexpr int kMaxFlipPasses = 12;

/// Triangles with adjacency: twin[h] is the half edge on the other side, kNone along the loop.
class PatchRefiner {
 public:
  PatchRefiner(HolePatch& patch, std::vector<double> scale, const EdgeTaken& taken)
      : patch_(patch), scale_(std::move(scale)), taken_(taken) {
    scale_.resize(patch.points.size());
    for (std::size_t i = patch.loop_size; i < patch.points.size(); ++i) {
      scale_[i] = mean_scale(patch.parents[i - patch.loop_size]);
    }
    connect();
  }

  void run() {
    limit_triangles();
    for (int round = 0; round < kMaxInsertionRounds; ++round) {
      flip_to_delaunay();
      if (!insert_points()) return;
    }
    flip_to_delaunay();
  }

 private:
  std::uint32_t& vertex(std::uint32_t h) { return patch_.triangles[h / 3][h % 3]; }
  std::uint32_t vertex(std::uint32_t h) const { return patch_.triangles[h / 3][h % 3]; }
  const Vec3d& point(std::uint32_t h) const { return patch_.points[vertex(h)]; }

  double mean_scale(const Triangle& t) const {
    return (scale_[t[0]] + scale_[t[1]] + scale_[t[2]]) / 3.0;
  }

  void connect() {
    twin_.assign(3 * patch_.triangles.size(), kNone);
    std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> edges;
    for (std::uint32_t h = 0; h < twin_.size(); ++h) {
      edges.push_back({std::minmax(vertex(h), vertex(next_in_triangle(h))), h});
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 1; i < edges.size(); ++i) {
      if (edges[i].first == edges[i - 1].first) set_twins(edges[i].second, edges[i - 1].second);
    }
  }

  void set_twins(std::uint32_t g, std::uint32_t h) {
    if (g != kNone) twin_[g] = h;
    if (h != kNone) twin_[h] = g;
  }

  void limit_triangles() {
    double wanted = 0.0;
    for (const Triangle& t : patch_.triangles) {
      const Vec3d& a = patch_.points[t[0]];
      const double area = 0.5 * (patch_.points[t[1]] - a).cross(patch_.points[t[2]] - a).norm();
      const double edge = mean_scale(t);
      wanted += edge > 0.0 ? std::min(area / (0.433 * edge * edge), 1e30) : 0.0;
    }
    if (!(wanted > kMaxTriangles)) return;
    const double larger = std::sqrt(wanted / kMaxTriangles);
    for (double& s : scale_) s *= larger;
  }

  /// Splits triangles whose centre is far from their corners, relative to the desired edge length
  /// there (Liepa 2003, section 4, with alpha = sqrt 2).
  bool insert_points() {
    bool any = false;
    const auto count = std::uint32_t(patch_.triangles.size());
    if (count > 2.0 * kMaxTriangles) return false;
    for (std::uint32_t t = 0; t < count; ++t) {
      const Triangle corners = patch_.triangles[t];
      const double scale = mean_scale(corners);
      const Vec3d middle =
          (patch_.points[corners[0]] + patch_.points[corners[1]] + patch_.points[corners[2]]) / 3.0;
      bool split = scale > 0.0;
      for (const std::uint32_t v : corners) {
        const double distance = std::sqrt(2.0) * (middle - patch_.points[v]).norm();
        split &= distance > scale && distance > scale_[v];
      }
      if (!split) continue;
      split_triangle(t, middle, scale);
      any = true;
    }
    return any;
  }

  void split_triangle(std::uint32_t t, const Vec3d& middle, double scale) {
    const auto center = std::uint32_t(patch_.points.size());
    const auto [a, b, c] = patch_.triangles[t];
    patch_.points.push_back(middle);
    patch_.parents.push_back({a, b, c});
    scale_.push_back(scale);
    const std::uint32_t first = 3 * t, second = std::uint32_t(twin_.size()), third = second + 3;
    const std::uint32_t outer_b = twin_[first + 1], outer_c = twin_[first + 2];
    patch_.triangles[t] = {a, b, center};
    patch_.triangles.push_back({b, c, center});
    patch_.triangles.push_back({c, a, center});
    twin_.resize(twin_.size() + 6, kNone);
    set_twins(second, outer_b);
    set_twins(third, outer_c);
    set_twins(first + 1, second + 2);
    set_twins(second + 1, third + 2);
    set_twins(third + 1, first + 2);
  }

  void flip_to_delaunay() {
    bool any = true;
    for (int pass = 0; any && pass < kMaxFlipPasses; ++pass) {
      any = false;
      for (std::uint32_t h = 0; h < twin_.size(); ++h) {
        if (twin_[h] == kNone || twin_[h] < h || !should_flip(h)) continue;
        flip(h);
        any = true;
      }
    }
  }

  /// Cotangent of the angle of h's triangle opposite to h.
  double opposite_cotangent(std::uint32_t h) const {
    const Vec3d& o = point(previous_in_triangle(h));
    const Vec3d u = point(h) - o, v = point(next_in_triangle(h)) - o;
    return u.dot(v) / std::max(u.cross(v).norm(), 1e-300);
  }

  static Vec3d normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return (b - a).cross(c - a);
  }

  bool should_flip(std::uint32_t h) const {
    const std::uint32_t g = twin_[h];
    if (!(opposite_cotangent(h) + opposite_cotangent(g) < -1e-6)) return false;
    const Vec3d &a = point(h), &b = point(g), &c = point(previous_in_triangle(h)),
                &d = point(previous_in_triangle(g));
    const double fold_before = normal(a, b, c).dot(normal(b, a, d));
    const double fold_after = normal(a, d, c).dot(normal(d, b, c));
    if (fold_after <= 0.0 && fold_before > 0.0) return false;
    return !joined(previous_in_triangle(h), vertex(previous_in_triangle(g)));
  }

  /// Whether the vertex at half edge h has an edge to v, in the patch or outside.
  bool joined(std::uint32_t h, std::uint32_t v) const {
    const std::uint32_t u = vertex(h);
    if (u == v || (u < patch_.loop_size && v < patch_.loop_size && taken_(u, v))) return true;
    std::uint32_t at = h;
    do {  // counter-clockwise
      if (vertex(next_in_triangle(at)) == v || vertex(previous_in_triangle(at)) == v) return true;
      at = twin_[previous_in_triangle(at)];
    } while (at != kNone && at != h);
    if (at == h) return false;
    for (at = twin_[h]; at != kNone; at = twin_[at]) {  // clockwise, to the other end of the loop
      at = next_in_triangle(at);
      if (vertex(next_in_triangle(at)) == v || vertex(previous_in_triangle(at)) == v) return true;
    }
    return false;
  }

  void flip(std::uint32_t h) {
    const std::uint32_t g = twin_[h];
    const std::uint32_t a = vertex(h), b = vertex(g), c = vertex(previous_in_triangle(h)),
                        d = vertex(previous_in_triangle(g));
    const std::uint32_t bc = twin_[next_in_triangle(h)], ca = twin_[previous_in_triangle(h)],
                        ad = twin_[next_in_triangle(g)], db = twin_[previous_in_triangle(g)];
    const std::uint32_t t = h / 3, s = g / 3;
    patch_.triangles[t] = {a, d, c};
    patch_.triangles[s] = {d, b, c};
    set_twins(3 * t, ad);
    set_twins(3 * t + 1, 3 * s + 2);
    set_twins(3 * t + 2, ca);
    set_twins(3 * s, db);
    set_twins(3 * s + 1, bc);
  }

  HolePatch& patch_;
  std::vector<double> scale_;
  const EdgeTaken& taken_;
  std::vector<std::uint32_t> twin_;
};

}  // namespace

void refine_patch(HolePatch& patch, std::vector<double> scale, const EdgeTaken& taken) {
  PatchRefiner(patch, std::move(scale), taken).run();
}

}  // namespace turnscan::mesh
