#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <tests/support/memory_sequence.hpp>
#include <thread>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/reconstruction/method.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/report.hpp>

namespace turnscan {
namespace {

using ::testing::HasSubstr;
using turnscan::testing::MemorySequence;

constexpr double kRadius = 0.03;

/// Range scans of balls on a platter (touching it at y = 0), one every 30 degrees, each of what a
/// far sensor on the side of -Z sees, with noise along its ray.
MemorySequence balls(const std::vector<Vec3d>& centers, double sigma_m, int points = 3000) {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.kind = SensorKind::kPointScanner;
  sensor.T_table_sensor = Pose::Identity();
  sensor.viewpoint = {Vec3d(0, 0.7, -0.9), false};
  sequence.header_value.sensors = {sensor};
  TurntableInfo table;
  table.radius_m = 0.2;
  sequence.header_value.turntable = table;
  for (std::uint32_t f = 0; f < 12; ++f) {
    Frame frame;
    frame.info.index = f;
    frame.info.angle_rad = f * std::numbers::pi / 6.0;
    const Pose turn = rotation_about_y(*frame.info.angle_rad);
    for (std::uint64_t i = 0; i < std::uint64_t(points); ++i) {
      const double z = 2 * uniform01(hash_key(f, i, 0)) - 1, r = std::sqrt(1 - z * z);
      const double a = 2 * std::numbers::pi * uniform01(hash_key(f, i, 1));
      const Vec3d n(r * std::cos(a), z, r * std::sin(a));
      const Vec3d p = turn * centers[i % centers.size()] + kRadius * n;
      const Vec3d towards = sensor.viewpoint.direction_from(p);
      if (n.dot(towards) < 0.25 || p.y() < 0.0005) continue;
      frame.points.points.push_back(
          (p + sigma_m * standard_normal(hash_key(f, i, 2)) * towards).cast<float>());
      frame.points.colors.push_back({200, 40, 10});
    }
    sequence.add(std::move(frame));
  }
  return sequence;
}

MemorySequence one_ball(double sigma_m = 0.0003) { return balls({Vec3d(0, kRadius, 0)}, sigma_m); }

ReconstructOptions coarse() {
  ReconstructOptions options;
  options.surface.method = SurfaceMethod::kPoisson;
  options.surface.poisson_depth = 6;
  return options;
}

double mean_radius_error(const TriangleMesh& mesh, const Vec3d& center) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const Vec3f& v : mesh.vertices) {
    if (v.y() < 0.015f) continue;  // the base is flat and the lowest part is not seen
    sum += std::abs((v.cast<double>() - center).norm() - kRadius);
    ++n;
  }
  return sum / double(n);
}

