#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>
#include <turnscan/workflow/next_pass/next_pass_picture.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using ::testing::HasSubstr;

constexpr double kNearly = 0.06;

/// A box on the platter, its middle above the axis; unseen: outward directions of unseen faces, the
/// last of which is the base.
ObjectResult box_object(const Vec3f& size, const std::vector<Vec3f>& unseen) {
  ObjectResult object;
  TriangleMesh mesh = test::subdivided(test::cube(), 3);
  for (Vec3f& v : mesh.vertices) v = (v - Vec3f(0.5f, 0.0f, 0.5f)).cwiseProduct(size);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f normal = (mesh.vertices[b] - mesh.vertices[a])
                             .cross(mesh.vertices[c] - mesh.vertices[a])
                             .normalized();
    Evidence evidence = Evidence::kMeasured;
    for (const Vec3f& face : unseen)
      if (face.dot(normal) > 0.9f)
        evidence = face.y() < 0.0f ? Evidence::kBase : Evidence::kInvented;
    object.evidence.push_back(evidence);
  }
  object.mesh = std::move(mesh);
  object.check = check_mesh(object.mesh);
  return object;
}

/// A sensor at -Z, 0.9 m away and 17 degrees up, before a table that turns.
PassViews turn(double elevation_deg = 17.0) {
  PassViews pass;
  const double up = elevation_deg * kRadiansPerDegree;
  const Vec3d eye(0.0, 0.9 * std::sin(up) + 0.05, -0.9 * std::cos(up));
  Pose T_table_sensor = Pose::Identity();
  const Vec3d forward = (Vec3d(0.0, 0.05, 0.0) - eye).normalized();
  const Vec3d right = forward.cross(Vec3d::UnitY()).normalized();
  T_table_sensor.linear().col(0) = right;
  T_table_sensor.linear().col(1) = forward.cross(right);
  T_table_sensor.linear().col(2) = forward;
  T_table_sensor.translation() = eye;
  for (std::size_t k = 0; k < PassViews::kMaxViews; ++k) {
    CoverageView view;
    view.T_table_sensor =
        rotation_about_y(-kTurn * double(k) / double(PassViews::kMaxViews)) * T_table_sensor;
    pass.views.push_back(view);
  }
  return pass;
}

NextPassAdvice advice_for(const ObjectResult& object, const PassViews& pass) {
  const auto advice = advise_next_pass(object, pass, RunContext());
  EXPECT_TRUE(advice && *advice);
  return advice && *advice ? **advice : NextPassAdvice();
}

TEST(NextPass, AUnseenBaseAloneIsShownByLayingTheObjectDown) {
  const ObjectResult object = box_object(Vec3f(0.06f, 0.2f, 0.1f), {-Vec3f::UnitY()});
  const NextPassAdvice advice = advice_for(object, turn());
  EXPECT_NEAR(advice.unseen.unseen_m2(), 0.006, 1e-5);
  EXPECT_NEAR(advice.unseen.base_m2, 0.006, 1e-5);
  ASSERT_FALSE(advice.poses.empty());
  const NextPose& pose = advice.poses.front();
  EXPECT_TRUE(pose.stands);
  EXPECT_NEAR(pose.shows_m2, 0.006, 0.0003);
  // On one of the wide sides it stands best.
  EXPECT_NEAR(pose.tip_rad, 0.25 * kTurn, kNearly);
  EXPECT_NEAR(std::abs(std::sin(pose.towards_rad)), 1.0, kNearly);
  EXPECT_NEAR((pose.T_table_mesh * Vec3d(0.0, 0.1, 0.0)).y(), 0.03, 0.001);
}

TEST(NextPass, TheSideThatWasSeenGoesDown) {
  // Base and right side, seen from the sensor, are missing: the left side goes down.
  const ObjectResult object =
      box_object(Vec3f(0.06f, 0.2f, 0.1f), {-Vec3f::UnitX(), -Vec3f::UnitY()});
  const NextPassAdvice advice = advice_for(object, turn());
  EXPECT_NEAR(advice.unseen.sides_m2, 0.02, 1e-4);
  ASSERT_FALSE(advice.poses.empty());
  const NextPose& pose = advice.poses.front();
  EXPECT_NEAR(pose.shows_m2, 0.026, 0.0005);
  EXPECT_NEAR(pose.towards_rad, 0.75 * kTurn, kNearly);
  const std::string text = next_pass_text(advice);
  EXPECT_THAT(text, HasSubstr("No view saw 260 cm2 of its surface of"));
  EXPECT_THAT(text, HasSubstr("base 60 cm2, sides 200 cm2"));
  EXPECT_THAT(text, HasSubstr("lay it on its left side"));
  EXPECT_THAT(text, HasSubstr("tip it by 90 degrees to the left"));
  // As the sensor sees it, its top goes to the left: x of the sensor is to the right.
  const Vec3d top = turn_seen_by_sensor(pose, turn()) *
                    (turn().views[0].T_table_sensor.linear().transpose() * Vec3d::UnitY());
  EXPECT_NEAR(top.x(), -1.0, kNearly);
}

