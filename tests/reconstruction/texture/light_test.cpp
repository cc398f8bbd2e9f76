// Lamps and their highlights, as they are found in views of an ellipsoid.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/texture/highlight.hpp>
#include <turnscan/reconstruction/texture/lamp.hpp>

#include "tests/reconstruction/texture/painted_ellipsoid.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan::texture {
namespace {

using testing::ellipsoid_frames;
using testing::ellipsoid_mesh;
using testing::EllipsoidPictures;

/// The sensor's axes in the rig's frame.
Eigen::Matrix3d rig_axes() {
  EllipsoidPictures one;
  one.frames = 1;
  return ellipsoid_frames(one).header().sensors[0].T_table_sensor->linear();
}

/// What lights are looked for in: pictures of an ellipsoid, as texels see them.
class SeenEllipsoid {
 public:
  explicit SeenEllipsoid(const EllipsoidPictures& pictures)
      : mesh_(ellipsoid_mesh(90)),
        normals_(vertex_normals(mesh_)),
        atlas_(*make_atlas(mesh_, 256, 1e9, RunContext())),
        blocks_(mesh_, atlas_, normals_) {
    const MemoryFrames frames = ellipsoid_frames(pictures);
    std::vector<Pose> poses;
    for (const FrameInfo& info : frames.frames()) poses.push_back(*info.T_table_sensor);
    const auto views = color_views(frames, poses, {}, std::nullopt);
    for (const ColorView& view : views) {
      from_.rotation.push_back((rig_axes() * view.T_sensor_object.linear()).cast<float>());
      from_.eye.push_back(view.eye());
    }
    chosen_ = *choose_views(mesh_, blocks_, views, RunContext());
    samples_ = *sample_views(frames, mesh_, blocks_, views, chosen_, RunContext());
    means_ = block_means(blocks_, chosen_, samples_);
  }

  std::optional<Highlight> highlight() const {
    return *solve_highlight(blocks_, chosen_, means_, from_, RunContext());
  }
  /// With shadows of all that `caster` has.
  FixedLight light(const TriangleMesh& caster) const {
    const LampScene scene{mesh_, caster, blocks_, chosen_, means_, from_.rotation};
    return *solve_light(scene, std::vector<Vec3f>(from_.eye.size(), Vec3f::Ones()), std::nullopt,
                        RunContext());
  }

 private:
  TriangleMesh mesh_;
  std::vector<Vec3f> normals_;
  Atlas atlas_;
  TexelBlocks blocks_;
  Viewpoints from_;
  ChosenViews chosen_;
  TexelSamples samples_;
  BlockMeans means_;
};

double degrees_between(const Vec3f& a, const Vec3f& b) {
  return double(std::acos(std::clamp(a.dot(b), -1.0f, 1.0f))) * 360.0 / kTurn;
}

const Vec3d kToLamp = Vec3d(0.4, -0.6, -0.7).normalized();  // sensor's axes

EllipsoidPictures glossy() {
  EllipsoidPictures pictures;
  pictures.frames = 36;
  pictures.mirrored = [](const Vec3d& normal, const Vec3d& to_eye) {
    return 0.4f * float(std::pow(std::max(0.0, normal.dot((to_eye + kToLamp).normalized())), 50.0));
  };
  return pictures;
}

TEST(Highlight, IsFoundWhereALampIsMirrored) {
  const auto found = SeenEllipsoid(glossy()).highlight();
  ASSERT_TRUE(found);
  EXPECT_LT(degrees_between(found->direction, (rig_axes() * kToLamp).cast<float>()), 3.0);
  EXPECT_NEAR(found->strength, 0.4f, 0.08f);
  EXPECT_NEAR(found->exponent, 50.0f, 12.0f);
}

TEST(Highlight, IsNotSeenOnADullSurfaceNorInTheShadingOfALamp) {
  EllipsoidPictures dull;
  dull.frames = 36;
  EXPECT_FALSE(SeenEllipsoid(dull).highlight());
  dull.lamp = [](const Vec3d& normal, const Vec3d&) {
    return 0.4f + 0.6f * float(std::max(0.0, normal.dot(kToLamp)));
  };
  EXPECT_FALSE(SeenEllipsoid(dull).highlight());
}

TEST(Highlight, IsTheSameForOneThreadAndSeveral) {
  const SeenEllipsoid seen(glossy());
  set_thread_count(4);
  const auto several = seen.highlight();
  set_thread_count(1);
  const auto alone = seen.highlight();
  set_thread_count(0);
  ASSERT_TRUE(several && alone);
  EXPECT_EQ(several->direction, alone->direction);
  EXPECT_EQ(several->strength, alone->strength);
  EXPECT_EQ(several->exponent, alone->exponent);
}

constexpr double kHatRadius_m = 0.04, kHatHeight_m = 0.055;

/// The ellipsoid with a round plate above it, which turns without a change.
TriangleMesh with_hat(TriangleMesh mesh) {
  const auto middle = std::uint32_t(mesh.vertices.size());
  constexpr std::uint32_t kAround = 48;
  mesh.vertices.emplace_back(0.0f, float(kHatHeight_m), 0.0f);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const double a = kTurn * i / kAround;
    mesh.vertices.push_back(
        Vec3d(kHatRadius_m * std::cos(a), kHatHeight_m, kHatRadius_m * std::sin(a)).cast<float>());
    mesh.triangles.push_back({middle, middle + 1 + (i + 1) % kAround, middle + 1 + i});
  }
  return mesh;
}

TEST(Lamp, IsFoundByTheShadowsThatAreCast) {
  if (testing::kSanitized) GTEST_SKIP() << "others run the same code";
  EllipsoidPictures pictures;
  const Vec3d up = rig_axes().transpose() * Vec3d::UnitY();
  pictures.lamp = [&](const Vec3d& normal, const Vec3d& p) {
    const Vec3d q = p + (kHatHeight_m - p.dot(up)) / kToLamp.dot(up) * kToLamp;
    const bool reached = (q - q.dot(up) * up).norm() > kHatRadius_m;
    return 0.4f + (reached ? 0.6f * float(std::max(0.0, normal.dot(kToLamp))) : 0.0f);
  };
  const SeenEllipsoid seen(pictures);
  const Vec3f truth = (rig_axes() * kToLamp).cast<float>();
  const auto share = [](const FixedLight& light) {
    return light.lamp / (light.lamp + light.ambient);
  };
  const FixedLight found = seen.light(with_hat(ellipsoid_mesh(90)));
  EXPECT_LT(degrees_between(found.direction, truth), 3.0);
  EXPECT_NEAR(share(found), 0.6f, 0.05f);
  // The shadows tell: who knows nothing of the hat takes its shadow for the lamp's direction.
  EXPECT_GT(degrees_between(seen.light(ellipsoid_mesh(90)).direction, truth), 6.0);
}

}  // namespace
}  // namespace turnscan::texture
