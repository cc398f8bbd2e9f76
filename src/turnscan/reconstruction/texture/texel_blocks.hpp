#pragma once
// The texels of an atlas in square blocks of one chart each: the unit for choosing views and for
// processing.

#include <turnscan/reconstruction/texture/atlas.hpp>

namespace turnscan::texture {

inline constexpr int kBlockTexels = kBlock_px * kBlock_px;

/// Maps texels to the surface. Refers to the mesh and the atlas.
class TexelBlocks {
 public:
  TexelBlocks(const TriangleMesh& mesh, const Atlas& atlas, const std::vector<Vec3f>& normals);

  int size_px() const { return size_; }
  std::size_t count() const { return blocks_.size(); }
  /// The upper left texel of a block.
  int left(std::size_t block) const {
    return int(blocks_[block] % std::uint32_t(side_)) * kBlock_px;
  }
  int top(std::size_t block) const {
    return int(blocks_[block] / std::uint32_t(side_)) * kBlock_px;
  }
  /// The block that contains a texel; -1 if the texel is not covered.
  std::int32_t block_at(int column, int row) const;
  /// The triangle of a texel of a block, row by row; kNoTriangle (charts.hpp) if there is none.
  std::uint32_t triangle(std::size_t block, int texel) const {
    return owner_[block * kBlockTexels + std::size_t(texel)];
  }
  /// A covered texel; the one in the middle of the block if that is covered.
  int middle_texel(std::size_t block) const;
  /// Position of a texel's centre on its triangle, and steps to the texel on its right and below
  /// it.
  struct Surface {
    Vec3f position, right, down;
  };
  Surface surface(std::size_t block, int texel) const;
  /// Interpolated from the vertices; unit.
  Vec3f normal(std::size_t block, int texel) const;
  std::uint32_t chart(std::size_t block) const { return chart_[block]; }
  std::size_t covered_texels() const { return covered_; }

 private:
  struct Plane {
    Vec3f at_origin, right, down;
  };
  const TriangleMesh& mesh_;
  const Atlas& atlas_;
  const std::vector<Vec3f>& normals_;
  int size_ = 0, side_ = 0;
  std::vector<Plane> planes_;           // per triangle
  std::vector<std::uint32_t> blocks_;   // row * side + column, ascending
  std::vector<std::int32_t> block_of_;  // the inverse
  std::vector<std::uint32_t> owner_, chart_;
  std::size_t covered_ = 0;
};

}  // namespace turnscan::texture
