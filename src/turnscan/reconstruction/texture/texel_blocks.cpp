#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/texel_blocks.hpp>

namespace turnscan::texture {

TexelBlocks::TexelBlocks(const TriangleMesh& mesh, const Atlas& atlas,
                         const std::vector<Vec3f>& normals)
    : mesh_(mesh),
      atlas_(atlas),
      normals_(normals),
      size_(atlas.size_px),
      side_(atlas.size_px / kBlock_px),
      planes_(mesh.triangles.size()) {
  block_of_.assign(std::size_t(side_) * std::size_t(side_), -1);
  const auto block_at_texel = [&](int x, int y) {
    return std::size_t(y / kBlock_px) * std::size_t(side_) + std::size_t(x / kBlock_px);
  };
  // First determines the squares, then their texels.
  for (std::size_t t = 0; t < planes_.size(); ++t)
    for_each_texel(atlas.corners[t], [&](int x, int y) { block_of_[block_at_texel(x, y)] = 0; });
  for (std::size_t i = 0; i < block_of_.size(); ++i) {
    if (block_of_[i] < 0) continue;
    block_of_[i] = std::int32_t(blocks_.size());
    blocks_.push_back(std::uint32_t(i));
  }
  owner_.assign(blocks_.size() * kBlockTexels, kNoTriangle);
  chart_.assign(blocks_.size(), 0);
  for (std::size_t t = 0; t < planes_.size(); ++t) {
    for_each_texel(atlas.corners[t], [&](int x, int y) {
      const auto block = std::size_t(block_of_[block_at_texel(x, y)]);
      std::uint32_t& owner =
          owner_[block * kBlockTexels + std::size_t(y % kBlock_px * kBlock_px + x % kBlock_px)];
      if (owner != kNoTriangle) return;
      owner = std::uint32_t(t);
      chart_[block] = atlas.chart[t];
      ++covered_;
    });
  }
  parallel_for(planes_.size(), 4096, [&](std::size_t t) {
    const auto& c = atlas.corners[t];
    const Eigen::Vector2f ab = c[1] - c[0], ac = c[2] - c[0];
    const float area = ab.x() * ac.y() - ac.x() * ab.y();
    if (area == 0.0f) return;
    const Vec3f& a = mesh.vertices[mesh.triangles[t][0]];
    const Vec3f b = mesh.vertices[mesh.triangles[t][1]] - a;
    const Vec3f d = mesh.vertices[mesh.triangles[t][2]] - a;
    Plane& plane = planes_[t];
    plane.right = (ac.y() * b - ab.y() * d) / area;
    plane.down = (ab.x() * d - ac.x() * b) / area;
    plane.at_origin = a;
  });
}

std::int32_t TexelBlocks::block_at(int column, int row) const {
  if (column < 0 || row < 0 || column >= size_ || row >= size_) return -1;
  return block_of_[std::size_t(row / kBlock_px) * std::size_t(side_) +
                   std::size_t(column / kBlock_px)];
}

int TexelBlocks::middle_texel(std::size_t block) const {
  constexpr int kMiddle = kBlock_px / 2 * kBlock_px + kBlock_px / 2;
  for (int d = 0; d < kBlockTexels; ++d) {
    const int i = (kMiddle + d) % kBlockTexels;
    if (triangle(block, i) != kNoTriangle) return i;
  }
  return 0;
}

TexelBlocks::Surface TexelBlocks::surface(std::size_t block, int texel) const {
  const std::uint32_t t = triangle(block, texel);
  const Plane& plane = planes_[t];
  const Eigen::Vector2f& corner = atlas_.corners[t][0];
  const float x = float(left(block) + texel % kBlock_px) + 0.5f - corner.x();
  const float y = float(top(block) + texel / kBlock_px) + 0.5f - corner.y();
  return {plane.at_origin + x * plane.right + y * plane.down, plane.right, plane.down};
}

Vec3f TexelBlocks::normal(std::size_t block, int texel) const {
  const auto& t = mesh_.triangles[triangle(block, texel)];
  const Vec3f p = surface(block, texel).position;
  // Closer corners have more weight; normals that only weight views need no more.
  Vec3f sum = Vec3f::Zero();
  for (const std::uint32_t v : t) sum += normals_[v] / ((mesh_.vertices[v] - p).norm() + 1e-9f);
  return sum.norm() > 0.0f ? Vec3f(sum.normalized()) : Vec3f(Vec3f::UnitY());
}

}  // namespace turnscan::texture
