#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <turnscan/core/median.hpp>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>

#include "tests/reconstruction/texture/painted_ellipsoid.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan::texture {
namespace {

using testing::ellipsoid_frames;
using testing::ellipsoid_mesh;
using testing::EllipsoidPictures;

struct Textured {
  TriangleMesh mesh;
  TextureReport report;
};

Textured texture_of(const EllipsoidPictures& pictures, const TextureOptions& options = {},
                    const RunContext& context = RunContext()) {
  const MemoryFrames frames = ellipsoid_frames(pictures);
  std::vector<Pose> poses;
  for (const FrameInfo& info : frames.frames()) poses.push_back(*info.T_table_sensor);
  Textured out;
  out.mesh = ellipsoid_mesh(90);
  auto report = texture_mesh(frames, color_views(frames, poses, {}, std::nullopt), options,
                             out.mesh, context);
  EXPECT_TRUE(report) << report.error().text();
  if (report) out.report = *report;
  return out;
}

/// How far the texture is from the pattern where the camera looks at the surface from the front:
/// root of the mean square, levels.
double error_of(const TriangleMesh& mesh) {
  double sum = 0.0, count = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const Vec3f p = (mesh.vertices[v[0]] + mesh.vertices[v[1]] + mesh.vertices[v[2]]) / 3.0f;
    if (p.y() < -0.015f) continue;
    const Vec3f is = texture_at(mesh, t, 1.0f / 3, 1.0f / 3);
    sum += double((is - testing::pattern_at(p.cast<double>())).squaredNorm()) / 3.0;
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

TEST(TextureMesh, ShowsThePatternOfTheImages) {
  const Textured made = texture_of({});
  ASSERT_TRUE(has_texture(made.mesh));
  EXPECT_LT(error_of(made.mesh), 5.0);
  EXPECT_GT(made.report.filled_share, 0.02);  // nobody looks from below
  EXPECT_LT(made.report.filled_share, 0.4);
  EXPECT_EQ(made.report.views, 24u);
}

TEST(TextureMesh, TakesOutAnExposureThatDrifts) {
  EllipsoidPictures pictures;
  pictures.gain = [](int f) {
    return Vec3f(1.0f + 0.2f * float(std::sin(f * 2.1)), 1.0f + 0.2f * float(std::sin(f * 1.3)),
                 1.0f + 0.2f * float(std::cos(f * 2.9)));
  };
  const Textured made = texture_of(pictures);
  ASSERT_EQ(made.report.gains.size(), 24u);
  // Up to one common factor.
  Vec3f product = Vec3f::Zero();
  for (int f = 0; f < 24; ++f)
    product += made.report.gains[std::size_t(f)].cwiseProduct(pictures.gain(f)) / 24.0f;
  for (int f = 0; f < 24; ++f)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(made.report.gains[std::size_t(f)][c] * pictures.gain(f)[c], product[c], 0.02f)
          << f;
  EXPECT_LT(error_of(made.mesh), 8.0);
}

TEST(TextureMesh, LeavesNoTrailOfAHighlight) {
  EllipsoidPictures pictures;
  pictures.gloss = [](const Vec3d& normal, const Vec3d& to_eye) {
    const Vec3d half = (to_eye + Vec3d(0.3, -0.5, -0.8).normalized()).normalized();
    return 120.0f * float(std::pow(std::max(0.0, normal.dot(half)), 250.0));
  };
  EXPECT_LT(error_of(texture_of(pictures).mesh), 8.0);
}

/// How far the light of an evenly painted texture is from its middle, in shares of that: what 95 of
/// 100 places, those that were seen, stay below.
double shading_left(const TriangleMesh& mesh) {
  std::vector<double> light;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3f& p = mesh.vertices[mesh.triangles[t][0]];
    if (p.y() > -0.015f)
      light.push_back(std::pow(double(texture_at(mesh, t, 1.0f / 3, 1.0f / 3).y()) / 255.0, 2.2));
  }
  const double middle = median(light);
  for (double& value : light) value = std::abs(value / middle - 1.0);
  std::sort(light.begin(), light.end());
  return light[light.size() * 95 / 100];
}

/// Evenly painted, before a lamp from the right and above.
EllipsoidPictures white_before_a_lamp() {
  EllipsoidPictures pictures;
  pictures.pattern = [](const Vec3d&) { return Vec3f(190.0f, 190.0f, 190.0f); };
  pictures.lamp = [](const Vec3d& normal, const Vec3d&) {
    const Vec3d to_lamp = Vec3d(0.7, -0.5, -0.5).normalized();
    return 0.4f + 0.6f * float(std::max(0.0, normal.dot(to_lamp)));
  };
  return pictures;
}

TEST(TextureMesh, TakesOutTheShadingOfALampThatStandsStill) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  EllipsoidPictures pictures = white_before_a_lamp();
  TextureOptions options;
  options.refine_camera = false;  // nothing to find it by
  EXPECT_GT(shading_left(texture_of(pictures, options).mesh), 0.1);
  options.albedo = true;
  EXPECT_LT(shading_left(texture_of(pictures, options).mesh), 0.05);
  // Nor is there any in a lamp's place where no lamp is.
  pictures.lamp = [](const Vec3d&, const Vec3d&) { return 1.0f; };
  EXPECT_LT(shading_left(texture_of(pictures, options).mesh), 0.02);
}

