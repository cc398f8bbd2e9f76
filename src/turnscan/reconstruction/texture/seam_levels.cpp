#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/seam_levels.hpp>

namespace turnscan::texture {

namespace {

constexpr float kCellsPerSide = 20.0f;    // along the longest side of the surface's bounding box
constexpr double kDifferent = 0.6;        // larger log ratios are a highlight or another surface
constexpr double kEnoughCompared = 8.0;   // comparing two views in a cell
constexpr std::size_t kCompared = 40000;  // blocks, or up to twice as many
constexpr double kAgree = 20.0;  // weight, relative to 1, of the equality of two cells of a view
constexpr double kStayLevel = 0.02;  // weight of a factor of 1
constexpr double kTolerance = 1e-3;
constexpr float kMaxLevel = 2.0f;

/// A lattice over the surface; each cell has an index for each view used by one of its blocks.
class Cells {
 public:
  Cells(const TexelBlocks& blocks, const ChosenViews& chosen, std::size_t views) : views_(views) {
    places_.resize(blocks.count());
    parallel_for(places_.size(), 512, [&](std::size_t b) { places_[b] = place_of(blocks, b); });
    Eigen::AlignedBox3f box;
    for (const Vec3f& p : places_) box.extend(p);
    if (places_.empty()) return;
    side_ = std::max(box.sizes().maxCoeff() / kCellsPerSide, 1e-6f);
    origin_ = box.min();
    size_ = (box.sizes() / side_).cast<int>() + Eigen::Vector3i::Ones();
    number_.assign(std::size_t(size_.prod()) * views_, -1);
    for (std::size_t b = 0; b < places_.size(); ++b)
      for (std::size_t k = 0; k < kSlots && chosen.view[b][k] != kNoView; ++k) {
        int& number = number_[index(cell_of(b), chosen.view[b][k])];
        if (number < 0) number = count_++;
      }
  }

  int count() const { return count_; }
  int number(std::size_t block, std::size_t view) const {
    return number_[index(cell_of(block), view)];
  }

  /// Indices of the same view in adjacent cells.
  template <class Pair>
  void for_each_pair(const Pair& pair) const {
    for (int z = 0; z < size_.z(); ++z)
      for (int y = 0; y < size_.y(); ++y)
        for (int x = 0; x < size_.x(); ++x)
          for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3i here(x, y, z), there = here + Eigen::Vector3i::Unit(axis);
            if (there[axis] >= size_[axis]) continue;
            for (std::size_t v = 0; v < views_; ++v) {
              const int a = number_[index(here, v)], b = number_[index(there, v)];
              if (a >= 0 && b >= 0) pair(a, b);
            }
          }
  }

  /// Interpolates between the centres of the cells that have the view.
  Vec3f between(const Eigen::MatrixX3d& values, std::size_t block, std::size_t view) const {
    const Vec3f at = (places_[block] - origin_) / side_ - Vec3f::Constant(0.5f);
    const Eigen::Vector3i low = at.array().floor().cast<int>().matrix();
    const Vec3f share = at - low.cast<float>();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 1e-12;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3i up(corner & 1, corner >> 1 & 1, corner >> 2), cell = low + up;
      if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) continue;
      const int number = number_[index(cell, view)];
      if (number < 0) continue;
      double w = 1.0;
      for (int axis = 0; axis < 3; ++axis)
        w *= double(up[axis] == 1 ? share[axis] : 1.0f - share[axis]);
      sum += w * values.row(number).transpose();
      weights += w;
    }
    return (sum / weights).cast<float>();
  }

 private:
  static Vec3f place_of(const TexelBlocks& blocks, std::size_t b) {
    Vec3f sum = Vec3f::Zero();
    int n = 0;
    for (int i = 0; i < kBlockTexels; ++i) {
      if (blocks.triangle(b, i) == kNoTriangle) continue;
      sum += blocks.surface(b, i).position;
      ++n;
    }
    return sum / float(std::max(n, 1));
  }
  Eigen::Vector3i cell_of(std::size_t block) const {
    const Eigen::Vector3i cell = ((places_[block] - origin_) / side_).cast<int>();
    return cell.cwiseMin(size_ - Eigen::Vector3i::Ones());
  }
  std::size_t index(const Eigen::Vector3i& cell, std::size_t view) const {
    return std::size_t((cell.z() * size_.y() + cell.y()) * size_.x() + cell.x()) * views_ + view;
  }

  std::size_t views_;
  std::vector<Vec3f> places_;
  Vec3f origin_ = Vec3f::Zero();
  float side_ = 1.0f;
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  std::vector<int> number_;
  int count_ = 0;
};

