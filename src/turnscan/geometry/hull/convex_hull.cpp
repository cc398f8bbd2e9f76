#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/geometry/hull/convex_hull.hpp>
#include <unordered_map>

namespace turnscan {

namespace {

/// Points less than this share of the extent outside a face count as being on it.
constexpr double kOnFaceShare = 1e-6;

using Corners = std::array<std::uint32_t, 3>;

struct HullFace {
  Corners corners{};
  Vec3d normal = Vec3d::Zero();  // unit, outwards
  double offset = 0.0;
  std::vector<std::uint32_t> outside;  // points, each at one face only
  bool removed = false;
};

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t(from) << 32 | to;
}

class Quickhull {
 public:
  explicit Quickhull(std::span<const Vec3f> points) : points_(points) {}

  std::vector<Corners> run() {
    if (!make_first_faces()) return {};
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      while (!faces_[i].removed && !faces_[i].outside.empty()) add_farthest(i);
    }
    std::vector<Corners> out;
    for (const HullFace& face : faces_)
      if (!face.removed) out.push_back(face.corners);
    return out;
  }

 private:
  Vec3d at(std::uint32_t i) const { return points_[i].cast<double>(); }
  double above(const HullFace& face, std::uint32_t i) const {
    return face.normal.dot(at(i)) - face.offset;
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
    on_face_m_ = kOnFaceShare * extent;
    if (!(extent > 0.0)) return false;
    const Vec3d along = (at(b) - at(a)) / extent;
    const auto from_line = [&](const Vec3d& p) { return along.cross(p - at(a)).norm(); };
    const std::uint32_t c = largest(from_line);
    if (!(from_line(at(c)) > on_face_m_)) return false;
    const Vec3d normal = along.cross(at(c) - at(a)).normalized();
    const auto from_plane = [&](const Vec3d& p) { return std::abs(normal.dot(p - at(a))); };
    const std::uint32_t d = largest(from_plane);
    if (!(from_plane(at(d)) > on_face_m_)) return false;
    const bool below = normal.dot(at(d) - at(a)) < 0.0;
    const Corners base = below ? Corners{a, b, c} : Corners{a, c, b};
    add_face(base);
    for (int k = 0; k < 3; ++k) add_face({base[std::size_t((k + 1) % 3)], base[std::size_t(k)], d});
    std::vector<std::uint32_t> all(points_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    share_out(all, 0);
    return true;
  }

  void add_face(const Corners& corners) {
    HullFace face;
    face.corners = corners;
    face.normal =
        (at(corners[1]) - at(corners[0])).cross(at(corners[2]) - at(corners[0])).normalized();
    face.offset = face.normal.dot(at(corners[0]));
    for (std::size_t k = 0; k < 3; ++k)
      face_of_edge_[edge_key(corners[k], corners[(k + 1) % 3])] = faces_.size();
    faces_.push_back(std::move(face));
  }

  /// Assigns each point to the first face, starting at `first`, that it is outside of; others are
  /// inside.
  void share_out(const std::vector<std::uint32_t>& points, std::size_t first) {
    for (const std::uint32_t i : points) {
      for (std::size_t f = first; f < faces_.size(); ++f) {
        if (!(above(faces_[f], i) > on_face_m_)) continue;
        faces_[f].outside.push_back(i);
        break;
      }
    }
  }

  /// The faces that see a point are connected; their border is its horizon.
  void add_farthest(std::size_t start) {
    const auto& outside = faces_[start].outside;
    const std::uint32_t tip = *std::max_element(
        outside.begin(), outside.end(),
        [&](auto i, auto j) { return above(faces_[start], i) < above(faces_[start], j); });
    std::vector<std::size_t> seen{start};
    faces_[start].removed = true;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> horizon;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const Corners corners = faces_[seen[k]].corners;
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t from = corners[e], to = corners[(e + 1) % 3];
        HullFace& beyond = faces_[face_of_edge_.at(edge_key(to, from))];
        if (beyond.removed) continue;
        if (above(beyond, tip) > on_face_m_) {
          beyond.removed = true;
          seen.push_back(std::size_t(&beyond - faces_.data()));
        }
      }
    }
    std::vector<std::uint32_t> orphans;
    for (const std::size_t f : seen) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t from = faces_[f].corners[e], to = faces_[f].corners[(e + 1) % 3];
        if (!faces_[face_of_edge_.at(edge_key(to, from))].removed) horizon.emplace_back(from, to);
      }
      orphans.insert(orphans.end(), faces_[f].outside.begin(), faces_[f].outside.end());
      faces_[f].outside = {};
    }
    std::erase(orphans, tip);
    const std::size_t first = faces_.size();
    for (const auto& [from, to] : horizon) add_face({from, to, tip});
    share_out(orphans, first);
  }

  std::span<const Vec3f> points_;
  double on_face_m_ = 0.0;
  std::vector<HullFace> faces_;
  std::unordered_map<std::uint64_t, std::size_t> face_of_edge_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vec3f> points) {
  return Quickhull(points).run();
}

}  // namespace turnscan