TEST(TextureMesh, TakesOutTheShadingWhereTheNormalsOfTheMeshAreWrong) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const MemoryFrames frames = ellipsoid_frames(white_before_a_lamp());
  std::vector<Pose> poses;
  for (const FrameInfo& info : frames.frames()) poses.push_back(*info.T_table_sensor);
  TriangleMesh mesh = ellipsoid_mesh(90);
  // Waves of 10 mm that tilt the normals by up to 0.1, as what is left of a sensor's noise.
  for (Vec3f& p : mesh.vertices) {
    const Vec3f wave = 628.0f * p;
    p += 0.00015f * (std::sin(wave.x()) + std::sin(wave.y()) + std::sin(wave.z())) * p.normalized();
  }
  TextureOptions options;
  options.refine_camera = false;
  options.albedo = true;
  ASSERT_TRUE(texture_mesh(frames, color_views(frames, poses, {}, std::nullopt), options, mesh,
                           RunContext()));
  EXPECT_LT(shading_left(mesh), 0.065);
}

/// Differences of light between triangles beside each other that were seen, in shares: what 99 of
/// 100 stay below.
double steps_left(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> beside;
  std::vector<double> steps;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    if (mesh.vertices[v[0]].y() < -0.015f) continue;
    const double light = std::pow(double(texture_at(mesh, t, 1.0f / 3, 1.0f / 3).y()) / 255.0, 2.2);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = std::minmax(v[i], v[(i + 1) % 3]);
      const auto [other, is_new] = beside.emplace(edge, light);
      if (!is_new) steps.push_back(std::abs(light / other->second - 1.0));
    }
  }
  std::sort(steps.begin(), steps.end());
  return steps[steps.size() * 99 / 100];
}

TEST(TextureMesh, ShowsFewStepsWhereViewsOfALampMeet) {
  EllipsoidPictures pictures;
  pictures.frames = 7;
  pictures.pattern = [](const Vec3d&) { return Vec3f(190.0f, 190.0f, 190.0f); };
  // From the right: the left side of each picture is darker than the same place in the next one.
  pictures.lamp = [](const Vec3d& normal, const Vec3d&) {
    const Vec3d to_lamp = Vec3d(0.9, -0.2, -0.4).normalized();
    return 0.5f + 0.5f * float(std::max(0.0, normal.dot(to_lamp)));
  };
  TextureOptions options;
  options.refine_camera = false;  // nothing to find it by
  const Textured made = texture_of(pictures, options);
  EXPECT_LT(steps_left(made.mesh), 0.06);
  for (const Vec3f& gain : made.report.gains) EXPECT_NEAR(gain.y(), 1.0f, 0.1f);
}

TEST(TextureMesh, LeavesLittleOfAHighlightAsWideAsTheViewsAreApart) {
  EllipsoidPictures pictures;
  pictures.frames = 40;
  pictures.gloss = [](const Vec3d& normal, const Vec3d& to_eye) {
    const Vec3d half = (to_eye + Vec3d(0.0, -0.7, -0.7).normalized()).normalized();
    return 120.0f * float(std::pow(std::max(0.0, normal.dot(half)), 40.0));
  };
  EXPECT_LT(error_of(texture_of(pictures).mesh), 10.0);
}

TEST(TextureMesh, LeavesLittleOfAHighlightThatMostViewsOfAPlaceShow) {
  EllipsoidPictures pictures;
  pictures.frames = 40;
  pictures.mirrored = [](const Vec3d& normal, const Vec3d& to_eye) {
    const Vec3d half = (to_eye + Vec3d(0.0, -0.7, -0.7).normalized()).normalized();
    return 0.6f * float(std::pow(std::max(0.0, normal.dot(half)), 20.0));
  };
  EXPECT_LT(error_of(texture_of(pictures).mesh), 6.0);
}

