#include <algorithm>
#include <cmath>
#include <optional>
#include <turnscan/core/pose.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/motion_input/static_background.hpp>

namespace turnscan::motion {

namespace {

/// Half width of the window in which a plane is fitted, and the required number of pixels.
constexpr int kReach = 4;
constexpr int kMinKnown = 8;

class Continuation {
 public:
  explicit Continuation(const StaticBackground& depths)
      : in_(depths), w_(depths.width), h_(depths.height), known_(depths.seen.size(), 0.0f) {}

  std::vector<std::uint8_t> run() {
    keep_large_patches();
    std::vector<std::uint8_t> out(known_.size(), 0);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (in_.candidate[i] > 0.0f) open.push_back(i);
    while (!open.empty()) {
      std::vector<std::size_t> reached;
      for (const std::size_t i : open)
        if (beside_known(i) && continues(i)) reached.push_back(i);
      if (reached.empty()) break;
      for (const std::size_t i : reached) known_[i] = in_.candidate[i], out[i] = 1;
      std::erase_if(open, [&](std::size_t i) { return out[i] != 0; });
    }
    return out;
  }

 private:
  void keep_large_patches() {
    const auto candidates = double(
        std::count_if(in_.candidate.begin(), in_.candidate.end(), [](float z) { return z > 0; }));
    std::vector<std::uint8_t> visited(known_.size(), 0);
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (!(in_.seen[i] > 0.0f) || visited[i] != 0) continue;
      const std::vector<std::size_t> patch = patch_of(i, visited);
      if (double(patch.size()) < in_.least_patch * candidates) continue;
      for (const std::size_t k : patch) known_[k] = in_.seen[k];
    }
  }

  std::vector<std::size_t> patch_of(std::size_t start, std::vector<std::uint8_t>& visited) const {
    std::vector<std::size_t> out{start};
    visited[start] = 1;
    for (std::size_t next = 0; next < out.size(); ++next) {
      around(out[next], 1, [&](std::size_t k, int, int) {
        if (visited[k] != 0 || !(in_.seen[k] > 0.0f)) return;
        visited[k] = 1;
        out.push_back(k);
      });
    }
    return out;
  }

  bool beside_known(std::size_t i) const {
    bool out = false;
    around(i, 1, [&](std::size_t k, int, int) { out = out || known_[k] > 0.0f; });
    return out;
  }

  /// A plane is linear in inverse depth.
  bool continues(std::size_t i) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vec3d right = Vec3d::Zero();
    int count = 0;
    around(i, kReach, [&](std::size_t k, int u, int v) {
      if (!(known_[k] > 0.0f)) return;
      const Vec3d a(u, v, 1.0);
      normal += a * a.transpose(), right += a / double(known_[k]);
      ++count;
    });
    if (count < kMinKnown) return false;
    normal.diagonal().head<2>().array() += 1.0;  // collinear pixels do not constrain the plane
                                                 // across their line
    const double inverse = estimation::solve_ldlt(normal, right)[2];
    return inverse > 0.0 &&
           std::abs(1.0 / inverse - double(in_.candidate[i])) < double(in_.tolerance[i]);
  }

  template <class Use>
  void around(std::size_t i, int reach, const Use& use) const {
    const int x = int(i) % w_, y = int(i) / w_;
    for (int v = std::max(0, y - reach); v <= std::min(h_ - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(w_ - 1, x + reach); ++u)
        use(std::size_t(v) * std::size_t(w_) + std::size_t(u), u - x, v - y);
  }

  const StaticBackground& in_;
  int w_, h_;
  std::vector<float> known_;
};

}  // namespace

std::vector<std::uint8_t> continued_from_seen(const StaticBackground& depths) {
  return Continuation(depths).run();
}

}  // namespace turnscan::motion
