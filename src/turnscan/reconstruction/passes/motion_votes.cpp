#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/rotation_between.hpp>
#include <turnscan/reconstruction/passes/motion_votes.hpp>

namespace turnscan::passes {

namespace {

constexpr double kRotationSpacing = 14.0 * std::numbers::pi / 180.0;
constexpr int kFineSide = 20;  // cells of the translations along each axis
/// A third of the points, in cells of twice the size, choose the rotations that are worth the votes
/// of half of them: one in kChosen. The others hardly ever end among the motions that are kept.
constexpr int kRoughSide = kFineSide / 2;
constexpr std::size_t kRoughStride = 3, kFineStride = 2, kChosen = 8;
constexpr int kFaceBins = 8;      // of normals, along an edge of a cube
constexpr float kVoteCos = 0.9f;  // normals closer than this may belong to the same point

int normal_bin(const Vec3f& n) {
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  const float scale = 0.5f * kFaceBins / std::abs(n[axis]);
  const auto bin = [&](float v) {
    return std::clamp(int(v * scale + 0.5f * kFaceBins), 0, kFaceBins - 1);
  };
  const int face = 2 * axis + (n[axis] < 0.0f ? 1 : 0);
  return (face * kFaceBins + bin(n[(axis + 1) % 3])) * kFaceBins + bin(n[(axis + 2) % 3]);
}

Vec3f bin_direction(int bin) {
  const int v = bin % kFaceBins, u = bin / kFaceBins % kFaceBins;
  const int face = bin / (kFaceBins * kFaceBins), axis = face / 2;
  Vec3f n;
  n[axis] = face % 2 == 1 ? -1.0f : 1.0f;
  n[(axis + 1) % 3] = (float(u) + 0.5f) * 2.0f / kFaceBins - 1.0f;
  n[(axis + 2) % 3] = (float(v) + 0.5f) * 2.0f / kFaceBins - 1.0f;
  return n.normalized();
}

/// In cells of translation; the fourth number is padding for a vector register.
using Cell = Eigen::Array4f;

Cell cell_of(const Vec3f& v) { return {v.x(), v.y(), v.z(), 0.0f}; }

/// Points and their colours, if any.
struct Places {
  std::vector<Cell> cells;
  std::vector<Vec3f> colors;
};

/// The points of a surface indexed by the directions of their normals.
class NormalIndex {
 public:
  NormalIndex(const Samples& samples, const Vec3f& center, float per_cell) {
    lists_.resize(6 * kFaceBins * kFaceBins);
    for (int bin = 0; bin < int(lists_.size()); ++bin) {
      const Vec3f direction = bin_direction(bin);
      Places& list = lists_[std::size_t(bin)];
      for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!(samples.normals[i].dot(direction) > kVoteCos)) continue;
        list.cells.push_back(cell_of((samples.points[i] - center) * per_cell));
        if (!samples.colors.empty()) list.colors.push_back(samples.colors[i]);
      }
    }
  }
  const Places& at(const Vec3f& normal) const { return lists_[std::size_t(normal_bin(normal))]; }

 private:
  std::vector<Places> lists_;
};

struct Peak {
  float votes = 0.0f;
  Vec3f cell = Vec3f::Zero();
};

float likeness(const Vec3f& one, const Vec3f& other, float spread) {
  const float squared = (one - other).squaredNorm();
  return squared >= 0.0f ? 1.0f / (1.0f + 4.0f * squared / (spread * spread)) : 0.5f;  // NaN
}

/// The votes for translations under one rotation.
template <int kSide>
class VoteBox {
 public:
  VoteBox() : votes_(std::size_t(kSide) * kSide * kSide), blurred_(votes_.size()) {}

  void clear() { std::fill(votes_.begin(), votes_.end(), 0.0f); }
  void add(const Cell& cell, float weight) {
    // Truncation instead of rounding down suffices: values below 1 are excluded either way.
    const Eigen::Array4i c = (cell + 0.5f * kSide).cast<int>();
    const auto inside = [](int i) { return unsigned(i - 1) < unsigned(kSide - 2); };
    if (!inside(c.x()) || !inside(c.y()) || !inside(c.z())) return;
    votes_[std::size_t(c.x() + kSide * (c.y() + kSide * c.z()))] += weight;
  }
  /// Sums over neighbouring cells, and the two cells with the largest sums.
  std::array<Peak, 2> peaks() {
    for (const int stride : {1, kSide, kSide * kSide}) blur(stride);
    std::array<Peak, 2> out;
    out[0] = highest(nullptr);
    out[1] = highest(&out[0].cell);
    return out;
  }

 private:
  void blur(int stride) {
    const auto n = std::ptrdiff_t(votes_.size());
    for (std::ptrdiff_t i = stride; i < n - stride; ++i)
      blurred_[std::size_t(i)] = votes_[std::size_t(i - stride)] + 2.0f * votes_[std::size_t(i)] +
                                 votes_[std::size_t(i + stride)];
    votes_.swap(blurred_);
  }
  Peak highest(const Vec3f* apart_from) const {
    Peak peak;
    for (int z = 1; z < kSide - 1; ++z) {
      for (int y = 1; y < kSide - 1; ++y) {
        for (int x = 1; x < kSide - 1; ++x) {
          const float v = votes_[std::size_t(x + kSide * (y + kSide * z))];
          if (v <= peak.votes) continue;
          const Vec3f cell =
              (Vec3f(float(x), float(y), float(z)).array() + 0.5f - 0.5f * kSide).matrix();
          if (apart_from != nullptr && (cell - *apart_from).cwiseAbs().maxCoeff() < 2.5f) continue;
          peak = {v, cell};
        }
      }
    }
    return peak;
  }

