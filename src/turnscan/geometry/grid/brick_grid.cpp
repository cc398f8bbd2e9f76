#include <algorithm>
#include <turnscan/geometry/grid/isosurface.hpp>

namespace turnscan {

Result<BrickGrid> BrickGrid::create(const Vec3d& origin_m, double cell_m, GridCoords size,
                                    float value, std::size_t max_bytes) {
  if (!(cell_m > 0.0) || !std::isfinite(cell_m) || !origin_m.allFinite()) {
    return fail(ErrorCode::kInvalidOption,
                "grid: a cell of {} m is not positive; give a positive cell size", cell_m);
  }
  BrickGrid grid;
  GridCoords bricks{};
  double count = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size[axis] < 1 || size[axis] > (1 << 20)) {
      return fail(ErrorCode::kInvalidOption,
                  "grid: {} samples along an axis; allowed are 1 to 1048576, choose larger cells",
                  size[axis]);
    }
    bricks[axis] = (size[axis] + kBrick - 1) / kBrick;
    count *= bricks[axis];
  }
  if (count * (sizeof(std::int32_t) + sizeof(float)) > double(max_bytes)) {
    return fail(ErrorCode::kResourceLimit,
                "grid: {} x {} x {} samples need more than {} MB; choose larger cells", size[0],
                size[1], size[2], max_bytes >> 20);
  }
  grid.origin_m_ = origin_m;
  grid.cell_m_ = cell_m;
  grid.size_ = size;
  grid.bricks_ = GridIndex(bricks);
  grid.max_bytes_ = max_bytes;
  grid.slot_.assign(std::size_t(count), -1);
  grid.uniform_.assign(std::size_t(count), value);
  return grid;
}

Result<> BrickGrid::allocate(const std::vector<std::size_t>& bricks) {
  const auto added = std::size_t(
      std::count_if(bricks.begin(), bricks.end(), [&](std::size_t b) { return slot_[b] < 0; }));
  const std::size_t samples = values_.size() + added * kBrickSamples;
  if (samples * sizeof(float) + slot_.size() * 8 > max_bytes_) {
    return fail(ErrorCode::kResourceLimit,
                "grid: {} MB of samples are more than the {} MB allowed; choose larger cells",
                samples * sizeof(float) >> 20, max_bytes_ >> 20);
  }
  values_.reserve(samples);
  for (const std::size_t b : bricks) {
    if (slot_[b] >= 0) continue;
    slot_[b] = std::int32_t(values_.size() / kBrickSamples);
    values_.insert(values_.end(), kBrickSamples, uniform_[b]);
  }
  return {};
}

const float* BrickGrid::samples(std::size_t brick) const {
  return slot_[brick] < 0 ? nullptr : &values_[std::size_t(slot_[brick]) * kBrickSamples];
}

float* BrickGrid::samples(std::size_t brick) {
  return slot_[brick] < 0 ? nullptr : &values_[std::size_t(slot_[brick]) * kBrickSamples];
}

}  // namespace turnscan
