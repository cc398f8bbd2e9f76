#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/quality/touching.hpp>

namespace turnscan::quality {

namespace {

constexpr int kDirections = 36;
constexpr double kNarrow = 0.25;    ///< relative to the largest section of the smaller side
constexpr double kMinVolume = 0.1;  ///< relative to the whole

constexpr double kShort_m = 0.01;  ///< distance to either side at which sections are twice as large

/// One of many parallel sections.
struct Section {
  double area_m2 = 0.0, length_m = 0.0;
  Vec3d middle_m = Vec3d::Zero();  ///< centroid of its outline, times its length
};

/// The part on one side of a section.
struct Side {
  double volume = 0.0, moment = 0.0, largest = 0.0;  ///< in sections
  double low = 1e9, high = -1e9;  ///< extent of the contact area along the normal

  void add(const Section& section, double along_m) {
    volume += section.area_m2;
    moment += section.area_m2 * along_m;
    largest = std::max(largest, section.area_m2);
  }
  bool stands() const {
    const double middle = volume > 0.0 ? moment / volume : 1e9;
    return middle >= low && middle <= high;
  }
};

class Sections {
 public:
  Sections(const TriangleMesh& mesh, const Vec3d& normal, double step_m)
      : mesh_(mesh), normal_(normal), across_(normal.cross(Vec3d::UnitY())), step_m_(step_m) {
    double low = 1e9, high = -1e9;
    std::vector<double> along_m;
    along_m.reserve(mesh.vertices.size());
    for (const Vec3f& p : mesh.vertices) {
      along_m.push_back(along(p));
      low = std::min(low, along_m.back());
      high = std::max(high, along_m.back());
    }
    first_m_ = low + 0.5 * step_m;
    sections_.resize(std::size_t(std::max(0.0, std::ceil((high - first_m_) / step_m))));
    for (const auto& triangle : mesh.triangles) cut(triangle, along_m);
  }

  /// The narrowest section that separates parts which may stand by themselves, if it is narrower
  /// than the neck.
  void find_neck(double stands_below_m, std::optional<Neck>& neck, bool& is_bar) const {
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const Section& section = sections_[i];
      if (!(section.length_m > 0.0)) continue;
      Side before, after;
      for (std::size_t j = 0; j < sections_.size(); ++j)
        if (j != i) (j < i ? before : after).add(sections_[j], at(j));
      const double lesser = std::min(before.largest, after.largest);
      const double share = section.area_m2 / lesser;
      const double whole = before.volume + after.volume;
      if (!(share < (neck ? neck->share : kNarrow)) ||
          std::min(before.volume, after.volume) < kMinVolume * whole)
        continue;
      add_feet(stands_below_m, at(i), before, after);
      if (!before.stands() || !after.stands()) continue;
      neck = Neck{section.middle_m / section.length_m, section.area_m2, share};
      is_bar = !is_short(i);
    }
  }

 private:
  double along(const Vec3f& p) const { return normal_.dot(p.cast<double>()); }
  double at(std::size_t section) const { return first_m_ + double(section) * step_m_; }

  void cut(const std::array<std::uint32_t, 3>& triangle, const std::vector<double>& along_m) {
    const std::array<double, 3> d{along_m[triangle[0]], along_m[triangle[1]], along_m[triangle[2]]};
    const auto [low, high] = std::minmax({d[0], d[1], d[2]});
    const double from = std::max(0.0, std::ceil((low - first_m_) / step_m_));
    for (auto s = std::size_t(from); s < sections_.size() && at(s) < high; ++s)
      add_segment(triangle, d, at(s), sections_[s]);
  }

  /// Its contribution to the area is the area between it and the height 0, by Green's theorem.
  void add_segment(const std::array<std::uint32_t, 3>& triangle, const std::array<double, 3>& d,
                   double plane, Section& section) const {
    Vec3d up = Vec3d::Zero(), down = Vec3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if ((d[k] < plane) == (d[next] < plane)) continue;
      const Vec3d a = mesh_.vertices[triangle[k]].cast<double>();
      const Vec3d b = mesh_.vertices[triangle[next]].cast<double>();
      (d[k] < plane ? up : down) = a + (plane - d[k]) / (d[next] - d[k]) * (b - a);
    }
    section.area_m2 += 0.5 * (up.y() + down.y()) * across_.dot(up - down);
    section.length_m += (up - down).norm();
    section.middle_m += (up - down).norm() * 0.5 * (up + down);
  }

  /// Where two objects touch they soon widen; a bar does not.
  bool is_short(std::size_t neck) const {
    const auto reach = std::size_t(std::lround(kShort_m / step_m_));
    if (neck < reach || neck + reach >= sections_.size()) return false;
    const double wide = 2.0 * sections_[neck].area_m2;
    return sections_[neck - reach].area_m2 > wide && sections_[neck + reach].area_m2 > wide;
  }

  void add_feet(double stands_below_m, double plane, Side& before, Side& after) const {
    for (const Vec3f& p : mesh_.vertices) {
      if (double(p.y()) > stands_below_m) continue;
      const double d = along(p);
      Side& side = d < plane ? before : after;
      side.low = std::min(side.low, d);
      side.high = std::max(side.high, d);
    }
  }

  const TriangleMesh& mesh_;
  const Vec3d normal_, across_;
  const double step_m_;
  double first_m_ = 0.0;
  std::vector<Section> sections_;
};

}  // namespace

std::optional<Neck> narrowest_neck(const TriangleMesh& mesh, double step_m, double stands_below_m) {
  std::vector<std::optional<Sections>> sections(kDirections);
  parallel_for(sections.size(), 1, [&](std::size_t i) {
    const double angle = std::numbers::pi * double(i) / kDirections;
    sections[i].emplace(mesh, Vec3d(std::cos(angle), 0.0, std::sin(angle)), step_m);
  });
  std::optional<Neck> neck;
  bool is_bar = false;  // type of the narrowest section
  for (const auto& one : sections) one->find_neck(stands_below_m, neck, is_bar);
  return is_bar ? std::nullopt : neck;
}

}  // namespace turnscan::quality
