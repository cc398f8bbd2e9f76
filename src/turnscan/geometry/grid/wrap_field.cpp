#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/grid/wrap_steps.hpp>

namespace turnscan::grid {
namespace {

constexpr int kBrickSide = BrickGrid::kBrick;
constexpr std::size_t kChunk = 256;  // bricks between two looks at the context
/// Distances beyond this many cells past the offset are all the same to the wrap.
constexpr double kBandCells = 2.0;
constexpr std::size_t kMaxBytes = std::size_t(4) << 30;  // of grid memory

Box bounds_of_triangles(const TriangleMesh& mesh) {
  Box box;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.add(mesh.vertices[v].cast<double>());
  }
  return box;
}

class DistanceField {
 public:
  DistanceField(const MeshDistance& soup, double cell_m, const RunContext& context)
      : soup_(soup), cell_m_(cell_m), band_m_((1.0 + kBandCells) * cell_m), context_(context) {}

  /// Distance - offset near the soup; where flood from outside does not reach, negative.
  Result<BrickGrid> run(const Box& box) {
    TURNSCAN_TRY(create_grid(box));
    TURNSCAN_TRY(touch_near_bricks());
    TURNSCAN_TRY(measure());
    TURNSCAN_TRY(flood());
    sign_values();
    return std::move(grid_);
  }

 private:
  Result<> create_grid(const Box& box) {
    // Faces of a box must not lie just at the offset from samples, where rounding decides.
    const double margin = cell_m_ + (kBandCells + 1.37) * cell_m_;
    std::array<int, 3> size{};
    for (int axis = 0; axis < 3; ++axis) {
      const double samples = std::ceil((box.size()[axis] + 2.0 * margin) / cell_m_) + 1.0;
      size[std::size_t(axis)] = int(std::min(samples, 2e9));
    }
    TURNSCAN_ASSIGN(grid_, BrickGrid::create(box.min - Vec3d::Constant(margin), cell_m_, size,
                                             float(band_m_), kMaxBytes));
    return {};
  }

  Vec3d brick_center(const std::array<int, 3>& b, double half) const {
    return grid_.position(b[0] * kBrickSide, b[1] * kBrickSide, b[2] * kBrickSide) +
           Vec3d::Constant(half);
  }

  bool is_near(const Vec3d& center, double half) const {
    const double reach = band_m_ + std::sqrt(3.0) * half;
    return soup_.closest(center, reach).triangle != MeshDistance::kNone;
  }

  Result<> touch_near_bricks() {
    const std::size_t count = grid_.brick_count();
    std::vector<std::uint8_t> near(count, 0);
    const double half = 0.5 * (kBrickSide - 1) * cell_m_;
    context_.begin_phase("measure distances", 0);
    TURNSCAN_TRY(parallel_for((count + kChunk - 1) / kChunk, 1, context_, [&](std::size_t c) {
      for (std::size_t b = c * kChunk; b < std::min(count, (c + 1) * kChunk); ++b) {
        near[b] = is_near(brick_center(grid_.brick_at(b), half), half);
      }
    }));
    for (std::size_t b = 0; b < count; ++b) {
      if (near[b] != 0) near_.push_back(b);
    }
    return grid_.allocate(near_);
  }

  Result<> measure() {
    context_.begin_phase("measure distances", near_.size());
    return parallel_for(near_.size(), 4, context_, [&](std::size_t i) {
      measure_brick(near_[i]);
      context_.advance();
    });
  }

  /// Blocks of 4^3 samples that the soup is not near keep the band's distance.
  void measure_brick(std::size_t brick) {
    float* samples = grid_.samples(brick);
    const auto b = grid_.brick_at(brick);
    const double half = 1.5 * cell_m_;
    for (int block = 0; block < 8; ++block) {
      const int i0 = b[0] * kBrickSide + 4 * (block & 1),
                j0 = b[1] * kBrickSide + 4 * (block >> 1 & 1),
                k0 = b[2] * kBrickSide + 4 * (block >> 2);
      if (!is_near(grid_.position(i0, j0, k0) + Vec3d::Constant(half), half)) continue;
      for (int s = 0; s < 64; ++s) {
        const int i = i0 + (s & 3), j = j0 + (s >> 2 & 3), k = k0 + (s >> 4);
        const auto hit = soup_.closest(grid_.position(i, j, k), band_m_);
        if (hit.triangle == MeshDistance::kNone) continue;
        samples[BrickGrid::within(i, j, k)] = float(hit.distance);
      }
    }
  }

