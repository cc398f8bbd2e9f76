// The input is a cloud as text.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(xyz) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  folder.put("a.xyz", fuzz::text_of(data, size));
  const auto file = read_cloud(folder / "a.xyz");
  if (!file) return 0;
  const PointCloud& cloud = file->cloud;
  fuzz::require(cloud.colors.empty() || cloud.colors.size() == cloud.size(), "colours");
  for (const Vec3f& p : cloud.points) fuzz::require(p.allFinite(), "a point");
  return 0;
}
