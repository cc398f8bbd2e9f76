#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/object_partition.hpp>

namespace turnscan {

namespace {

constexpr int kSide = 96;          // cells along the longest side
constexpr double kAround = 0.005;  // beyond the grid its outermost cells are used

}  // namespace

struct ObjectPartition::Cells {
  Vec3f origin = Vec3f::Zero();
  float per_cell = 1.0f;
  Eigen::Array3i size = Eigen::Array3i::Ones();
  std::vector<std::uint16_t> owner;

  Vec3f middle(int x, int y, int z) const {
    return origin + (Vec3f(float(x), float(y), float(z)).array() + 0.5f).matrix() / per_cell;
  }
};

ObjectPartition::ObjectPartition(std::span<const TriangleMesh* const> objects)
    : chosen_(objects.size(), true) {
  std::vector<Vec3f> points;
  std::vector<std::uint16_t> owner;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    points.insert(points.end(), objects[k]->vertices.begin(), objects[k]->vertices.end());
    owner.resize(points.size(), std::uint16_t(k));
  }
  const KdTree tree(points);
  const Box box = bounds(points);
  auto cells = std::make_shared<Cells>();
  const double cell = (box.size().maxCoeff() + 2.0 * kAround) / kSide;
  cells->origin = (box.min.array() - kAround).matrix().cast<float>();
  cells->per_cell = float(1.0 / cell);
  cells->size = ((box.size().array() + 2.0 * kAround) / cell).ceil().cast<int>().max(1);
  const Eigen::Array3i n = cells->size;
  cells->owner.resize(std::size_t(n.prod()));
  parallel_for(std::size_t(n.z()), 1, [&](std::size_t z) {
    std::size_t i = z * std::size_t(n.x()) * std::size_t(n.y());
    for (int y = 0; y < n.y(); ++y) {
      for (int x = 0; x < n.x(); ++x, ++i) {
        std::uint32_t near = 0;
        float squared = 0.0f;
        if (tree.knn(cells->middle(x, y, int(z)), 1, &near, &squared) > 0)
          cells->owner[i] = owner[near];
      }
    }
  });
  cells_ = std::move(cells);
}

ObjectPartition ObjectPartition::of(std::span<const std::size_t> chosen) const {
  ObjectPartition out = *this;
  out.chosen_.assign(chosen_.size(), false);
  for (const std::size_t k : chosen) out.chosen_.at(k) = true;
  return out;
}

bool ObjectPartition::contains(const Vec3f& p_table) const {
  const Eigen::Array3f at = (p_table - cells_->origin).array() * cells_->per_cell;
  // Points far outside would overflow an int.
  const Eigen::Array3f last = (cells_->size - 1).cast<float>();
  const Eigen::Array3i c = at.max(0.0f).min(last).cast<int>();
  return chosen_[cells_->owner[std::size_t(c.x() +
                                           cells_->size.x() * (c.y() + cells_->size.y() * c.z()))]];
}

}  // namespace turnscan