/// Number of blocks that compare two views in a cell, and the log ratio by which the first one's
/// light is to be raised relative to the second's.
struct Comparison {
  int first, second;
  double weight;
  Eigen::Vector3d sum;
};

std::vector<Comparison> comparisons(const Cells& cells, const ChosenViews& chosen,
                                    const BlockMeans& means) {
  std::vector<Comparison> all;
  const std::size_t step = std::max<std::size_t>(1, means.size() / kCompared);
  for (std::size_t b = 0; b < means.size(); b += step)
    for (std::size_t k = 0; k < kSlots; ++k) {
      if (!tells_of_exposure(means[b][k])) continue;
      for (std::size_t l = k + 1; l < kSlots; ++l) {
        if (!tells_of_exposure(means[b][l])) continue;
        const Vec3f ratio = means[b][l].cwiseQuotient(means[b][k]);
        const Eigen::Vector3d difference = ratio.array().log().matrix().cast<double>();
        const double r = difference.mean() / kDifferent;
        const double w = 1.0 / ((1.0 + r * r) * (1.0 + r * r));
        Comparison c{cells.number(b, chosen.view[b][k]), cells.number(b, chosen.view[b][l]), w,
                     w * difference};
        if (c.first > c.second) std::swap(c.first, c.second), c.sum = -c.sum;
        all.push_back(c);
      }
    }
  std::stable_sort(all.begin(), all.end(), [](const Comparison& a, const Comparison& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  std::size_t n = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (n > 0 && all[n - 1].first == all[i].first && all[n - 1].second == all[i].second) {
      all[n - 1].weight += all[i].weight;
      all[n - 1].sum += all[i].sum;
    } else {
      all[n++] = all[i];
    }
  }
  all.resize(n);
  return all;
}

/// Logarithms of the factors, by the cells' indices.
Eigen::MatrixX3d solved_levels(const Cells& cells, const std::vector<Comparison>& compared) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(cells.count(), 3);
  const auto alike = [&](int a, int b, double weight) {
    entries.insert(entries.end(),
                   {{a, a, weight}, {b, b, weight}, {a, b, -weight}, {b, a, -weight}});
  };
  for (int i = 0; i < cells.count(); ++i) entries.emplace_back(i, i, kStayLevel);
  cells.for_each_pair([&](int a, int b) { alike(a, b, 1.0); });
  for (const Comparison& c : compared) {
    const double weight = kAgree * c.weight / (c.weight + kEnoughCompared);
    alike(c.first, c.second, weight);
    const Eigen::Vector3d difference = weight / c.weight * c.sum;
    right.row(c.first) += difference.transpose();
    right.row(c.second) -= difference.transpose();
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(cells.count(), cells.count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<decltype(matrix), Eigen::Lower | Eigen::Upper> solver(matrix);
  solver.setTolerance(kTolerance);
  Eigen::MatrixX3d out(cells.count(), 3);
  for (int c = 0; c < 3; ++c) out.col(c) = solver.solve(right.col(c));
  return out;
}

}  // namespace

BlockLevels seam_levels(const TexelBlocks& blocks, const ChosenViews& chosen,
                        const BlockMeans& means, std::size_t views) {
  const Cells cells(blocks, chosen, views);
  const Eigen::MatrixX3d logs = solved_levels(cells, comparisons(cells, chosen, means));
  BlockLevels out(blocks.count());
  parallel_for(out.size(), 256, [&](std::size_t b) {
    out[b].fill(Vec3f::Ones());
    for (std::size_t k = 0; k < kSlots && chosen.view[b][k] != kNoView; ++k)
      out[b][k] = cells.between(logs, b, chosen.view[b][k])
                      .array()
                      .exp()
                      .max(1.0f / kMaxLevel)
                      .min(kMaxLevel)
                      .matrix();
  });
  return out;
}

}  // namespace turnscan::texture
