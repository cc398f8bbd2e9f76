#include <gtest/gtest.h>

#include <turnscan/reconstruction/tsdf/mixed_pixel_surface.hpp>
#include <turnscan/reconstruction/tsdf/volume_samples.hpp>

namespace turnscan::tsdf {
namespace {

constexpr float kWeak = 1.5f;           ///< weight of the weak sample; the others' is 100
constexpr std::uint32_t kDepth = 5040;  ///< of the weak sample, in 0.1 mm

/// Parallel rays along z, 2 mm apart, that all measure one depth.
views::DepthView plain_view(std::uint32_t raw) {
  views::DepthView view;
  view.parallel = true;
  view.translation = Vec3f(0.0f, 0.0f, 0.5f);
  view.fx = view.fy = 500.0f;
  view.cx = view.cy = 8.0f;
  view.width = view.height = 17;
  view.pixels.assign(std::size_t(view.width) * std::size_t(view.height), raw);
  return view;
}

/// The pixel above the one that sees the weak sample measures something 54 mm nearer.
views::DepthView view_beside_a_step() {
  views::DepthView view = plain_view(kDepth);
  view.pixels[std::size_t(9 * view.width + 10)] = kDepth - 540;
  return view;
}

std::size_t weak_sample(const Volume& volume) {
  return volume.first_sample(0) + sample_in_brick(4, 4, 4);
}

/// A brick of samples beside a surface that many views measured, but for one.
Volume volume_with_a_weak_sample() {
  Volume volume;
  volume.cell_m = 0.001;
  volume.truncation_m = 0.004;
  volume.set_bricks({1, 1, 1});
  volume.allocate(0, 0.0005f);
  std::fill(volume.weight.begin(), volume.weight.end(), 100.0f);
  volume.value[weak_sample(volume)] = -0.0005f;
  volume.weight[weak_sample(volume)] = kWeak;
  return volume;
}

float weight_after(const std::vector<views::DepthView>& views) {
  Volume volume = volume_with_a_weak_sample();
  const auto strong = volume.weight[0];
  EXPECT_TRUE(forget_doubtful_surface(volume, views, {}));
  EXPECT_EQ(volume.weight[0], strong);
  return volume.weight[weak_sample(volume)];
}

TEST(ForgetDoubtfulSurface, MakesUnknownWhatOnlyPixelsBesideAStepMeasured) {
  EXPECT_EQ(weight_after({view_beside_a_step()}), 0.0f);
}

TEST(ForgetDoubtfulSurface, KeepsWhatOneViewMeasuredClearOfSteps) {
  EXPECT_EQ(weight_after({view_beside_a_step(), plain_view(kDepth)}), kWeak);
}

TEST(ForgetDoubtfulSurface, TakesNoViewForAWitnessThatMeasuredSomethingElse) {
  EXPECT_EQ(weight_after({view_beside_a_step(), plain_view(kDepth + 100)}), 0.0f);
  EXPECT_EQ(weight_after({view_beside_a_step(), plain_view(kDepth - 100)}), 0.0f);
  EXPECT_EQ(weight_after({view_beside_a_step(), plain_view(0)}), 0.0f);
}

TEST(ForgetDoubtfulSurface, LeavesWhatManyViewsMeasuredWhateverLiesBeside) {
  Volume volume = volume_with_a_weak_sample();
  volume.weight[weak_sample(volume)] = 8.0f;
  ASSERT_TRUE(forget_doubtful_surface(volume, std::vector{view_beside_a_step()}, {}));
  EXPECT_EQ(volume.weight[weak_sample(volume)], 8.0f);
}

TEST(ForgetDoubtfulSurface, CanBeCancelled) {
  Volume volume = volume_with_a_weak_sample();
  const RunContext context;
  context.cancel();
  EXPECT_EQ(
      forget_doubtful_surface(volume, std::vector{view_beside_a_step()}, context).error().code,
      ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::tsdf
