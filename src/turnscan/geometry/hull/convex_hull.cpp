#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/geometry/hull/convex_hull.hpp>

namespace turnscan {

namespace {

/// Points less than this share of the extent outside a face count as being on it.
constexpr double kOnFaceShare = 1e-6;
/// Points are rounded to a grid with this many steps in the extent, finer than floats are, and fine
/// enough for normals in 64 bits and volumes in 128: then which side of a face a point is on is
/// known exactly, and the faces that a point sees are connected and have one border, however flat,
/// round or crowded the points are.
constexpr double kGridSteps = 1 << 30;

__extension__ using Int128 = __int128;
using GridVector = Eigen::Matrix<std::int64_t, 3, 1>;
using Corners = std::array<std::uint32_t, 3>;

Int128 exact_dot(const GridVector& normal, const GridVector& v) {
  return Int128(normal.x()) * v.x() + Int128(normal.y()) * v.y() + Int128(normal.z()) * v.z();
}

struct HullFace {
  Corners corners{};
  Corners beyond{};                        // faces across the edges from each corner to the next
  GridVector normal = GridVector::Zero();  // outwards
  Vec3d unit = Vec3d::Zero();              // the normal's direction
  std::vector<std::uint32_t> outside;      // points, each at one face only
  bool removed = false;
};

/// An edge between a face that a point sees and one that it does not see.
struct HorizonEdge {
  std::uint32_t from, to, beyond;
};

class Quickhull {
 public:
  explicit Quickhull(std::span<const Vec3f> points) : points_(points) {}

  std::vector<Corners> run() {
    if (!make_first_faces()) return {};
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      while (!faces_[i].removed && !faces_[i].outside.empty()) add_farthest(i);
    }
    std::vector<Corners> out;
    for (const HullFace& face : faces_)
      if (!face.removed) out.push_back(face.corners);
    return out;
  }

 private:
  Vec3d at(std::uint32_t i) const { return points_[i].cast<double>(); }
  /// In steps of the grid, times the length of the face's normal; exact.
  Int128 volume(const HullFace& face, std::uint32_t i) const {
    return exact_dot(face.normal, grid_[i] - grid_[face.corners[0]]);
  }
  /// In steps of the grid, to a millionth of one: for which points are far enough outside, where
  /// exactness is not needed and 128 bits take 2.6 times as long (a million points in a ball).
  double above(const HullFace& face, std::uint32_t i) const {
    return face.unit.dot((grid_[i] - grid_[face.corners[0]]).cast<double>());
  }

  template <class Measure>
  std::uint32_t largest(const Measure& measure) const {
    std::uint32_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const double value = measure(at(i));
      if (value > most) most = value, best = i;
    }
    return best;
  }

  bool make_first_faces() {
    if (points_.size() < 4 ||
        !std::all_of(points_.begin(), points_.end(), [](const Vec3f& p) { return p.allFinite(); }))
      return false;
    const std::uint32_t a = largest([](const Vec3d& p) { return p.x(); });
    const std::uint32_t b = largest([&](const Vec3d& p) { return (p - at(a)).squaredNorm(); });
    const double extent = (at(b) - at(a)).norm();
    if (!(extent > 0.0)) return false;
    const double on_face_m = kOnFaceShare * extent;
    const Vec3d along = (at(b) - at(a)) / extent;
    const auto from_line = [&](const Vec3d& p) { return along.cross(p - at(a)).norm(); };
    const std::uint32_t c = largest(from_line);
    if (!(from_line(at(c)) > on_face_m)) return false;
    const Vec3d normal = along.cross(at(c) - at(a)).normalized();
    const auto from_plane = [&](const Vec3d& p) { return std::abs(normal.dot(p - at(a))); };
    const std::uint32_t d = largest(from_plane);
    if (!(from_plane(at(d)) > on_face_m)) return false;
    face_from_.resize(points_.size());
    grid_.reserve(points_.size());
    for (const Vec3f& p : points_)
      grid_.push_back(((p.cast<double>() - at(a)) * (kGridSteps / extent))
                          .array()
                          .round()
                          .matrix()
                          .cast<std::int64_t>());
    const bool below = normal.dot(at(d) - at(a)) < 0.0;
    const Corners base = below ? Corners{a, b, c} : Corners{a, c, b};
    add_face(base);
    add_cone({{base[1], base[0], 0}, {base[0], base[2], 0}, {base[2], base[1], 0}}, d);
    std::vector<std::uint32_t> all(points_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    share_out(all, 0);
    return true;
  }

  HullFace& add_face(const Corners& corners) {
    HullFace& face = faces_.emplace_back();
    face.corners = corners;
    const GridVector origin = grid_[corners[0]];
    face.normal = (grid_[corners[1]] - origin).cross(grid_[corners[2]] - origin);
    face.unit = face.normal.cast<double>().normalized();
    return face;
  }

  /// Faces from the edges of a horizon to its tip.
  void add_cone(const std::vector<HorizonEdge>& horizon, std::uint32_t tip) {
    for (const auto& [from, to, beyond] : horizon) {
      const auto here = std::uint32_t(faces_.size());
      face_from_[from] = here;
      add_face({from, to, tip}).beyond[0] = beyond;
      for (std::size_t k = 0; k < 3; ++k)
        if (faces_[beyond].corners[k] == to) faces_[beyond].beyond[k] = here;
    }
    for (const auto& [from, to, beyond] : horizon) {
      faces_[face_from_[from]].beyond[1] = face_from_[to];
      faces_[face_from_[to]].beyond[2] = face_from_[from];
    }
  }

  /// Assigns each point to the first face, starting at `first`, that it is outside of; others are
  /// inside.
  void share_out(const std::vector<std::uint32_t>& points, std::size_t first) {
    for (const std::uint32_t i : points) {
      for (std::size_t f = first; f < faces_.size(); ++f) {
        if (!(above(faces_[f], i) > kOnFaceShare * kGridSteps)) continue;
        faces_[f].outside.push_back(i);
        break;
      }
    }
  }

  /// The faces that see a point are connected; their border is its horizon.
  void add_farthest(std::uint32_t start) {
    const auto& outside = faces_[start].outside;
    const std::uint32_t tip = *std::max_element(
        outside.begin(), outside.end(),
        [&](auto i, auto j) { return above(faces_[start], i) < above(faces_[start], j); });
    std::vector<std::uint32_t> seen{start}, orphans;
    std::vector<HorizonEdge> horizon;
    faces_[start].removed = true;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      for (const std::uint32_t beyond : faces_[seen[k]].beyond) {
        if (faces_[beyond].removed || volume(faces_[beyond], tip) <= 0) continue;
        faces_[beyond].removed = true;
        seen.push_back(beyond);
      }
    }
    for (const std::uint32_t f : seen) {
      HullFace& face = faces_[f];
      for (std::size_t e = 0; e < 3; ++e)
        if (!faces_[face.beyond[e]].removed)
          horizon.push_back({face.corners[e], face.corners[(e + 1) % 3], face.beyond[e]});
      orphans.insert(orphans.end(), face.outside.begin(), face.outside.end());
      face.outside = {};
    }
    std::erase(orphans, tip);
    const std::size_t first = faces_.size();
    add_cone(horizon, tip);
    share_out(orphans, first);
  }

  std::span<const Vec3f> points_;
  std::vector<GridVector> grid_;
  std::vector<HullFace> faces_;
  std::vector<std::uint32_t> face_from_;  // of the last cone, by the corner that it starts at
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vec3f> points) {
  return Quickhull(points).run();
}

}  // namespace turnscan