/// Up to half a degree to either side.
double out_of_step(int frame) { return 0.0087 * std::sin(2.4 * frame); }

TEST(TextureMesh, TurnsViewsWhoseImagesAreNotInStepWithTheirDepth) {
  EllipsoidPictures pictures;
  pictures.frames = 36;
  const double in_step = error_of(texture_of(pictures).mesh);
  pictures.turned = out_of_step;
  TextureOptions options;
  options.refine_camera = false;
  const Textured made = texture_of(pictures, options);
  ASSERT_EQ(made.report.turned_rad.size(), 36u);
  for (int f = 0; f < 36; ++f)
    EXPECT_NEAR(made.report.turned_rad[std::size_t(f)], out_of_step(f), 0.003) << f;  // 0.15 pixels
  EXPECT_LT(error_of(made.mesh), 1.15 * in_step);
}

TEST(TextureMesh, LeavesViewsInStepWhereTheyAre) {
  EllipsoidPictures pictures;
  pictures.frames = 36;
  TextureOptions options;
  options.refine_camera = false;
  EXPECT_TRUE(texture_of(pictures, options).report.turned_rad.empty());
  // Nor does an even surface tell of any turn.
  pictures.turned = out_of_step;
  pictures.pattern = [](const Vec3d&) { return Vec3f(190.0f, 190.0f, 190.0f); };
  EXPECT_TRUE(texture_of(pictures, options).report.turned_rad.empty());
}

TEST(TextureMesh, FindsTurnsAlikeForOneThreadAndSeveral) {
  EllipsoidPictures pictures;
  pictures.frames = 12;
  pictures.turned = out_of_step;
  set_thread_count(4);
  const auto several = texture_of(pictures).report.turned_rad;
  set_thread_count(1);
  const auto alone = texture_of(pictures).report.turned_rad;
  set_thread_count(0);
  EXPECT_EQ(several, alone);
}

TEST(ColorView, ThatIsTurnedSeesAPlaceWhereTheTurnedObjectHasIt) {
  ColorView view;
  CameraIntrinsics camera;
  camera.width = 640, camera.height = 480;
  camera.fx = camera.fy = 500.0, camera.cx = 320.0, camera.cy = 240.0;
  view.set_camera(camera);
  view.T_object_table.linear() =
      Eigen::AngleAxisd(0.4, Vec3d(1.0, 2.0, 0.5).normalized()).toRotationMatrix();
  view.T_object_table.translation() = Vec3d(0.02, -0.01, 0.03);
  view.T_sensor_object.translation() = Vec3d(0.01, 0.02, 0.8);
  view.set_pose(Pose::Identity());
  ColorView turned = view;
  turned.turn(0.3);
  const Vec3d p(0.05, 0.04, -0.03);
  const Vec3d moved =
      view.T_object_table * (rotation_about_y(0.3) * (view.T_object_table.inverse() * p));
  const Projection is = turned.project(p.cast<float>()), want = view.project(moved.cast<float>());
  EXPECT_NEAR(is.u, want.u, 1e-2);
  EXPECT_NEAR(is.v, want.v, 1e-2);
  EXPECT_TRUE((turned.T_sensor_object * p).isApprox(view.T_sensor_object * moved, 1e-9));
}

TEST(TextureMesh, FindsAColourCameraThatIsNotWhereItWasSaidToBe) {
  EllipsoidPictures pictures;
  pictures.given_T_color_sensor.linear() =
      Eigen::AngleAxisd(0.008, Vec3d(0.6, 0.64, 0.48).normalized()).toRotationMatrix();
  pictures.given_T_color_sensor.translation() = Vec3d(0.002, -0.002, 0.001);
  TextureOptions options;
  const Textured found = texture_of(pictures, options);
  ASSERT_EQ(found.report.cameras.size(), 1u);
  EXPECT_TRUE(found.report.cameras[0].refined);
  EXPECT_GT(found.report.cameras[0].misplaced_px, 2.0);
  EXPECT_LT(error_of(found.mesh), 8.0);
  options.refine_camera = false;
  EXPECT_GT(error_of(texture_of(pictures, options).mesh), 20.0);
}

