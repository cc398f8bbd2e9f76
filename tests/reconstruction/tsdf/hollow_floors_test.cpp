#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/reconstruction/tsdf/platter_columns.hpp>

#include "tests/reconstruction/tsdf/volume_on_platter.hpp"

namespace turnscan::tsdf {
namespace {

using testing::kFloor;

constexpr double kWall_m = 0.004, kOuter_m = 0.018, kBottom_m = 0.006;

/// A cup of 18 mm radius with walls of 4 mm and a floor 6 mm thick; without: a tube.
double cup(const Vec3d& p, bool with_floor) {
  const double r = std::hypot(p.x(), p.z());
  const double wall = std::max(r - kOuter_m, kOuter_m - kWall_m - r);
  return with_floor ? std::min(wall, std::max(r - kOuter_m, p.y() - kBottom_m)) : wall;
}

/// What rays see of a cup above the margin, beside its wall: inside down to a cone that ends
/// `unseen_m` above the platter in the middle, and everything outside.
Volume seen_from_above(bool with_floor, double unseen_m) {
  return testing::volume_on_platter(
      5, [&](const Vec3d& p) { return std::min(cup(p, with_floor), 0.004); },
      [&](const Vec3d& p) {
        const double r = std::hypot(p.x(), p.z());
        return r > 0.5 * (2.0 * kOuter_m - kWall_m) || p.y() > unseen_m - 0.3 * r;
      });
}

std::size_t columns_in(const std::vector<std::uint8_t>& columns) {
  return std::size_t(std::count(columns.begin(), columns.end(), 1));
}

/// Whether something is inside on the axis, after closing.
bool has_floor(Volume volume) {
  VolumeScale scale;
  scale.cell_m = volume.cell_m;
  scale.truncation_m = volume.truncation_m;
  scale.floor_m = 0.004;
  EXPECT_TRUE(close_holes(volume, scale, TaperedFoot(), RunContext()));
  const VolumeSamples samples(volume);
  for (int j = 0; j < samples.size()[1]; ++j)
    if (samples.value(24, j, 24) < 0.0f) return true;
  return false;
}

TEST(HollowFloors, LieUnderACupIntoWhichNoRayLookedDeepEnough) {
  const Volume volume = seen_from_above(true, 0.016);
  const auto floors = hollow_floors(volume, kFloor);
  EXPECT_EQ(floors[24 + 48 * 24], 1);  // on the axis
  EXPECT_EQ(floors[2 + 48 * 24], 0);   // outside
  // Within the outer radius, and most of the hollow.
  EXPECT_LT(double(columns_in(floors)), 3.2 * 18.0 * 18.0);
  EXPECT_GT(double(columns_in(floors)), 3.0 * 12.0 * 12.0);
  EXPECT_TRUE(has_floor(volume));
}

TEST(HollowFloors, AreNotUnderATubeThroughWhichRaysSawThePlatter) {
  const Volume volume = seen_from_above(false, 0.0);
  EXPECT_EQ(columns_in(hollow_floors(volume, kFloor)), 0u);
  EXPECT_FALSE(has_floor(volume));
}

TEST(HollowFloors, AreNotInWhatIsSolid) {
  Volume volume = seen_from_above(true, 0.1);  // nothing was seen of the hollow
  EXPECT_EQ(columns_in(hollow_floors(volume, kFloor)), 0u);
}

}  // namespace
}  // namespace turnscan::tsdf
