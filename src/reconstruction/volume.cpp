#include <algorithm>
#include <turnscan/reconstruction/volume.hpp>

namespace turnscan {

namespace {

constexpr int kSide = Volume::kSide;
constexpr std::size_t kCells = detail::kBrickCells;

}  // namespace

void Volume::touch(std::size_t brick, float start) {
  slot[brick] = std::int32_t(slots());
  value.insert(value.end(), kCells, start);
  weight.insert(weight.end(), kCells, 0.0f);
}

detail::ViewKernel kernel_of(const DepthView& view) {
  detail::ViewKernel k{};
  k.pixels = view.pixels.data();
  k.width = view.width;
  k.height = view.height;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      k.rotation[row * 3 + column] = view.rotation(row, column);
    k.translation[row] = view.translation[row];
  }
  k.fx = view.fx, k.fy = view.fy, k.cx = view.cx, k.cy = view.cy;
  k.k1 = view.distortion[0], k.k2 = view.distortion[1], k.p1 = view.distortion[2];
  k.p2 = view.distortion[3], k.k3 = view.distortion[4];
  k.unit = view.unit_m, k.bias = view.bias_m;
  k.distorted = view.distorted ? 1 : 0;
  k.parallel = view.parallel ? 1 : 0;
  return k;
}

Result<BrickGrid> to_grid(const Volume& volume, std::size_t max_bytes) {
  TURNSCAN_ASSIGN(BrickGrid grid,
                  BrickGrid::create(volume.origin_m, volume.cell_m,
                                    {volume.bricks[0] * kSide, volume.bricks[1] * kSide,
                                     volume.bricks[2] * kSide},
                                    1.0f, max_bytes));
  std::vector<std::size_t> touched;
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    if (volume.slot[b] >= 0)
      touched.push_back(b);
    else
      grid.uniform(b) = float(volume.uniform[b] * volume.truncation_m);
  }
  TURNSCAN_TRY(grid.touch(touched));
  for (const std::size_t b : touched) {
    const float* from = &volume.value[std::size_t(volume.slot[b]) * kCells];
    std::copy(from, from + kCells, grid.samples(b));
  }
  return grid;
}

}  // namespace turnscan
