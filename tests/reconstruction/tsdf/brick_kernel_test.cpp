#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/tsdf/range_bounds.hpp>

namespace turnscan::tsdf {
namespace {

double uniform(std::uint64_t counter) { return double(mix64(counter) >> 11) * 0x1p-53; }

VolumeScale scale() {
  VolumeScale out;
  out.cell_m = 0.002;
  out.truncation_m = 0.006;
  out.full_weight_behind_m = 0.004;
  return out;
}

/// A ball and a rod of 70 and 10 mm before a wall half a metre away, with noise, pixels in between,
/// and some that saw nothing or did not look; the border is empty.
views::DepthView scene(Projection projection, std::uint64_t seed) {
  views::DepthView view;
  const Pose pose = Pose(Eigen::AngleAxisd(0.4, Vec3d::UnitX())) * rotation_about_y(0.7);
  view.rotation = pose.linear().cast<float>();
  view.translation = Vec3f(0.01f, -0.02f, 0.5f);
  view.width = 97, view.height = 61;
  view.parallel = projection == Projection::kParallel;
  view.fx = view.parallel ? 250.0f : 130.0f;
  view.fy = view.parallel ? 240.0f : 125.0f;
  view.cx = 47.3f, view.cy = 30.8f;
  if (projection == Projection::kDistorted) {
    view.distorted = true;
    view.lens = {0.1f, -0.2f, 0.001f, -0.002f, 0.05f};
  }
  if (projection == Projection::kRational) {  // of an Azure Kinect's depth camera, rounded
    view.distorted = true;
    view.lens = {0.548f, -0.021f, 0.001f, -0.002f, -0.0027f, 0.89f, 0.086f, -0.0139f, 9.0f};
  }
  view.bias_m = 0.003f;
  view.pixels.assign(std::size_t(view.width) * std::size_t(view.height), 0);
  view.nearest = 65534;
  for (int y = 1; y < 60; ++y) {
    for (int x = 1; x < 96; ++x) {
      const std::uint64_t pixel = 1000 * seed + std::uint64_t(97 * y + x);
      const double dice = uniform(10 * pixel), away = std::hypot(x - 40, y - 30);
      double depth = 0.5 + 0.002 * (uniform(10 * pixel + 1) - 0.5);
      if (away < 17) depth -= 0.035 * std::sqrt(1.0 - away * away / 290.0);
      if (std::abs(x - 70) < 2) depth -= 0.06;
      if (dice > 0.95 && x < 50) depth -= 0.1 * uniform(10 * pixel + 2);
      const auto raw = std::uint16_t(depth * 1e4);
      const std::uint32_t seen = dice < 0.05 ? 0u : raw,
                          free = dice < 0.03 && x < 30 ? 0u : raw - 7u;
      view.pixels[std::size_t(97 * y + x)] =
          views::DepthView::pack(seen, mix64(pixel) % 7 == 0, free);
      if (seen > 0) view.nearest = std::min(view.nearest, raw);
    }
  }
  return view;
}

constexpr Projection kProjections[] = {Projection::kPinhole, Projection::kDistorted,
                                       Projection::kRational, Projection::kParallel};

struct First {
  float at[3];
};
/// First samples of groups of bricks around the scene.
std::vector<First> groups() {
  std::vector<First> out;
  for (int i = -2; i < 2; ++i)
    for (int j = -2; j < 2; ++j)
      for (int k = -2; k < 2; ++k)
        out.push_back({{0.064f * float(i), 0.064f * float(j) - 0.001f, 0.064f * float(k)}});
  return out;
}
First brick_of(const First& group, std::size_t b) {
  return {{group.at[0] + 0.016f * float(b & 3), group.at[1] + 0.016f * float(b >> 2 & 3),
           group.at[2] + 0.016f * float(b >> 4)}};
}

template <class T>
bool same_bytes(const T& a, const T& b) {
  const auto* x = reinterpret_cast<const std::byte*>(&a);
  return std::equal(x, x + sizeof a, reinterpret_cast<const std::byte*>(&b));
}

BrickSums all_of(const RangeBounds& view, const First& first) {
  BrickSums sums{};
  BrickKernels::current().integrate(*view, first.at, 255, sums);
  return sums;
}
struct Count {
  int weight = 0, free = 0;
};
Count count(const BrickSums& sums) {
  Count out;
  for (const PartSums& part : sums.part) {
    for (std::size_t i = 0; i < kPartSamples; ++i) {
      out.weight += part.weight[i] > 0.0f ? 1 : 0;
      out.free += part.free[i] > 0.0f ? 1 : 0;
    }
  }
  return out;
}

TEST(BrickKernel, IntegratesWhatTheDefinitionSays) {
  const VolumeScale s = scale();
  for (const Projection projection : kProjections) {
    const views::DepthView view = scene(projection, 1);
    RangeBounds bounds;
    bounds.set_view(view, s);
    int compared = 0;
    for (const First& group : groups()) {
      const First first = brick_of(group, 21);
      const BrickSums sums = all_of(bounds, first);
      for (std::size_t sample = 0; sample < 512; sample += 5) {
        const std::size_t i = sample & 7, j = sample >> 3 & 7, k = sample >> 6;
        const Vec3f p = view.rotation * (Vec3f(first.at[0], first.at[1], first.at[2]) +
                                         float(s.cell_m) * Vec3f(float(i), float(j), float(k))) +
                        view.translation;
        const Eigen::Vector2f at = view.project(p);
        const double u = double(at.x()) + 0.5, v = double(at.y()) + 0.5;
        // Beside the border between two pixels rounding decides.
        if (p.z() < 0.05f || std::abs(u - std::round(u)) < 1e-3 ||
            std::abs(v - std::round(v)) < 1e-3)
          continue;
        const bool inside = u >= 0.0 && v >= 0.0 && u < view.width && v < view.height;
        const std::uint32_t word =
            inside ? view.pixels[std::size_t(v) * std::size_t(view.width) + std::size_t(u)] : 0u;
        const double slant = view.parallel ? 1.0 : double(p.norm()) / double(p.z());
        const double d = ((word & 0xffffu) * 1e-4 + 0.003 - double(p.z())) * slant;
        const double c = ((word >> 17 << 1) * 1e-4 + 0.003 - double(p.z())) * slant;
        if (std::abs(std::abs(d) - s.truncation_m) < 1e-4 || std::abs(c - s.truncation_m) < 1e-4)
          continue;
        const double fade =
            std::min(1.0, (s.truncation_m + d) / (s.truncation_m - s.full_weight_behind_m));
        double weight = (word & 0xffffu) != 0 && std::abs(d) < s.truncation_m ? fade : 0.0;
        if ((word & views::DepthView::kEdge) != 0) weight *= double(s.edge_weight);
        const double free = word >> 17 != 0 && c > s.truncation_m ? 1.0 : 0.0;
        const PartSums& part = sums.part[i / 4 + 2 * (j / 4) + 4 * (k / 4)];
        const std::size_t own = i % 4 + 4 * (j % 4) + 16 * (k % 4);
        ASSERT_NEAR(part.weight[own], weight, 0.02);
        ASSERT_NEAR(part.distance[own], weight * d, 2e-4);
        ASSERT_EQ(part.free[own], free);
        compared += weight > 0.0 || free > 0.0 ? 1 : 0;
      }
    }
    EXPECT_GT(compared, 300);
  }
}

TEST(BrickKernel, LeavesOutOnlyPartsAboutWhichAViewSaysNothing) {
  for (const Projection projection : kProjections) {
    const views::DepthView view = scene(projection, 2);
    RangeBounds bounds;
    bounds.set_view(view, scale());
    bounds.compute();
    int left_out = 0, parts_with_surface = 0;
    for (const First& group : groups()) {
      for (std::size_t b = 0; b < kGroupBricks; b += 3) {
        const First first = brick_of(group, b);
        const PartVisibilityMasks visibility =
            BrickKernels::current().part_visibility(*bounds, first.at);
        BrickSums some{};
        BrickKernels::current().integrate(*bounds, first.at,
                                          visibility.near_surface | visibility.partly_free, some);
        const BrickSums all = all_of(bounds, first);
        ASSERT_TRUE(same_bytes(some, all));
        BrickSums surfaces{};
        const bool measured =
            BrickKernels::current().integrate(*bounds, first.at, visibility.near_surface, surfaces);
        ASSERT_EQ(measured, count(all).weight > 0);
        ASSERT_EQ(count(surfaces).weight, count(all).weight);
        left_out += 8 - std::popcount(visibility.near_surface | visibility.partly_free);
        parts_with_surface += std::popcount(visibility.near_surface);
      }
    }
    EXPECT_GT(left_out, 1000);
    EXPECT_GT(parts_with_surface, 100);
  }
}

TEST(BrickKernel, SaysOfBricksWhatTheirSamplesSay) {
  for (const Projection projection : kProjections) {
    const views::DepthView view = scene(projection, 3);
    RangeBounds bounds;
    bounds.set_view(view, scale());
    bounds.compute();
    int free = 0, surface = 0, partly = 0, nothing = 0;
    for (const First& group : groups()) {
      const VisibilityMasks visibility =
          BrickKernels::current().group_visibility(*bounds, group.at);
      ASSERT_EQ(visibility.free & visibility.near_surface, 0u);
      ASSERT_EQ((visibility.free | visibility.near_surface) & visibility.partly_free, 0u);
      for (std::size_t b = 0; b < kGroupBricks; ++b) {
        const Count seen = count(all_of(bounds, brick_of(group, b)));
        if ((visibility.near_surface >> b & 1u) != 0) {
          ++surface;
        } else if ((visibility.free >> b & 1u) != 0) {
          ++free;
          ASSERT_EQ(seen.free, 512);
          ASSERT_EQ(seen.weight, 0);
        } else if ((visibility.partly_free >> b & 1u) != 0) {
          ++partly;
          ASSERT_EQ(seen.weight, 0);
        } else {
          ++nothing;
          ASSERT_EQ(seen.free + seen.weight, 0);
        }
      }
    }
    EXPECT_GT(free, 50);
    EXPECT_GT(surface, 50);
    EXPECT_GT(partly, 20);
    EXPECT_GT(nothing, 500);
  }
}

TEST(BrickKernel, SaysTheSameFromBoundsAndFromPixels) {
  for (const Projection projection : kProjections) {
    const views::DepthView view = scene(projection, 4);
    RangeBounds bounds;
    bounds.set_view(view, scale());
    bounds.compute();
    for (const First& group : groups()) {
      const VisibilityMasks visibility =
          BrickKernels::current().group_visibility(*bounds, group.at);
      for (std::size_t b = 0; b < kGroupBricks; ++b) {
        const Visibility of_pixels = bounds.visibility(group.at, b);
        ASSERT_EQ((visibility.free >> b & 1u) != 0, of_pixels == Visibility::kFree);
        ASSERT_EQ((visibility.near_surface >> b & 1u) != 0, of_pixels == Visibility::kNearSurface);
        ASSERT_EQ((visibility.partly_free >> b & 1u) != 0, of_pixels == Visibility::kPartlyFree);
      }
    }
  }
}

TEST(BrickKernel, GivesTheSameBytesForEveryInstructionSet) {
  const BrickKernel* portable = BrickKernels::find(InstructionSet::kPortable);
  ASSERT_NE(portable, nullptr);
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const BrickKernel* wide = BrickKernels::find(set);
    if (wide == nullptr) continue;
    for (const Projection projection : kProjections) {
      const views::DepthView view = scene(projection, 5);
      RangeBounds bounds;
      bounds.set_view(view, scale());
      bounds.compute();
      const BoundsLevel& level = (*bounds).brick_bounds;
      std::vector<std::uint16_t> planes(4 * view.pixels.size());
      std::vector<std::uint32_t> a(2 * view.pixels.size()), b = a;
      portable->compute_bounds(*bounds, level, planes.data(), a.data());
      wide->compute_bounds(*bounds, level, planes.data(), b.data());
      EXPECT_EQ(a, b);
      for (const First& group : groups()) {
        const VisibilityMasks x = portable->group_visibility(*bounds, group.at);
        const VisibilityMasks y = wide->group_visibility(*bounds, group.at);
        ASSERT_TRUE(same_bytes(x, y));
        BrickSums one{}, other{};
        for (std::size_t n = 0; n < kGroupBricks; n += 9) {
          const First first = brick_of(group, n);
          const PartVisibilityMasks p = portable->part_visibility(*bounds, first.at);
          const PartVisibilityMasks q = wide->part_visibility(*bounds, first.at);
          ASSERT_EQ(p.near_surface, q.near_surface);
          ASSERT_EQ(p.partly_free, q.partly_free);
          ASSERT_EQ(portable->integrate(*bounds, first.at, 255, one),
                    wide->integrate(*bounds, first.at, 255, other));
        }
        ASSERT_TRUE(same_bytes(one, other));
      }
    }
  }
}

TEST(BrickKernel, TakesBricksBesideTheSensorForNearASurface) {
  const views::DepthView view = scene(Projection::kPinhole, 6);
  RangeBounds bounds;
  bounds.set_view(view, scale());
  bounds.compute();
  // From half a metre before the wall back to behind the sensor.
  const Vec3f sensor = view.rotation.transpose() * -view.translation;
  const First group{{sensor.x() - 0.032f, sensor.y() - 0.032f, sensor.z() - 0.032f}};
  const VisibilityMasks visibility = BrickKernels::current().group_visibility(*bounds, group.at);
  for (std::size_t b = 0; b < kGroupBricks; ++b) {
    const First first = brick_of(group, b);
    const Vec3f middle = Vec3f(first.at[0], first.at[1], first.at[2]).array() + 0.007f;
    const float z = (view.rotation * middle + view.translation).z();
    EXPECT_EQ((visibility.near_surface >> b & 1u) != 0, z > (*bounds).brick_bounds.least_z) << z;
    EXPECT_EQ(visibility.free >> b & 1u, 0u);
  }
}

}  // namespace
}  // namespace turnscan::tsdf