TEST(TextureMesh, LeavesARightColourCameraWhereTheSurfaceIsRough) {
  const MemoryFrames frames = ellipsoid_frames({});
  std::vector<Pose> poses;
  for (const FrameInfo& info : frames.frames()) poses.push_back(*info.T_table_sensor);
  TriangleMesh mesh = ellipsoid_mesh(90);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertices[v] += 0.0001f * float(standard_normal(v)) * mesh.vertices[v].normalized();
  const auto report =
      texture_mesh(frames, color_views(frames, poses, {}, std::nullopt), {}, mesh, RunContext());
  ASSERT_TRUE(report);
  ASSERT_EQ(report->cameras.size(), 1u);
  EXPECT_LT(report->cameras[0].misplaced_px, 0.2);
  EXPECT_LT(report->cameras[0].misplaced_px, 3.0 * report->cameras[0].deviation_px);
  EXPECT_LT(report->cameras[0].deviation_px, 1.0);
}

TEST(TextureMesh, IsTheSameForOneThreadAndSeveral) {
  set_thread_count(1);
  const Textured one = texture_of({});
  set_thread_count(4);
  const Textured several = texture_of({});
  set_thread_count(0);
  EXPECT_EQ(one.mesh.texture->image.pixels, several.mesh.texture->image.pixels);
  EXPECT_EQ(one.mesh.texture->corners, several.mesh.texture->corners);
}

TEST(TextureMesh, SaysWhichViewEachPlaceCameFrom) {
  const Textured made = texture_of({});
  const TextureReport& report = made.report;
  ASSERT_EQ(report.used.size(), report.views);
  const auto& squares = report.view_of_square;
  ASSERT_EQ(squares.width * report.square_px, report.size_px);
  std::size_t named = 0, facing = 0, steep = 0, unseen = 0;
  for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
    const auto& v = made.mesh.triangles[t];
    const auto& corners = made.mesh.texture->corners[t];
    const Eigen::Vector2f middle = (corners[0] + corners[1] + corners[2]) / 3.0f;
    const std::uint16_t view =
        squares.at(int(middle.x() * float(squares.width)), int(middle.y() * float(squares.height)));
    const Vec3f &a = made.mesh.vertices[v[0]], &b = made.mesh.vertices[v[1]],
                &c = made.mesh.vertices[v[2]];
    if (view == TextureReport::kNoView) {
      ++unseen;
      EXPECT_LT((a + b + c).y(), 0.0f);  // only what looks down is seen by nobody
      continue;
    }
    ASSERT_LT(view, report.used.size());
    ++named;
    const Vec3f normal = (b - a).cross(c - a).normalized(), middle_m = (a + b + c) / 3.0f;
    const auto cosine = [&](const Vec3f& eye) { return normal.dot((eye - middle_m).normalized()); };
    float best = 0.0f;
    for (const auto& other : report.used) best = std::max(best, cosine(other.eye));
    const float main = cosine(report.used[view].eye);
    EXPECT_GT(main, 0.0f);         // it looks at the front
    EXPECT_GT(main, best - 0.2f);  // and about as well as any
    facing += best > 0.5f ? 1 : 0;
    steep += best > 0.5f && main < 0.5f ? 1 : 0;
  }
  EXPECT_GT(unseen, 0u);
  EXPECT_GT(named, made.mesh.triangles.size() / 2);
  // Of what can be seen from less than 60 degrees aside.
  EXPECT_GT(facing, named / 2);
  EXPECT_LT(double(steep) / double(facing), 0.03);
}

TEST(TextureMesh, TakesTheSizeThatWasAskedFor) {
  TextureOptions options;
  options.size_px = 300;  // down to whole blocks
  const Textured made = texture_of({}, options);
  EXPECT_EQ(made.mesh.texture->image.width, 296);
  EXPECT_EQ(made.report.size_px, 296);
}

TEST(TextureMesh, EndsWhenItIsCancelled) {
  const MemoryFrames frames = ellipsoid_frames({});
  std::vector<Pose> poses;
  for (const FrameInfo& info : frames.frames()) poses.push_back(*info.T_table_sensor);
  TriangleMesh mesh = ellipsoid_mesh(40);
  const RunContext context;
  context.cancel();
  const auto report =
      texture_mesh(frames, color_views(frames, poses, {}, std::nullopt), {}, mesh, context);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(mesh.texture, nullptr);
}

TEST(TextureMesh, WantsColours) {
  EXPECT_TRUE(check_colors(ellipsoid_frames({})));
  std::vector<Frame> frames(1);
  SequenceHeader header;
  header.sensors.resize(1);
  const auto none = check_colors(MemoryFrames(header, std::move(frames)));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kMissingData);
}

}  // namespace
}  // namespace turnscan::texture
