#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <tests/reconstruction/retreating_outlines.hpp>
#include <tests/reconstruction/turning_scan.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_color.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>
#include <turnscan/reconstruction/seen_space.hpp>
#include <turnscan/reconstruction/tsdf/volumetric.hpp>

namespace turnscan::tsdf {
namespace {

using ::testing::HasSubstr;
using namespace turnscan::testing;

TEST(Volumetric, IsFarBelowTheNoiseOfTheSensor) {
  const auto result = reconstruct(scan(ball, {60, 0.001}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
  EXPECT_LT(median_error_to_ball(result->objects[0].mesh), 0.00025);
}

TEST(Volumetric, NoViewsHaveNoPoints) {
  const auto points = sample_points(VolumetricInput());
  EXPECT_EQ(points.cloud.size(), 0u);
  EXPECT_TRUE(points.viewpoints.empty());
}

TEST(Volumetric, FlyingPixelsLeaveNothingBehind) {
  const auto result = reconstruct(scan(ball, {40, 0.001, 0.5}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  for (const Vec3f& v : result->objects[0].mesh.vertices)
    EXPECT_LT((v.cast<double>() - kCenter).norm(), 0.056);  // the stand's corners are at 0.0543
}

TEST(Volumetric, StandsFlatOnThePlatter) {
  const auto result = reconstruct(scan(ball, {}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const TriangleMesh& mesh = result->objects[0].mesh;
  EXPECT_NEAR(bounds(mesh.vertices).min.y(), 0.0, 1e-6);
  double flat = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3f &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if (std::max({a.y(), b.y(), c.y()}) < 1e-6f) flat += 0.5 * (b - a).cross(c - a).norm();
  }
  EXPECT_NEAR(flat, 0.03 * 0.03, 0.25 * 0.03 * 0.03);  // the rim is a voxel wide
  EXPECT_THAT(result->objects[0].notes, ::testing::Contains(HasSubstr("base was closed")));
}

TEST(Volumetric, StandsOnAPlatterOfKnownRadiusThatIsNotSeen) {
  // A ball that rests on one point: half of it lies within 15 mm of where the platter would be, and
  // is not taken for it. Its lowest 2 mm are closed flat.
  const Vec3d center(0.0, 0.02, 0.0);
  const auto resting = [&](const Vec3d& o, const Vec3d& d) { return to_ball(o, d, center, 0.02); };
  Rig rig;
  for (const bool platter : {false, true}) {
    rig.platter = platter;
    MemorySequence recording = scan(resting, rig);
    recording.header_value.turntable->radius_m = 0.12;
    const auto result = reconstruct(recording, volumetric(), {}, RunContext());
    ASSERT_TRUE(result) << result.error().text();
    const auto margin =
        std::find_if(result->choices.begin(), result->choices.end(),
                     [](const ResolvedParameter& c) { return c.option == "crop-margin"; });
    ASSERT_NE(margin, result->choices.end());
    EXPECT_THAT(margin->reason,
                HasSubstr(platter ? "the platter's returns lie at" : "4 times the sensor's noise"));
    ASSERT_EQ(result->objects.size(), 1u);
    if (platter) continue;
    std::size_t far = 0;
    for (const Vec3f& v : result->objects[0].mesh.vertices)
      far += std::abs((v.cast<double>() - center).norm() - 0.02) > 0.0015;
    EXPECT_LT(double(far), 0.25 * double(result->objects[0].mesh.vertices.size()));
  }
}

TEST(Volumetric, BothSidesOfAThinPlateSurvive) {
  for (const double thickness : {0.003, 0.005}) {  // pixels lie 2.3 mm apart
    const double half = 0.5 * thickness;
    const auto plate = [&](const Vec3d& o, const Vec3d& d) {
      return to_box(o, d, Vec3d(-0.03, 0, -half), Vec3d(0.03, 0.07, half));
    };
    const auto result = reconstruct(scan(plate, {60, 0.001}), volumetric(), {}, RunContext());
    ASSERT_TRUE(result) << result.error().text();
    double sum = 0.0;
    std::size_t n = 0;
    for (const Vec3f& v : result->objects[0].mesh.vertices) {
      if (std::abs(v.x()) > 0.022f || v.y() < 0.01f || v.y() > 0.06f) continue;
      sum += std::abs(double(v.z()));
      ++n;
    }
    ASSERT_GT(n, 100u);
    EXPECT_NEAR(2.0 * sum / double(n), thickness, 0.0005);
  }
}

TEST(Volumetric, AnArmTwoPixelsWideSurvives) {
  const auto post_with_arm = [](const Vec3d& o, const Vec3d& d) {
    return nearer(to_box(o, d, Vec3d(-0.015, 0, -0.015), Vec3d(0.015, 0.08, 0.015)),
                  to_box(o, d, Vec3d(0.015, 0.05, -0.0025), Vec3d(0.06, 0.055, 0.0025)));
  };
  const auto result = reconstruct(scan(post_with_arm, {60, 0.001}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  Box middle, whole = bounds(result->objects[0].mesh.vertices);
  for (const Vec3f& v : result->objects[0].mesh.vertices) {
    if (v.x() > 0.025f && v.x() < 0.05f) middle.add(v.cast<double>());
  }
  EXPECT_NEAR(whole.max.x(), 0.06, 0.0015);
  EXPECT_NEAR(middle.size().z(), 0.005, 0.002);  // each side within 1 mm
  EXPECT_NEAR(middle.max.y(), 0.055, 0.001);
}

TEST(Volumetric, MakesASolidOfTheProfilesOfALineScanner) {
  const auto result = reconstruct(line_scan(ball), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
  EXPECT_LT(median_error_to_ball(result->objects[0].mesh), 0.0001);
}

TEST(Volumetric, WhatHangsInTheAirBelongsToWhatStandsBelow) {
  const auto with_balloon = [](const Vec3d& o, const Vec3d& d) {
    return nearer(ball(o, d), to_ball(o, d, Vec3d(0.06, 0.08, 0.0), 0.015));
  };
  const auto result = reconstruct(scan(with_balloon, {}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
  EXPECT_EQ(result->objects[0].check.components, 2u);
  EXPECT_THAT(result->objects[0].notes, ::testing::Contains(HasSubstr("hangs in the air")));
}

TEST(Volumetric, SaysWhereSensorsHadNoReturn) {
  // A ball with a black band, on nothing that would be seen behind it.
  const auto banded = [](const Vec3d& o, const Vec3d& d) {
    const double t = ball(o, d);
    return std::abs((o + t * d).y() - kCenter.y() - 0.004) < 0.006 ? 0.0 : t;
  };
  Rig rig;
  rig.platter = false;
  const auto no_return = [&](const Trace& things) {
    const auto result = reconstruct(scan(things, rig), volumetric(), {}, RunContext());
    EXPECT_TRUE(result) << result.error().text();
    EXPECT_EQ(result->objects.size(), 1u) << "one object, whatever band is missing";
    EXPECT_EQ(result->objects[0].check.components, 1);
    const auto& notes = result->objects[0].notes;
    return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
      return note.find("too dark") != std::string::npos;
    });
  };
  EXPECT_TRUE(no_return(banded));
  EXPECT_FALSE(no_return(ball));
}

/// Two blocks, one above the other, and between them a post that returns nothing, in a room.
double banded_figure(const Vec3d& o, const Vec3d& d) {
  const double post = to_box(o, d, Vec3d(-0.008, 0.02, -0.008), Vec3d(0.008, 0.06, 0.008));
  const double block = nearer(to_box(o, d, Vec3d(-0.025, 0, -0.025), Vec3d(0.025, 0.03, 0.025)),
                              to_box(o, d, Vec3d(-0.02, 0.055, -0.02), Vec3d(0.02, 0.08, 0.02)));
  const double t = nearer(post, block);
  if (t > 0.0) return t == post ? 1e-6 : t;  // no depth, but nothing is seen through it
  return 1.5 / d.norm();
}

TEST(Volumetric, ABlackBandIsJoinedByItsVisualHull) {
  const auto result = reconstruct(scan(banded_figure, {36, 0.0}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  const ObjectResult& object = result->objects[0];
  EXPECT_EQ(object.check.components, 1u);
  EXPECT_TRUE(is_solid(object.mesh));
  EXPECT_THAT(object.notes, ::testing::Contains(HasSubstr("too dark")));
  // Neither much thinner than the post, whose corners are 11 mm from its axis, nor as wide as the
  // blocks.
  std::size_t between = 0;
  for (std::size_t v = 0; v < object.mesh.vertices.size(); ++v) {
    const Vec3f& p = object.mesh.vertices[v];
    if (p.y() < 0.038f || p.y() > 0.048f) continue;
    ++between;
    EXPECT_GT(std::hypot(p.x(), p.z()), 0.006f);
    EXPECT_LT(std::hypot(p.x(), p.z()), 0.018f);
    EXPECT_LT(object.confidence[v], 0.02f) << "marked as invented";
  }
  EXPECT_GT(between, 100u);
}

TEST(Volumetric, WithoutABackgroundHolesAreNoBand) {
  // A gate: through its opening nothing is seen, and that says nothing of what is there.
  const auto gate = [](const Vec3d& o, const Vec3d& d) {
    const auto post = [&](double x) {
      return to_box(o, d, Vec3d(x - 0.006, 0, -0.006), Vec3d(x + 0.006, 0.08, 0.006));
    };
    return nearer(nearer(post(-0.025), post(0.025)),
                  to_box(o, d, Vec3d(-0.031, 0.068, -0.006), Vec3d(0.031, 0.08, 0.006)));
  };
  const auto result = reconstruct(scan(gate, {36, 0.0005}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  for (const Vec3f& p : result->objects[0].mesh.vertices)
    EXPECT_FALSE(std::abs(p.x()) < 0.015f && p.y() > 0.01f && p.y() < 0.06f) << p.transpose();
}

TEST(Volumetric, ForPlacingHasTheSameMeasuredSurfaceAndNothingMore) {
  const MemorySequence sequence = scan(ball, Rig());
  ReconstructOptions options = volumetric();
  options.finish.triangles = "all";
  const auto whole = reconstruct(sequence, options, {}, RunContext());
  options.for_placing = true;
  const auto placing = reconstruct(sequence, options, {}, RunContext());
  ASSERT_TRUE(whole && placing);
  EXPECT_TRUE(placing->seen);
  EXPECT_FALSE(whole->seen);
  EXPECT_TRUE(placing->objects[0].quality.empty());
  EXPECT_EQ(passes::measured_surface(placing->objects[0]).points,
            passes::measured_surface(whole->objects[0]).points);
}

/// Value of an automatic choice, metres.
double chosen(const Reconstruction& result, const std::string& option) {
  for (const ResolvedParameter& choice : result.choices) {
    if (choice.option == option)
      return parse_quantity(choice.value, Quantity::kLength).value_or(0.0);
  }
  ADD_FAILURE() << option;
  return 0.0;
}

TEST(Volumetric, IsMadeAgainWhenLaterFramesDisagreeMoreThanTheFirst) {
  Rig rig{64, 0.0005};
  rig.platter = false;
  MemorySequence sequence = scan(ball, rig), first = sequence;
  first.infos.resize(32);
  // From the first look's frames on, frames lie up to 4 mm too near or too far.
  for (std::size_t f = 32; f < sequence.data.size(); ++f) {
    for (std::uint16_t& raw : sequence.data[f].depth.pixels) {
      if (raw > 0) raw = std::uint16_t(raw + 20 * (int(f % 5) - 2));
    }
  }
  const auto again = ::testing::Contains(HasSubstr("integrated again"));
  const auto of_first = reconstruct(first, volumetric(), {}, RunContext());
  ASSERT_TRUE(of_first) << of_first.error().text();
  EXPECT_THAT(of_first->notes, ::testing::Not(again));
  const auto of_all = reconstruct(sequence, volumetric(), {}, RunContext());
  ASSERT_TRUE(of_all) << of_all.error().text();
  EXPECT_THAT(of_all->notes, again);
  EXPECT_GT(chosen(*of_all, "truncation"), 1.2 * chosen(*of_first, "truncation"));
  ASSERT_FALSE(of_all->objects.empty());
  EXPECT_TRUE(is_solid(of_all->objects[0].mesh));
  ReconstructOptions given = volumetric();
  given.volumetric.truncation_m = 0.004;  // then it does not depend on the noise
  const auto once = reconstruct(sequence, given, {}, RunContext());
  ASSERT_TRUE(once) << once.error().text();
  EXPECT_THAT(once->notes, ::testing::Not(again));
}

TEST(Volumetric, WhatSomeFramesSeePastIsNotHollowed) {
  MemorySequence uneven = scan(carton, {30, 0.0005});
  for (std::size_t f = 0; f < uneven.infos.size(); ++f)  // by 0.4 degrees
    *uneven.infos[f].angle_rad += 0.007 * standard_normal(hash_key(f, 1, 2));
  const auto good = reconstruct(uneven, volumetric(), {}, RunContext());
  ASSERT_TRUE(good) << good.error().text();
  const auto result =
      reconstruct(with_retreating_outlines(uneven, 6), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_GT(chosen(*result, "truncation"), 1.5 * chosen(*good, "truncation"));
  EXPECT_GT(result->objects[0].check.volume_m3, 0.93 * good->objects[0].check.volume_m3);
}

TEST(Volumetric, IsSolidWhateverWasRecorded) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const auto random = [&](int k) { return uniform01(hash_key(seed, std::uint64_t(k), 5)); };
    std::vector<std::pair<Vec3d, double>> balls;
    for (int b = 0; b < 1 + int(4 * random(0)); ++b)
      balls.emplace_back(Vec3d(0.1 * random(10 + b) - 0.05, 0.01 + 0.05 * random(20 + b),
                               0.1 * random(30 + b) - 0.05),
                         0.006 + 0.025 * random(40 + b));
    const auto things = [&](const Vec3d& o, const Vec3d& d) {
      double t = 0.0;
      for (const auto& [center, radius] : balls) t = nearer(to_ball(o, d, center, radius), t);
      return t;
    };
    const Rig rig{2 + int(20 * random(1)), 0.002 * random(2), random(3), 0.5 * random(4), seed,
                  random(5) < 0.7};
    const auto result = reconstruct(scan(things, rig), volumetric(), {}, RunContext());
    if (!result) {
      EXPECT_EQ(result.error().code, ErrorCode::kTooFewPoints) << result.error().text();
      continue;
    }
    for (const ObjectResult& object : result->objects)
      EXPECT_TRUE(is_solid(object.mesh)) << "seed " << seed;
  }
}

TEST(Volumetric, TheSameForAnyNumberOfThreads) {
  const MemorySequence sequence = scan(ball, {16, 0.001, 0.3});
  set_thread_count(1);
  const auto one = reconstruct(sequence, volumetric(), {}, RunContext());
  set_thread_count(3);
  const auto three = reconstruct(sequence, volumetric(), {}, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->objects[0].mesh.vertices, three->objects[0].mesh.vertices);
  EXPECT_EQ(one->objects[0].mesh.triangles, three->objects[0].mesh.triangles);
}

TEST(Volumetric, TakesAsFewTrianglesAsAskedFor) {
  ReconstructOptions options = volumetric();
  options.finish.triangles = "500";
  const auto result = reconstruct(scan(ball, {}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LE(result->objects[0].mesh.triangles.size(), 550u);  // mending may add a few
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
}

TEST(Volumetric, MaxErrorBoundsHowFarFewerTrianglesStray) {
  const MemorySequence sequence = scan(ball, {});
  ReconstructOptions options = volumetric();
  options.finish.triangles = "all";
  const auto full = reconstruct(sequence, options, {}, RunContext());
  options.finish.triangles = "auto";
  options.finish.max_error_m = 0.0003;
  const auto fewer = reconstruct(sequence, options, {}, RunContext());
  ASSERT_TRUE(full && fewer);
  const TriangleMesh &a = full->objects[0].mesh, &b = fewer->objects[0].mesh;
  EXPECT_LT(b.triangles.size(), a.triangles.size() / 2);
  EXPECT_TRUE(is_solid(b));
  const MeshDistance distance(b);
  double farthest = 0.0;
  for (const Vec3f& v : a.vertices)
    farthest = std::max(farthest, distance.closest(v.cast<double>()).distance);
  EXPECT_LE(farthest, 0.0003);
  // Whichever ends sooner.
  options.finish.triangles = std::to_string(a.triangles.size() / 2);
  const auto both = reconstruct(sequence, options, {}, RunContext());
  EXPECT_GT(both->objects[0].mesh.triangles.size(), b.triangles.size());
}

/// The ball's frames with images in which it is red on the side of +x (in the table frame) and
/// green on the other.
MemorySequence two_colors(const Rig& rig) {
  MemorySequence sequence = scan(ball, rig);
  const SensorInfo& sensor = sequence.header().sensors[0];
  for (Frame& frame : sequence.data) {
    const Pose pose = rotation_about_y(-*frame.info.angle_rad) * *sensor.T_table_sensor;
    frame.color = ColorImage(160, 120);
    for (int i = 0; i < 160 * 120; ++i) {
      const double z = frame.depth.pixels[std::size_t(i)] * 1e-4;
      const Vec3d p = pose * Vec3d(z * sensor.intrinsics.ray(i % 160, i / 160));
      frame.color.pixels[std::size_t(i)] =
          p.x() > kCenter.x() ? Rgb{200, 20, 10} : Rgb{10, 180, 20};
    }
  }
  return sequence;
}

TEST(Volumetric, CarriesTheColoursOfTheFrames) {
  ReconstructOptions options = volumetric();
  options.color = true;
  const auto result = reconstruct(two_colors({}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const TriangleMesh& mesh = result->objects[0].mesh;
  ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
  std::size_t right = 0, looked = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double x = double(mesh.vertices[v].x()) - kCenter.x();
    if (std::abs(x) < 0.003) continue;
    ++looked;
    right += (mesh.colors[v].r > mesh.colors[v].g) == (x > 0.0) ? 1 : 0;
  }
  EXPECT_GT(double(right), 0.98 * double(looked));
  ReconstructOptions without = volumetric();
  without.finish.triangles = "all";
  const auto plain = reconstruct(two_colors({}), without, {}, RunContext());
  EXPECT_TRUE(plain->objects[0].mesh.colors.empty());
  EXPECT_EQ(plain->objects[0].mesh.vertices, mesh.vertices);
}

TEST(Volumetric, SaysThatARecordingHasNoColour) {
  ReconstructOptions options = volumetric();
  options.color = true;
  const auto result = reconstruct(scan(ball, {}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_TRUE(result->objects[0].mesh.colors.empty());
  EXPECT_THAT(result->objects[0].notes, ::testing::Contains(HasSubstr("no colour")));
}

TEST(Volumetric, ConfidenceIsLowWhereNothingWasMeasured) {
  const auto result = reconstruct(scan(ball, {}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const ObjectResult& object = result->objects[0];
  ASSERT_EQ(object.confidence.size(), object.mesh.vertices.size());
  double top = 0.0, base = 0.0;
  std::size_t at_top = 0, at_base = 0;
  for (std::size_t v = 0; v < object.confidence.size(); ++v) {
    EXPECT_GE(object.confidence[v], 0.0f);
    EXPECT_LE(object.confidence[v], 1.0f);
    const double y = object.mesh.vertices[v].y();
    if (y > kCenter.y() + 0.01) top += double(object.confidence[v]), ++at_top;
    if (y < 1e-5) base += double(object.confidence[v]), ++at_base;
  }
  ASSERT_GT(at_base, 0u);
  EXPECT_GT(top / double(at_top), 0.5);
  EXPECT_EQ(base, 0.0);
}

TEST(Volumetric, MarksWhatItInvented) {
  ReconstructOptions options = volumetric();
  options.volumetric.mark_invented = true;
  // A ball that floats: from above its underside is not seen.
  const auto floating = [](const Vec3d& o, const Vec3d& d) {
    return to_ball(o, d, kCenter, kRadius);
  };
  const auto result = reconstruct(scan(floating, {}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const ObjectResult& object = result->objects[0];
  ASSERT_EQ(object.mesh.colors.size(), object.mesh.vertices.size());
  double area = 0.0;
  for (const auto& t : object.mesh.triangles) {
    const auto& p = object.mesh.vertices;
    if (std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
          return object.mesh.colors[v] == mesh_refinement::kInventedColor;
        }))
      area += 0.5 * double((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm());
  }
  EXPECT_GT(object.invented_area_m2, 1e-4);
  EXPECT_GE(area, 0.999 * object.invented_area_m2);
  EXPECT_LT(area, 1.3 * object.invented_area_m2);
}

TEST(Volumetric, KeepsAsManyObjectsAsAskedFor) {
  const auto pair = [](const Vec3d& o, const Vec3d& d) {
    return nearer(to_ball(o, d, Vec3d(-0.05, 0.025, 0), 0.025),
                  to_ball(o, d, Vec3d(0.05, 0.02, 0), 0.02));
  };
  ReconstructOptions options = volumetric();
  EXPECT_EQ(reconstruct(scan(pair, {}), options, {}, RunContext())->objects.size(), 2u);
  options.components.keep = "largest";
  const auto one = reconstruct(scan(pair, {}), options, {}, RunContext());
  ASSERT_EQ(one->objects.size(), 1u);
  EXPECT_LT(bounds(one->objects[0].mesh.vertices).center().x(), 0.0);
}

TEST(Volumetric, MakesOneObjectOfWhatLiesCloserThanTheGap) {
  const auto pair = [](const Vec3d& o, const Vec3d& d) {
    return nearer(to_ball(o, d, Vec3d(-0.05, 0.025, 0), 0.025),
                  to_ball(o, d, Vec3d(0.05, 0.02, 0), 0.02));
  };
  ReconstructOptions options = volumetric();
  options.components.gap_m = 0.050;  // they are 55 mm apart
  EXPECT_EQ(reconstruct(scan(pair, {}), options, {}, RunContext())->objects.size(), 2u);
  options.components.gap_m = 0.060;
  const auto one = reconstruct(scan(pair, {}), options, {}, RunContext());
  ASSERT_EQ(one->objects.size(), 1u);
  EXPECT_EQ(one->objects[0].check.components, 2);
  EXPECT_TRUE(one->objects[0].check.watertight());
  for (const std::string& note : one->objects[0].notes)
    EXPECT_EQ(note.find("in the air"), std::string::npos) << note;
}

TEST(Volumetric, RefusesWhatItCannotDo) {
  const auto nothing = [](const Vec3d&, const Vec3d&) { return 0.0; };
  EXPECT_EQ(reconstruct(scan(nothing, {}), volumetric(), {}, RunContext()).error().code,
            ErrorCode::kTooFewPoints);
  RunContext cancelled;
  cancelled.cancel();
  EXPECT_EQ(reconstruct(scan(ball, {}), volumetric(), {}, cancelled).error().code,
            ErrorCode::kCancelled);
}

TEST(Volumetric, FewViewsGetLargerSamplesAndALongerReach) {
  VolumetricInput input;
  input.noise_m = 0.0005, input.spacing_m = 0.0006;
  const Box box{Vec3d::Zero(), Vec3d::Constant(0.12)};
  const auto scale = [&](std::size_t views) {
    input.views.resize(views);
    return choose_scale(input, {}, box).volume;
  };
  const VolumeScale few = scale(8), more = scale(20), many = scale(24);
  EXPECT_GT(few.cell_m, more.cell_m);
  EXPECT_GT(more.cell_m, many.cell_m);
  EXPECT_GT(few.truncation_m, more.truncation_m);
  EXPECT_GT(more.truncation_m, many.truncation_m);
  EXPECT_DOUBLE_EQ(many.cell_m, scale(900).cell_m);
  EXPECT_DOUBLE_EQ(many.truncation_m, 3.0 * input.noise_m);
  input.cell_m = 0.0004;
  EXPECT_DOUBLE_EQ(scale(8).cell_m, 0.0004);
}

TEST(Volumetric, OptionsOutsideTheirRangesAreNamed) {
  for (const char* name : {"truncation", "fit-reach", "fit-iterations"}) {
    VolumetricOptions options;
    const auto wrong = describe(options).set(name, "-1");
    const auto checked = wrong ? describe(options).check() : wrong;
    ASSERT_FALSE(checked) << name;
    EXPECT_THAT(checked.error().message, HasSubstr(name));
  }
}

}  // namespace
}  // namespace turnscan::tsdf