  bool passable(float distance) const { return double(distance) > cell_m_; }

  /// Marks the samples that can be reached from the grid's corner along axes without coming nearer
  /// to the soup than the offset. A brick far from the soup is passed as one.
  Result<> flood() {
    context_.begin_phase("wrap", 0);
    slot_.assign(grid_.brick_count(), -1);
    for (std::size_t i = 0; i < near_.size(); ++i) slot_[near_[i]] = std::int32_t(i);
    reached_.assign(near_.size() * BrickGrid::kBrickSamples, 0);
    far_reached_.assign(grid_.brick_count(), 0);
    visit({0, 0, 0});
    std::size_t steps = 0;
    while (!open_.empty()) {
      if (++steps % 65536 == 0) TURNSCAN_TRY(context_.check());
      const auto [i, j, k] = open_.back();
      open_.pop_back();
      if (i < 0) {
        leave_far_brick(std::size_t(j) | std::size_t(k) << 31);
        continue;
      }
      visit({i - 1, j, k});
      visit({i + 1, j, k});
      visit({i, j - 1, k});
      visit({i, j + 1, k});
      visit({i, j, k - 1});
      visit({i, j, k + 1});
    }
    return {};
  }

  void visit(const std::array<int, 3>& s) {
    const auto& n = grid_.size();
    const auto [i, j, k] = s;
    if (i < 0 || j < 0 || k < 0 || i >= n[0] || j >= n[1] || k >= n[2]) return;
    const std::size_t brick = grid_.brick_index(i / kBrickSide, j / kBrickSide, k / kBrickSide);
    if (slot_[brick] < 0) {
      if (far_reached_[brick] != 0) return;
      far_reached_[brick] = 1;
      open_.push_back({-1, int(brick & 0x7fffffff), int(brick >> 31)});
      return;
    }
    const std::size_t within = BrickGrid::within(i, j, k);
    std::uint8_t& reached = reached_[std::size_t(slot_[brick]) * BrickGrid::kBrickSamples + within];
    if (reached != 0 || !passable(grid_.samples(brick)[within])) return;
    reached = 1;
    open_.push_back(s);
  }

  void leave_far_brick(std::size_t brick) {
    const auto b = grid_.brick_at(brick);
    const int low[3] = {b[0] * kBrickSide, b[1] * kBrickSide, b[2] * kBrickSide};
    for (int axis = 0; axis < 3; ++axis) {
      for (const int beyond : {-1, kBrickSide}) {
        for (int u = 0; u < kBrickSide; ++u) {
          for (int v = 0; v < kBrickSide; ++v) {
            std::array<int, 3> s{};
            s[std::size_t(axis)] = low[axis] + beyond;
            s[std::size_t((axis + 1) % 3)] = low[(axis + 1) % 3] + u;
            s[std::size_t((axis + 2) % 3)] = low[(axis + 2) % 3] + v;
            visit(s);
          }
        }
      }
    }
  }

  void sign_values() {
    const auto least = float(1e-3 * cell_m_);  // never zero, which would count as outside
    for (std::size_t brick = 0; brick < grid_.brick_count(); ++brick) {
      if (slot_[brick] < 0) {
        grid_.uniform(brick) = far_reached_[brick] != 0 ? float(cell_m_) : -float(cell_m_);
      }
    }
    const auto offset = float(cell_m_);
    parallel_for(near_.size(), 64, [&](std::size_t n) {
      float* samples = grid_.samples(near_[n]);
      for (std::size_t s = 0; s < BrickGrid::kBrickSamples; ++s) {
        const float beyond = std::max(std::abs(samples[s] - offset), least);
        samples[s] = reached_[n * BrickGrid::kBrickSamples + s] != 0 ? beyond : -beyond;
      }
    });
  }

  const MeshDistance& soup_;
  double cell_m_, band_m_;
  const RunContext& context_;
  BrickGrid grid_;
  std::vector<std::size_t> near_;   // bricks with samples of their own, ascending
  std::vector<std::int32_t> slot_;  // brick -> position in near_, or -1
  std::vector<std::uint8_t> reached_, far_reached_;
  /// Samples, or a far brick as {-1, low 31 bits, high bits}.
  std::vector<std::array<int, 3>> open_;
};

}  // namespace

Result<BrickGrid> wrap_field(const MeshDistance& soup, const TriangleMesh& mesh, double cell_m,
                             const RunContext& context) {
  return DistanceField(soup, cell_m, context).run(bounds_of_triangles(mesh));
}

}  // namespace turnscan::grid