TEST(NextPass, WordsAreTheSameFromWhereverTheSensorStands) {
  const ObjectResult object =
      box_object(Vec3f(0.06f, 0.2f, 0.1f), {-Vec3f::UnitX(), -Vec3f::UnitY()});
  PassViews pass = turn();
  for (CoverageView& view : pass.views)
    view.T_table_sensor = rotation_about_y(0.5 * kTurn) * view.T_table_sensor;
  EXPECT_THAT(next_pass_text(advice_for(object, pass)), HasSubstr("lay it on its right side"));
  pass = turn();
  for (CoverageView& view : pass.views)
    view.T_table_sensor = rotation_about_y(-0.25 * kTurn) * view.T_table_sensor;
  EXPECT_THAT(next_pass_text(advice_for(object, pass)), HasSubstr("lay it on its front"));
}

TEST(NextPass, PosesAreCountedFromHowTheObjectLayInThePass) {
  // The pass saw the object upside down, so that its base was above and its top below.
  const ObjectResult object = box_object(Vec3f(0.06f, 0.2f, 0.1f), {Vec3f::UnitY()});
  PassViews pass = turn();
  pass.T_mesh_table =
      Pose(Eigen::Translation3d(0.0, 0.2, 0.0) * Eigen::AngleAxisd(0.5 * kTurn, Vec3d::UnitX()));
  pass.name = "pass 1";
  const NextPassAdvice advice = advice_for(object, pass);
  EXPECT_NEAR(advice.unseen.underside_m2, 0.006, 1e-5);
  ASSERT_FALSE(advice.poses.empty());
  EXPECT_NEAR(advice.poses.front().tip_rad, 0.25 * kTurn, kNearly);
  EXPECT_THAT(next_pass_text(advice), HasSubstr("at the beginning of pass 1"));
}

TEST(NextPass, WhatRollsHasToBePropped) {
  ObjectResult object;
  object.mesh = test::sphere(0.08, 5, Vec3d(0.0, 0.08, 0.0));
  for (const auto& t : object.mesh.triangles)
    object.evidence.push_back(object.mesh.vertices[t[0]].y() < 0.03f ? Evidence::kInvented
                                                                     : Evidence::kMeasured);
  object.check = check_mesh(object.mesh);
  const NextPassAdvice advice = advice_for(object, turn());
  ASSERT_FALSE(advice.poses.empty());
  EXPECT_FALSE(advice.poses.front().stands);
  EXPECT_GT(advice.poses.front().shows_m2, 0.9 * advice.unseen.unseen_m2());
  EXPECT_THAT(next_pass_text(advice), HasSubstr("prop it up"));
}

TEST(NextPass, NothingIsAdvisedWhereNothingIsMissingOrKnown) {
  const PassViews pass = turn();
  ObjectResult object = box_object(Vec3f(0.06f, 0.2f, 0.1f), {});
  EXPECT_FALSE(*advise_next_pass(object, pass, RunContext()));
  object = box_object(Vec3f(0.06f, 0.2f, 0.1f), {-Vec3f::UnitY()});
  EXPECT_FALSE(*advise_next_pass(object, PassViews(), RunContext()));
  object.evidence.clear();
  EXPECT_FALSE(*advise_next_pass(object, pass, RunContext()));
  object = box_object(Vec3f(0.06f, 0.2f, 0.1f), {-Vec3f::UnitY()});
  object.mesh.triangles.pop_back();
  object.evidence.pop_back();
  object.check = check_mesh(object.mesh);
  EXPECT_FALSE(*advise_next_pass(object, pass, RunContext()));
  const RunContext cancelled;
  cancelled.cancel();
  object = box_object(Vec3f(0.06f, 0.2f, 0.1f), {-Vec3f::UnitY()});
  EXPECT_EQ(advise_next_pass(object, pass, cancelled).error().code, ErrorCode::kCancelled);
}

TEST(NextPass, APictureShowsTheUnseenSurface) {
  const ObjectResult object =
      box_object(Vec3f(0.06f, 0.2f, 0.1f), {-Vec3f::UnitX(), -Vec3f::UnitY()});
  const auto picture = next_pass_picture(object, turn(), advice_for(object, turn()), RunContext());
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 2 * picture->height);
  const auto pink = [&](int first, int last) {
    std::size_t count = 0;
    for (int y = 0; y < picture->height; ++y)
      for (int x = first; x < last; ++x) {
        const Rgb& p = picture->pixels[std::size_t(y * picture->width + x)];
        count += p.r > 2 * p.g + 30 ? 1 : 0;
      }
    return count;
  };
  EXPECT_GT(pink(picture->height, picture->width), 4 * pink(0, picture->height) + 1000);
}

}  // namespace
}  // namespace turnscan
