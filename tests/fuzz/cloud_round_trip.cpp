// The input gives points with attributes: a cloud is written and read again, bit by bit.

#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(cloud_round_trip) {
  using namespace turnscan;
  if (size < 8) return 0;
  static const fuzz::ScratchFolder folder;
  CloudFile file;
  const std::size_t n = size / 7;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t* b = data + 7 * i;
    file.cloud.points.emplace_back(b[0] - 128.0f, b[1] / 256.0f, 1.0f * b[2] * b[3]);
    if ((data[0] & 1) != 0) file.cloud.colors.push_back({b[4], b[5], b[6]});
    if ((data[0] & 2) != 0) file.cloud.normals.push_back(Vec3f::UnitX());
    if ((data[0] & 4) != 0) file.cloud.weights.push_back(float(b[4]));
  }
  if ((data[0] & 8) != 0) {
    file.grid_width = static_cast<int>(n);
    file.grid_height = 1;
    for (std::size_t i = 0; i < n; ++i)
      file.grid.push_back((data[7 * i] & 1) != 0 ? -1 : static_cast<std::int32_t>(i));
  }
  fuzz::require(bool(write_cloud(folder / "c.ply", file)), "a cloud that can be written");
  const auto again = decode_cloud(*read_file(folder / "c.ply"));
  fuzz::require(bool(again), "read again");
  fuzz::check(*again);
  fuzz::require(again->cloud.points == file.cloud.points && again->grid == file.grid &&
                    again->cloud.colors.size() == file.cloud.colors.size() &&
                    again->cloud.normals == file.cloud.normals &&
                    again->cloud.weights == file.cloud.weights,
                "bit by bit");
  return 0;
}