TEST(Reconstruct, GivesAWatertightMeshCloseToTheObjectWithoutOptions) {
  const auto result = reconstruct(one_ball(), {}, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  const ObjectResult& ball = result->objects[0];
  EXPECT_TRUE(ball.check.watertight()) << ball.check.text();
  EXPECT_LT(mean_radius_error(ball.mesh, Vec3d(0, kRadius, 0)), 0.0005);  // points are 1 mm apart
}

TEST(Reconstruct, StandsTheObjectOnThePlatter) {
  const auto result = reconstruct(one_ball(), coarse(), {}, RunContext());
  ASSERT_TRUE(result);
  const Box box = bounds(result->objects[0].mesh.vertices);
  EXPECT_NEAR(box.min.y(), 0.0, 0.0015);
  EXPECT_NEAR(box.max.y(), 2 * kRadius, 0.001);
}

TEST(Reconstruct, PartsTwoObjectsAndNumbersThem) {
  const auto result =
      reconstruct(balls({Vec3d(-0.05, kRadius, 0), Vec3d(0.05, kRadius, 0)}, 0.0003, 6000),
                  coarse(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 2u);
  EXPECT_NE(result->objects[0].mesh.name, result->objects[1].mesh.name);
  for (const ObjectResult& o : result->objects) EXPECT_TRUE(o.check.watertight());
}

TEST(Reconstruct, KeepLargestLeavesOneObject) {
  ReconstructOptions options = coarse();
  options.components.keep = "largest";
  const auto result =
      reconstruct(balls({Vec3d(-0.05, kRadius, 0), Vec3d(0.05, kRadius, 0)}, 0.0003, 6000), options,
                  {}, RunContext());
  ASSERT_TRUE(result);
  EXPECT_EQ(result->objects.size(), 1u);
}

TEST(Reconstruct, BothCandidateMethodsAndBothSurfaceMethodsGiveWatertightMeshes) {
  for (const auto candidates : {CandidateMethod::kCentroid, CandidateMethod::kSubVoxel}) {
    for (const auto method : {SurfaceMethod::kPoisson, SurfaceMethod::kConcaveHull}) {
      ReconstructOptions options = coarse();
      options.candidates.method = candidates;
      options.surface.method = method;
      options.finish.triangles = "all";
      const auto result = reconstruct(one_ball(), options, {}, RunContext());
      ASSERT_TRUE(result) << result.error().text();
      EXPECT_TRUE(result->objects.at(0).check.watertight());
      EXPECT_LT(mean_radius_error(result->objects[0].mesh, Vec3d(0, kRadius, 0)), 0.001);
    }
  }
}

TEST(Reconstruct, CarriesColourWhenAskedTo) {
  ReconstructOptions options = coarse();
  options.color = true;
  const auto result = reconstruct(one_ball(), options, {}, RunContext());
  ASSERT_TRUE(result);
  const TriangleMesh& mesh = result->objects[0].mesh;
  ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.colors[0], (Rgb{200, 40, 10}));
  EXPECT_TRUE(reconstruct(one_ball(), coarse(), {}, RunContext())->objects[0].mesh.colors.empty());
}

TEST(Reconstruct, GivesTheSameBytesForOneAndTwoThreads) {
  set_thread_count(1);
  const auto one = reconstruct(one_ball(), coarse(), {}, RunContext());
  set_thread_count(2);
  const auto two = reconstruct(one_ball(), coarse(), {}, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->objects[0].mesh.vertices, two->objects[0].mesh.vertices);
  EXPECT_EQ(one->objects[0].mesh.triangles, two->objects[0].mesh.triangles);
}

TEST(Reconstruct, GivesItsStagesToTheSink) {
  ReconstructOptions points = coarse();
  points.keep_points = true;
  points.candidates.method = CandidateMethod::kSubVoxel;
  for (const ReconstructOptions& options : {points, ReconstructOptions()}) {
    std::vector<std::string> seen;
    const auto sink = [&](const std::string& stage, const PointCloud& cloud) -> Result<> {
      EXPECT_FALSE(cloud.empty());
      seen.push_back(stage);
      return {};
    };
    ASSERT_TRUE(reconstruct(one_ball(), options, sink, RunContext()));
    EXPECT_EQ(seen, saveable_stages(options.surface.method));
  }
}

TEST(Reconstruct, AGridInTheBoundsOfThePointsBeginsAtTheirCorner) {
  ReconstructOptions options = coarse();
  options.voxels.grid = 20;
  options.voxels.in_bounds = true;
  options.keep_points = true;
  std::map<std::string, PointCloud> saved;
  const auto sink = [&](const std::string& stage, const PointCloud& cloud) -> Result<> {
    saved[stage] = cloud;
    return {};
  };
  ASSERT_TRUE(reconstruct(one_ball(), options, sink, RunContext()));
  const Box box = bounds(saved["merged"].points);
  const double size = box.size().maxCoeff() / 20;
  for (const Vec3f& p : saved["voxels"].points) {
    const Vec3d place = ((p.cast<double>() - box.min) / size).array() - 0.5;
    ASSERT_LT((place.array() - place.array().round()).abs().maxCoeff(), 1e-3);
    ASSERT_GE(place.minCoeff(), -1e-3);
  }
}

TEST(Reconstruct, WithoutAGapOnlyVoxelsThatTouchAreOneObject) {
  const auto sequence =
      balls({Vec3d(0, kRadius, 0), Vec3d(0, 3 * kRadius + 0.012, 0)}, 0.0003, 6000);
  ReconstructOptions options = coarse();
  const auto joined = reconstruct(sequence, options, {}, RunContext());
  ASSERT_TRUE(joined) << joined.error().text();
  EXPECT_EQ(joined->objects.size(), 1u);  // what floats belongs to what stands
  options.components.gap_m = 0.0;
  const auto parted = reconstruct(sequence, options, {}, RunContext());
  ASSERT_TRUE(parted) << parted.error().text();
  EXPECT_EQ(parted->objects.size(), 2u);
}

TEST(Reconstruct, FailsWhenTheSinkFails) {
  const auto sink = [](const std::string&, const PointCloud&) -> Result<> {
    return fail(ErrorCode::kIo, "no space");
  };
  const auto result = reconstruct(one_ball(), coarse(), sink, RunContext());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kIo);
}

TEST(Reconstruct, SaysWhereThePointsWentWhenNothingIsLeft) {
  ReconstructOptions options;
  options.crop.radius_m = 0.001;
  const auto cropped = reconstruct(one_ball(), options, {}, RunContext());
  ASSERT_FALSE(cropped);
  EXPECT_EQ(cropped.error().code, ErrorCode::kTooFewPoints);
  EXPECT_THAT(cropped.error().message, HasSubstr("crop"));
  options = coarse();
  options.voxels.min_points = 100000000;
  const auto counted = reconstruct(one_ball(), options, {}, RunContext());
  ASSERT_FALSE(counted);
  EXPECT_THAT(counted.error().message, HasSubstr("voxel-min-points"));
}

