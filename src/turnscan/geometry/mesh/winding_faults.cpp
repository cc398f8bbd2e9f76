#include <algorithm>
#include <cmath>
#include <turnscan/geometry/mesh/winding_faults.hpp>

namespace turnscan {

namespace {

/// Offsets by which rays pass between vertices on a regular grid.
constexpr double kOffsetX = 0.31830988618, kOffsetZ = 0.36787944117;

struct RayHit {
  std::int64_t ray;
  double y;
  std::uint32_t triangle;
  int turn;  ///< change of the winding number as the ray goes upwards

  bool operator<(const RayHit& other) const {
    if (ray != other.ray) return ray < other.ray;
    if (y != other.y) return y < other.y;
    return triangle < other.triangle;
  }
};

/// Twice the area of a, b and the ray, seen along y; identical to the last bit, except for its
/// sign, for both triangles at an edge.
double turned_area(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, double x, double z) {
  if (a > b) return -turned_area(mesh, b, a, x, z);
  const Vec3d p = mesh.vertices[a].cast<double>(), q = mesh.vertices[b].cast<double>();
  return (q.z() - p.z()) * (x - p.x()) - (q.x() - p.x()) * (z - p.z());
}

class RayGrid {
 public:
  RayGrid(const TriangleMesh& mesh, double spacing_m) : mesh_(mesh), spacing_m_(spacing_m) {}

  std::vector<RayHit> hits() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) add(t);
    std::sort(hits_.begin(), hits_.end());
    return std::move(hits_);
  }

 private:
  void add(std::uint32_t t) {
    const auto& [a, b, c] = mesh_.triangles[t];
    const Vec3d p = mesh_.vertices[a].cast<double>(), q = mesh_.vertices[b].cast<double>(),
                r = mesh_.vertices[c].cast<double>();
    const auto first = [&](double least, double offset) {
      return std::int64_t(std::ceil(least / spacing_m_ - offset));
    };
    const double most_x = std::max({p.x(), q.x(), r.x()}), most_z = std::max({p.z(), q.z(), r.z()});
    for (std::int64_t k = first(std::min({p.z(), q.z(), r.z()}), kOffsetZ);; ++k) {
      const double z = (double(k) + kOffsetZ) * spacing_m_;
      if (z > most_z) break;
      for (std::int64_t i = first(std::min({p.x(), q.x(), r.x()}), kOffsetX);; ++i) {
        const double x = (double(i) + kOffsetX) * spacing_m_;
        if (x > most_x) break;
        const double w_r = turned_area(mesh_, a, b, x, z), w_p = turned_area(mesh_, b, c, x, z),
                     w_q = turned_area(mesh_, c, a, x, z);
        const bool up = w_p > 0.0 && w_q > 0.0 && w_r > 0.0;
        if (!up && !(w_p < 0.0 && w_q < 0.0 && w_r < 0.0)) continue;
        const double y = (w_p * p.y() + w_q * q.y() + w_r * r.y()) / (w_p + w_q + w_r);
        hits_.push_back({(k << 32) + i, y, t, up ? -1 : 1});
      }
    }
  }

  const TriangleMesh& mesh_;
  double spacing_m_;
  std::vector<RayHit> hits_;
};

}  // namespace

std::vector<std::uint8_t> winding_faults(const TriangleMesh& mesh, double spacing_m) {
  std::vector<std::uint8_t> faults(mesh.triangles.size(), 0);
  const std::vector<RayHit> hits = RayGrid(mesh, spacing_m).hits();
  int winding = 0;
  for (std::size_t h = 0; h < hits.size(); ++h) {
    if (h > 0 && hits[h].ray != hits[h - 1].ray) winding = 0;
    const int after = winding + hits[h].turn;
    if (std::min(winding, after) < 0 || std::max(winding, after) > 1) faults[hits[h].triangle] = 1;
    winding = after;
  }
  return faults;
}

}  // namespace turnscan