  std::vector<float> votes_, blurred_;
};

/// The votes of b's points, of which each stride-th is used, for translations to a.
template <int kSide>
class Votes {
 public:
  Votes(const Samples& a, const Samples& b, double extent_m, std::size_t stride, float color_spread)
      : stride_(stride),
        color_spread_(a.colors.empty() || b.colors.empty() ? 0.0f : color_spread),
        per_cell_(float(kSide / extent_m)),
        center_a_(bounds(a.points).center().cast<float>()),
        center_b_(bounds(b.points).center().cast<float>()),
        b_(b),
        index_(a, center_a_, per_cell_) {}

  /// The two best translations for each of the rotations.
  Result<std::vector<std::array<Peak, 2>>> peaks(std::span<const Eigen::Matrix3f> rotations,
                                                 const RunContext& context) const {
    std::vector<std::array<Peak, 2>> out(rotations.size());
    constexpr std::size_t kChunk = 32;
    const std::size_t chunks = (rotations.size() + kChunk - 1) / kChunk;
    TURNSCAN_TRY(parallel_for(chunks, 1, context, [&](std::size_t chunk) {
      VoteBox<kSide> box;
      for (std::size_t r = chunk * kChunk; r < std::min(rotations.size(), (chunk + 1) * kChunk);
           ++r) {
        box.clear();
        vote(rotations[r], box);
        out[r] = box.peaks();
      }
    }));
    return out;
  }

  VotedMotion motion(const Eigen::Matrix3f& rotation, const Peak& peak) const {
    VotedMotion out;
    out.votes = peak.votes;
    const Vec3f t = center_a_ + peak.cell / per_cell_ - rotation * center_b_;
    out.T_a_b.linear() = rotation.cast<double>();
    out.T_a_b.translation() = t.cast<double>();
    return out;
  }

 private:
  void vote(const Eigen::Matrix3f& rotation, VoteBox<kSide>& box) const {
    for (std::size_t i = 0; i < b_.size(); i += stride_) {
      const Places& partners = index_.at(rotation * b_.normals[i]);
      const Cell q = cell_of(rotation * ((b_.points[i] - center_b_) * per_cell_));
      // All points of a plane are partners of each other.
      const float weight = 1.0f / std::sqrt(1.0f + float(partners.cells.size()));
      if (color_spread_ > 0.0f) {
        for (std::size_t k = 0; k < partners.cells.size(); ++k)
          box.add(partners.cells[k] - q,
                  weight * likeness(partners.colors[k], b_.colors[i], color_spread_));
      } else {
        for (const Cell& p : partners.cells) box.add(p - q, weight);
      }
    }
  }

  std::size_t stride_;
  float color_spread_, per_cell_;
  Vec3f center_a_, center_b_;
  const Samples& b_;
  NormalIndex index_;
};

/// The rotations with the most votes of some of the points.
Result<std::vector<Eigen::Matrix3f>> chosen_rotations(const Samples& a, const Samples& b,
                                                      double extent_m, float color_spread,
                                                      const RunContext& context) {
  static const std::vector<Eigen::Matrix3f> all = rotation_grid(kRotationSpacing);
  const Votes<kRoughSide> rough(a, b, extent_m, kRoughStride, color_spread);
  TURNSCAN_ASSIGN(const auto peaks, rough.peaks(all, context));
  std::vector<std::size_t> order(all.size());
  for (std::size_t r = 0; r < order.size(); ++r) order[r] = r;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return peaks[x][0].votes > peaks[y][0].votes;
  });
  std::vector<Eigen::Matrix3f> out;
  for (std::size_t k = 0; k < order.size() / kChosen; ++k) out.push_back(all[order[k]]);
  return out;
}

}  // namespace

std::vector<Eigen::Matrix3f> rotation_grid(double spacing_rad) {
  const double pi = std::numbers::pi, golden = pi * (3.0 - std::sqrt(5.0));
  const int directions = int(std::ceil(4.0 * pi / (spacing_rad * spacing_rad)));
  const int spins = int(std::ceil(2.0 * pi / spacing_rad));
  std::vector<Eigen::Matrix3f> out;
  for (int i = 0; i < directions; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / directions, r = std::sqrt(1.0 - y * y);
    const Vec3d up(r * std::cos(golden * i), y, r * std::sin(golden * i));
    const Eigen::Quaterniond tip = rotation_between(Vec3d::UnitY(), up);
    for (int k = 0; k < spins; ++k)
      out.push_back((tip * Eigen::AngleAxisd(2.0 * pi * k / spins, Vec3d::UnitY()))
                        .toRotationMatrix()
                        .cast<float>());
  }
  return out;
}

Result<std::vector<VotedMotion>> vote_motions(const Samples& a, const Samples& b, double extent_m,
                                              std::size_t count, float color_spread,
                                              const RunContext& context) {
  TURNSCAN_ASSIGN(const auto rotations, chosen_rotations(a, b, extent_m, color_spread, context));
  const Votes<kFineSide> votes(a, b, extent_m, kFineStride, color_spread);
  TURNSCAN_ASSIGN(const auto peaks, votes.peaks(rotations, context));
  std::vector<VotedMotion> out;
  for (std::size_t r = 0; r < peaks.size(); ++r)
    for (const Peak& peak : peaks[r]) out.push_back(votes.motion(rotations[r], peak));
  std::stable_sort(out.begin(), out.end(),
                   [](const VotedMotion& x, const VotedMotion& y) { return x.votes > y.votes; });
  if (out.size() > count) out.resize(count);
  return out;
}

}  // namespace turnscan::passes
