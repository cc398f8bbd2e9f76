#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/reconstruction/tsdf/piece_measures.hpp>
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
  EXPECT_TRUE(close_holes(volume, scale, Foot(), RunContext()));
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

/// What stands within the outer wall of a box of 18 mm radius that is open above: the height of its
/// floor. Everything was measured, as was the platter, which lies at platter_m.
template <class Floor>
Volume measured_box(const Floor& floor, double platter_m) {
  const auto distance = [&](const Vec3d& p) {
    const double r = std::hypot(p.x(), p.z());
    const double wall = std::max(r - kOuter_m, kOuter_m - kWall_m - r);
    const double bottom = platter_m + (r < kOuter_m ? floor(p) : 0.0);
    return std::clamp(std::min(wall, p.y() - bottom), -0.004, 0.004);
  };
  Volume volume = testing::volume_on_platter(5, distance, [](const Vec3d&) { return true; });
  std::fill(volume.weight.begin(), volume.weight.end(), 1.0f);
  return volume;
}

Volume measured_box(double floor_m, double platter_m) {
  return measured_box([=](const Vec3d&) { return floor_m; }, platter_m);
}

std::size_t floor_columns(const Volume& volume) {
  const MeasuredFloors floors(volume, kFloor);
  std::size_t count = 0;
  for (int k = 0; k < 48; ++k)
    for (int i = 0; i < 48; ++i) count += floors.column(i, k) ? 1 : 0;
  return count;
}

TEST(MeasuredFloors, AreWhereTheSurfaceInABoxLiesHigherThanThePlatterBesideIt) {
  constexpr double kInner = 3.14 * 14.0 * 14.0;
  for (const double floor_m : {0.0005, 0.002})
    for (const double platter_m : {0.0, 0.0008})
      EXPECT_NEAR(double(floor_columns(measured_box(floor_m, platter_m))), kInner, 30.0);
}

TEST(MeasuredFloors, AreNotInARingWhereverThePlatterWasMeasured) {
  for (const double platter_m : {0.0, 0.0015, 0.003})
    EXPECT_EQ(floor_columns(measured_box(0.0, platter_m)), 0u);
}

TEST(MeasuredFloors, AreNotInARingWithALedge) {
  const auto ledge = [](const Vec3d& p) { return std::hypot(p.x(), p.z()) < 0.008 ? 0.0 : 0.002; };
  EXPECT_EQ(floor_columns(measured_box(ledge, 0.0)), 0u);
}

TEST(MeasuredFloors, AreNotWhereABoreOnlyLooksShallow) {
  const auto bore = [](const Vec3d& p) { return 0.001 + 0.2 * std::hypot(p.x(), p.z()); };
  EXPECT_EQ(floor_columns(measured_box(bore, 0.0)), 0u);
}

/// Of a flat triangle in the middle of a box, at some height.
Evidence evidence_at(float y_m, const MeasuredFloors& floors) {
  VolumetricPiece piece;
  piece.mesh.vertices = {{0.0f, y_m, 0.0f}, {0.0f, y_m, 0.003f}, {0.003f, y_m, 0.0f}};
  piece.mesh.triangles = {{0, 1, 2}};
  piece.confidence = {1.0f, 1.0f, 1.0f};
  VolumeScale scale;
  scale.cell_m = 0.001;
  scale.floor_m = 0.004;
  measure_evidence(piece, scale, floors);
  return piece.evidence[0];
}

TEST(MeasuredFloors, AreMeasuredAndNoBase) {
  const MeasuredFloors floors(measured_box(0.002, 0.0), kFloor);
  EXPECT_EQ(evidence_at(0.002f, floors), Evidence::kMeasured);
  EXPECT_EQ(evidence_at(0.0f, floors), Evidence::kBase);
  EXPECT_EQ(evidence_at(0.002f, MeasuredFloors()), Evidence::kBase);
}

TEST(MeasuredFloors, StayWhenHolesAreClosedAndStandOnThePlatter) {
  Volume volume = measured_box(0.002, 0.0);
  VolumeScale scale;
  scale.cell_m = volume.cell_m;
  scale.truncation_m = volume.truncation_m;
  scale.floor_m = 0.004;
  const Foot foot{{}, MeasuredFloors(volume, kFloor)};
  EXPECT_TRUE(foot.floors.contains(Vec3f(0.0f, 0.002f, 0.0f)));
  EXPECT_FALSE(foot.floors.contains(Vec3f(0.0f, 0.0f, 0.0f)));      // the base
  EXPECT_FALSE(foot.floors.contains(Vec3f(0.016f, 0.002f, 0.0f)));  // in the wall
  EXPECT_TRUE(MeasuredFloors(volume, 1000).none());
  ASSERT_TRUE(close_holes(volume, scale, foot, RunContext()));
  const VolumeSamples samples(volume);
  EXPECT_GT(samples.value(24, 0, 24), 0.0f);  // at -0.5 mm
  EXPECT_LT(samples.value(24, 2, 24), 0.0f);  // at 1.5 mm
  EXPECT_GT(samples.value(24, 3, 24), 0.0f);  // at 2.5 mm
  EXPECT_GT(samples.value(24, 20, 24), 0.0f);
}

}  // namespace
}  // namespace turnscan::tsdf
