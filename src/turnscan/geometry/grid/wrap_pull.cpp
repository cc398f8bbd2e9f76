#include <algorithm>
#include <span>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/grid/wrap_steps.hpp>

namespace turnscan::grid {
namespace {

/// How near to the soup a wrap's vertices may come, so that the two sides of a sheet stay apart.
constexpr double kStandOffCells = 0.02;
constexpr int kMaxPullRounds = 12;
constexpr int kMaxEaseRounds = 10;

class Puller {
 public:
  Puller(TriangleMesh& mesh, const MeshDistance& soup, double cell_m)
      : mesh_(mesh),
        soup_(soup),
        stand_off_(kStandOffCells * cell_m),
        from_(mesh.vertices),
        fraction_(mesh.vertices.size(), 1.0f) {
    target_.resize(from_.size());
    outward_.resize(from_.size());
    parallel_for(from_.size(), 1024, [&](std::size_t v) {
      target_[v] = beside_soup(from_[v].cast<double>());
      outward_[v] = (from_[v] - target_[v]).normalized();
    });
  }

  Result<> run(const RunContext& context) {
    TURNSCAN_TRY(pull_straight(context));
    find_fans();
    for (int round = 0; round < kMaxEaseRounds; ++round) {
      TURNSCAN_TRY(context.check());
      if (!ease_stuck()) break;
    }
    return {};
  }

 private:
  /// The point at the stand-off from the soup's point that is nearest to p, on p's side.
  Vec3f beside_soup(const Vec3d& p) const {
    const auto hit = soup_.closest(p);
    const Vec3d away = p - hit.point;
    return (hit.point + away.normalized() * std::min(stand_off_, hit.distance)).cast<float>();
  }

  /// All at once along straight lines, less far where a triangle would turn over.
  Result<> pull_straight(const RunContext& context) {
    std::vector<std::uint8_t> shorten(from_.size(), 0);
    for (int round = 0;; ++round) {
      TURNSCAN_TRY(context.check());
      for (std::size_t v = 0; v < from_.size(); ++v) {
        mesh_.vertices[v] = from_[v] + fraction_[v] * (target_[v] - from_[v]);
      }
      const std::vector<std::uint8_t> bad = turned_over();
      bool any = false;
      for (std::size_t t = 0; t < bad.size(); ++t) {
        if (bad[t] == 0) continue;
        any = true;
        for (const std::uint32_t v : mesh_.triangles[t]) shorten[v] = 1;
      }
      if (!any) return {};
      for (std::size_t v = 0; v < fraction_.size(); ++v) {
        if (shorten[v] != 0) fraction_[v] = round < kMaxPullRounds ? 0.6f * fraction_[v] : 0.0f;
        shorten[v] = 0;
      }
    }
  }

  std::vector<std::uint8_t> turned_over() const {
    std::vector<std::uint8_t> bad(mesh_.triangles.size(), 0);
    parallel_for(bad.size(), 4096, [&](std::size_t t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (fraction_[a] == 0.0f && fraction_[b] == 0.0f && fraction_[c] == 0.0f) return;
      bad[t] = !(normal(from_, a, b, c).dot(normal(mesh_.vertices, a, b, c)) > 0.0);
    });
    return bad;
  }

  void find_fans() {
    fan_start_.assign(from_.size() + 1, 0);
    for (const auto& t : mesh_.triangles) {
      for (const std::uint32_t v : t) ++fan_start_[v + 1];
    }
    for (std::size_t v = 1; v < fan_start_.size(); ++v) fan_start_[v] += fan_start_[v - 1];
    fans_.resize(fan_start_.back());
    std::vector<std::uint32_t> cursor(fan_start_.begin(), fan_start_.end() - 1);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) fans_[cursor[v]++] = t;
    }
  }

  std::span<const std::uint32_t> fan(std::size_t v) const {
    return std::span(fans_).subspan(fan_start_[v], fan_start_[v + 1] - fan_start_[v]);
  }

  /// One after the other, vertices that were stopped move to the soup beside their neighbours'
  /// middle, or else to that middle itself, if no triangle then faces the soup.
  bool ease_stuck() {
    bool any = false;
    for (std::size_t v = 0; v < fraction_.size(); ++v) {
      if (fraction_[v] == 1.0f) continue;
      const Vec3d middle = middle_of_neighbours(v);
      if (try_move(v, beside_soup(middle))) {
        any = true;
      } else {
        any |= try_move(v, middle.cast<float>());
      }
    }
    return any;
  }

  Vec3d middle_of_neighbours(std::size_t v) const {
    Vec3d sum = Vec3d::Zero();
    for (const std::uint32_t t : fan(v)) {
      for (const std::uint32_t w : mesh_.triangles[t]) {
        if (w != v) sum += mesh_.vertices[w].cast<double>();
      }
    }
    return sum / (2.0 * double(fan(v).size()));
  }

  bool try_move(std::size_t v, const Vec3f& to) {
    const Vec3f old = mesh_.vertices[v];
    mesh_.vertices[v] = to;
    for (const std::uint32_t t : fan(v)) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const Vec3d outward = (outward_[a] + outward_[b] + outward_[c]).cast<double>();
      if (normal(mesh_.vertices, a, b, c).dot(outward) > 0.0) continue;
      mesh_.vertices[v] = old;
      return false;
    }
    return true;
  }

  static Vec3d normal(const std::vector<Vec3f>& p, std::uint32_t a, std::uint32_t b,
                      std::uint32_t c) {
    return (p[b] - p[a]).cast<double>().cross((p[c] - p[a]).cast<double>());
  }

  TriangleMesh& mesh_;
  const MeshDistance& soup_;
  double stand_off_;
  std::vector<Vec3f> from_, target_, outward_;
  std::vector<float> fraction_;
  std::vector<std::uint32_t> fan_start_, fans_;  // triangles around each vertex
};

}  // namespace

Result<> pull_onto(const MeshDistance& soup, double cell_m, TriangleMesh& mesh,
                   const RunContext& context) {
  return Puller(mesh, soup, cell_m).run(context);
}

}  // namespace turnscan::grid