TEST(Reconstruct, RefusesAVoxelSizeAndAGridTogether) {
  ReconstructOptions options;
  options.voxels.size_m = 0.001;
  options.voxels.grid = 150;
  EXPECT_EQ(reconstruct(one_ball(), options, {}, RunContext()).error().code,
            ErrorCode::kInvalidOption);
}

TEST(Reconstruct, GivesNothingOnceCancelled) {
  const RunContext context;
  context.cancel();
  EXPECT_EQ(reconstruct(one_ball(), coarse(), {}, context).error().code, ErrorCode::kCancelled);
}

TEST(Reconstruct, StopsSoonWhenCancelledDuringTheSurface) {
  RunContext context;
  context.set_listener([&context](const Progress& p) {
    if (p.phase == "surface") context.cancel();
  });
  ReconstructOptions options;
  options.surface.method = SurfaceMethod::kPoisson;
  EXPECT_EQ(reconstruct(one_ball(), options, {}, context).error().code, ErrorCode::kCancelled);
}

TEST(Reconstruct, LeavesOutFramesThatWereDropped) {
  MemorySequence sequence = one_ball();
  sequence.infos[3].status = FrameStatus::kDropped;
  const auto result = reconstruct(sequence, coarse(), {}, RunContext());
  ASSERT_TRUE(result);
  EXPECT_EQ(result->frames, 11u);
  EXPECT_EQ(result->dropped_frames, 1u);
}

TEST(Report, NamesEveryChoiceWithItsReasonAndChecksTheMesh) {
  const auto result = reconstruct(one_ball(), coarse(), {}, RunContext());
  ASSERT_TRUE(result);
  const auto report = nlohmann::json::parse(report_json(*result, coarse()));
  EXPECT_EQ(report["frames"], 12);
  EXPECT_TRUE(report["objects"][0]["mesh"]["watertight"]);
  EXPECT_GT(report["peak_memory_mb"], 1.0);
  std::set<std::string> names;
  for (const auto& parameter : report["parameters"]) {
    names.insert(parameter["option"].get<std::string>());
    EXPECT_FALSE(parameter["reason"].get<std::string>().empty());
  }
  for (const char* name : {"voxel-size", "voxel-min-points", "normal-radius", "refine-radius"})
    EXPECT_TRUE(names.count(name)) << name;
  EXPECT_EQ(report["options"]["surface"]["poisson-depth"], "6");
}

TEST(ReconstructOptions, ThatTheMethodDoesNotUseAreNamed) {
  ReconstructOptions options = coarse();
  EXPECT_TRUE(unused_options(options).empty());
  options.volumetric.fit = false;
  options.surface.alpha_m = 0.01;
  EXPECT_EQ(unused_options(options), (std::vector<std::string>{"alpha", "fit"}));
  const auto result = reconstruct(one_ball(), options, {}, RunContext());
  ASSERT_TRUE(result);
  EXPECT_THAT(result->notes, ::testing::Contains(HasSubstr("option alpha")));
  options.surface.method = SurfaceMethod::kVolumetric;
  options.outliers.neighbours = 20;
  EXPECT_EQ(unused_options(options),
            (std::vector<std::string>{"outlier-k", "poisson-depth", "alpha"}));
}

TEST(ReconstructOptions, AreEachUsedByAMethodAndNamedByNoneThatHasThemNot) {
  ReconstructOptions options;
  std::set<std::string> stages, names, used;
  for (const OptionGroup& stage : describe_stages(options)) {
    stages.insert(stage.name);
    for (const OptionField& field : stage.table.fields()) names.insert(field.name);
  }
  for (const MethodEntry& method : methods()) {
    for (const std::string& stage : method.option_stages) EXPECT_TRUE(stages.count(stage)) << stage;
    for (const std::string& name : method.options) EXPECT_TRUE(names.count(name)) << name;
    for (const OptionGroup& stage : describe_stages(options)) {
      const auto& whole = method.option_stages;
      const bool all = std::find(whole.begin(), whole.end(), stage.name) != whole.end();
      for (const OptionField& field : stage.table.fields())
        if (all) used.insert(field.name);
    }
    used.insert(method.options.begin(), method.options.end());
  }
  EXPECT_EQ(used, names);
}

TEST(ReconstructOptions, HaveUniqueNamesThatReadBackTheirOwnValues) {
  ReconstructOptions options;
  const OptionTable table = describe(options);
  std::set<std::string> names;
  for (const OptionField& field : table.fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_TRUE(field.set(field.get())) << field.name << " = " << field.get();
    EXPECT_FALSE(field.help.empty());
  }
  EXPECT_EQ(options.outliers.neighbours, 10);
  EXPECT_EQ(options.surface.poisson_depth, 8);
}

}  // namespace
}  // namespace turnscan
