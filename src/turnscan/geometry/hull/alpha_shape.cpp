#include <algorithm>
#include <limits>
#include <turnscan/geometry/hull/alpha_shape.hpp>

namespace turnscan {

namespace {

using AlphaCorners = std::array<std::uint32_t, 3>;

struct AlphaSphere {
  Vec3d centre;
  double squared_radius;  ///< infinite if the points are degenerate
};

AlphaSphere no_sphere() { return {Vec3d::Zero(), std::numeric_limits<double>::infinity()}; }

/// The sphere through the corner at the origin and three others.
AlphaSphere sphere_through(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double volume = 2.0 * a.dot(b.cross(c));
  if (volume == 0.0) return no_sphere();
  const Vec3d centre =
      (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)) /
      volume;
  return {centre, centre.squaredNorm()};
}

/// The smallest sphere through the corner at the origin and two others: its centre is in their
/// plane.
AlphaSphere circle_through(const Vec3d& a, const Vec3d& b) {
  const Vec3d normal = a.cross(b);
  if (normal.squaredNorm() == 0.0) return no_sphere();
  const Vec3d centre = (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) /
                       (2.0 * normal.squaredNorm());
  return {centre, centre.squaredNorm()};
}

/// A triangle as a face of one of its tetrahedra, facing away from it.
struct AlphaSide {
  AlphaCorners sorted;
  AlphaCorners outward;
  std::uint32_t apex;
  bool kept;
};

class AlphaShape {
 public:
  AlphaShape(std::span<const Vec3f> points, double alpha_m)
      : points_(points), squared_alpha_(alpha_m * alpha_m) {}

  TriangleMesh of(std::span<const Tetrahedron> delaunay) {
    sides_.reserve(4 * delaunay.size());
    for (const Tetrahedron& t : delaunay) add_sides(t);
    std::sort(sides_.begin(), sides_.end(), [](const AlphaSide& a, const AlphaSide& b) {
      return a.sorted != b.sorted ? a.sorted < b.sorted : a.apex < b.apex;
    });
    std::vector<AlphaCorners> boundary;
    for (std::size_t i = 0; i < sides_.size();) {
      std::size_t end = i + 1;
      while (end < sides_.size() && sides_[end].sorted == sides_[i].sorted) ++end;
      add_if_boundary({sides_.data() + i, end - i}, boundary);
      i = end;
    }
    return mesh_of(boundary);
  }

 private:
  Vec3d at(std::uint32_t i) const { return points_[i].cast<double>(); }

  void add_sides(const Tetrahedron& t) {
    const Vec3d o = at(t[0]), a = at(t[1]) - o, b = at(t[2]) - o, c = at(t[3]) - o;
    const bool kept = sphere_through(a, b, c).squared_radius <= squared_alpha_;
    const bool positive = a.dot(b.cross(c)) > 0.0;
    for (unsigned k = 0; k < 4; ++k) {
      AlphaCorners outward{t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      if ((k % 2 == 0) != positive) std::swap(outward[1], outward[2]);
      AlphaCorners sorted = outward;
      std::sort(sorted.begin(), sorted.end());
      sides_.push_back({sorted, outward, t[k], kept});
    }
  }

  /// Adds a triangle with one or two adjacent tetrahedra.
  void add_if_boundary(std::span<const AlphaSide> beside, std::vector<AlphaCorners>& boundary) {
    const auto kept = std::count_if(beside.begin(), beside.end(),
                                    [](const AlphaSide& side) { return side.kept; });
    if (kept == 0 && is_singular(beside)) boundary.push_back(beside[0].outward);
    if (kept == 1) boundary.push_back((beside[0].kept ? beside[0] : beside[1]).outward);
  }

  bool is_singular(std::span<const AlphaSide> beside) const {
    const AlphaCorners& t = beside[0].sorted;
    const Vec3d o = at(t[0]);
    const AlphaSphere sphere = circle_through(at(t[1]) - o, at(t[2]) - o);
    if (!(sphere.squared_radius <= squared_alpha_)) return false;
    return std::all_of(beside.begin(), beside.end(), [&](const AlphaSide& side) {
      return (at(side.apex) - o - sphere.centre).squaredNorm() >= sphere.squared_radius;
    });
  }

  TriangleMesh mesh_of(const std::vector<AlphaCorners>& triangles) const {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(points_.size(), kUnused);
    for (const AlphaCorners& t : triangles)
      for (const std::uint32_t corner : t) place[corner] = 0;
    TriangleMesh mesh;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (place[i] == kUnused) continue;
      place[i] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(points_[i]);
    }
    for (const AlphaCorners& t : triangles)
      mesh.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
    return mesh;
  }

  std::span<const Vec3f> points_;
  double squared_alpha_;
  std::vector<AlphaSide> sides_;
};

}  // namespace

TriangleMesh alpha_shape(std::span<const Vec3f> points, std::span<const Tetrahedron> delaunay,
                         double alpha_m) {
  return AlphaShape(points, alpha_m).of(delaunay);
}

}  // namespace turnscan
