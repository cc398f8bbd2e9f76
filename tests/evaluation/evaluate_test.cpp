#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/evaluation/evaluate.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

const EvaluateOptions kFew = {.thresholds = "0.4mm,0.6mm", .samples = 20000};

Evaluation compare(const TriangleMesh& mesh, const TriangleMesh& reference,
                   const EvaluateOptions& options = kFew, const SeenTest& seen = {}) {
  const auto result = evaluate(mesh, reference, options, seen, RunContext());
  if (!result) {
    ADD_FAILURE() << result.error().text();
    return {};
  }
  return *result;
}

/// Only what lies above the plane z = 0 was seen.
Result<std::vector<std::uint8_t>> upper_half(std::span<const Vec3f> points,
                                             std::span<const Vec3f> normals) {
  EXPECT_EQ(points.size(), normals.size());
  std::vector<std::uint8_t> seen;
  for (const Vec3f& p : points) seen.push_back(p.z() > 0.0f);
  return seen;
}

TEST(Evaluate, ConcentricSpheresAreHalfAMillimetreApart) {
  // The facets of the larger sphere lie up to 2 um inside it.
  const Evaluation e = compare(sphere(0.0105, 6), sphere(0.010, 6));
  EXPECT_NEAR(e.accuracy.mean, 0.5e-3, 3e-6);
  EXPECT_NEAR(e.accuracy.median, 0.5e-3, 3e-6);
  EXPECT_NEAR(e.accuracy.p95, 0.5e-3, 3e-6);
  EXPECT_NEAR(e.accuracy.max, 0.5e-3, 5e-6);
  EXPECT_NEAR(e.accuracy.rms, 0.5e-3, 3e-6);
  EXPECT_NEAR(e.completeness.mean, 0.5e-3, 3e-6);
  EXPECT_NEAR(e.bias_m, 0.5e-3, 3e-6) << "the mesh lies outside";
  EXPECT_EQ(e.accuracy.count, 20000u);
  ASSERT_EQ(e.scores.size(), 2u);
  EXPECT_EQ(e.scores[0].precision, 0.0);
  EXPECT_EQ(e.scores[0].f, 0.0);
  EXPECT_EQ(e.scores[1].precision, 1.0);
  EXPECT_EQ(e.scores[1].recall, 1.0);
  EXPECT_EQ(e.scores[1].f, 1.0);
  EXPECT_NEAR(e.mesh_area_m2, 4.0 * std::numbers::pi * 0.0105 * 0.0105, 1e-6);
  EXPECT_EQ(e.invented_area_m2, 0.0);
  EXPECT_EQ(e.invented.count, 0u);
  EXPECT_DOUBLE_EQ(e.seen_area_m2, e.reference_area_m2);
}

TEST(Evaluate, ASmallerSphereHasANegativeBias) {
  EXPECT_NEAR(compare(sphere(0.0095, 6), sphere(0.010, 6)).bias_m, -0.5e-3, 3e-6);
}

TEST(Evaluate, ShiftedPlanesAreTheirShiftApart) {
  const Evaluation e = compare(plane(10, 1.0, 0.0005), plane(7));
  EXPECT_NEAR(e.accuracy.mean, 0.5e-3, 1e-9);
  EXPECT_NEAR(e.accuracy.max, 0.5e-3, 1e-9);
  EXPECT_NEAR(e.completeness.max, 0.5e-3, 1e-9);
  EXPECT_NEAR(e.bias_m, 0.5e-3, 1e-9);
}

TEST(Evaluate, HalfAPlaneIsPreciseButHalfComplete) {
  TriangleMesh half = plane(8);
  std::erase_if(half.triangles, [&](const auto& t) {
    return std::max({half.vertices[t[0]].x(), half.vertices[t[1]].x(), half.vertices[t[2]].x()}) >
           0.5f;
  });
  const Evaluation e = compare(half, plane(8));
  EXPECT_EQ(e.scores[0].precision, 1.0);
  EXPECT_NEAR(e.scores[0].recall, 0.5, 0.005);
  EXPECT_NEAR(e.scores[0].f, 2.0 * 0.5 / 1.5, 0.005);
  EXPECT_NEAR(e.completeness.max, 0.5, 0.001);
  EXPECT_NEAR(e.completeness.mean, 0.125, 0.001);
  EXPECT_NEAR(e.completeness.p95, 0.45, 0.005);
}

TEST(Evaluate, AHalfSeenSphereIsJudgedByTheSeenHalf) {
  // The mesh is right above and 2 mm too large below, where nothing was seen.
  TriangleMesh mesh = sphere(0.010, 6);
  for (Vec3f& v : mesh.vertices) {
    if (v.z() < 0.0f) v *= 1.2f;
  }
  const Evaluation e = compare(mesh, sphere(0.010, 6), kFew, upper_half);
  EXPECT_LT(e.accuracy.p95, 5e-6);
  EXPECT_GT(e.scores[0].precision, 0.98);
  EXPECT_GT(e.scores[0].recall, 0.98);
  EXPECT_NEAR(e.completeness.count, 10000.0, 100.0);
  EXPECT_NEAR(e.seen_area_m2, 2.0 * std::numbers::pi * 1e-4, 1e-5);
  const double half = 2.0 * std::numbers::pi * 1.44e-4, rim = std::numbers::pi * 0.44e-4;
  EXPECT_NEAR(e.invented_area_m2, half + rim, 3e-5) << "the lower half, and the step to it";
  EXPECT_NEAR(e.invented.median, 2e-3, 1e-5);
  EXPECT_NEAR(e.invented.mean, (2e-3 * half + 1e-3 * rim) / (half + rim), 2e-5);
  EXPECT_NEAR(e.invented.p95, 2e-3, 1e-5);
  const Evaluation all = compare(mesh, sphere(0.010, 6));
  EXPECT_LT(all.scores[0].precision, 0.45);
  EXPECT_EQ(all.accuracy.count, e.accuracy.count + e.invented.count);
}

TEST(Evaluate, WhatClosesAHoleOfTheReferenceCanBeLeftOut) {
  // A sphere without its cap, beside the whole one 0.1 mm larger.
  TriangleMesh reference = sphere(0.05, 5);
  std::erase_if(reference.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return reference.vertices[v].y() > 0.035f; });
  });
  const TriangleMesh mesh = sphere(0.0501, 5);
  EvaluateOptions options;
  options.samples = 20000;
  const auto counted = evaluate(mesh, reference, options, {}, RunContext());
  options.border = Border::kLeaveOut;
  const auto left_out = evaluate(mesh, reference, options, {}, RunContext());
  ASSERT_TRUE(counted && left_out);
  EXPECT_GT(counted->accuracy.max, 0.01);
  EXPECT_EQ(counted->invented.count, 0u);
  EXPECT_LT(left_out->accuracy.max, 0.0003);
  // Its cap: 2 pi r h of 4 pi r^2.
  EXPECT_NEAR(left_out->invented_area_m2 / left_out->mesh_area_m2, 0.15, 0.02);
  EXPECT_EQ(left_out->completeness.max, counted->completeness.max);
  // A closed reference has no border.
  const auto closed = evaluate(mesh, sphere(0.05, 5), options, {}, RunContext());
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->invented.count, 0u);
}

TEST(Evaluate, AlignmentUndoesARigidMotion) {
  TriangleMesh reference = sphere(0.1, 5);
  for (Vec3f& v : reference.vertices) v *= 1.0f + 20.0f * v.x() * v.y() + 2.0f * v.z();
  const Pose T = Eigen::Translation3d(0.003, 0.001, -0.002) *
                 Eigen::AngleAxisd(0.03, Vec3d(1, 1, 0).normalized());
  const TriangleMesh moved = transformed(reference, T.inverse());
  EXPECT_GT(compare(moved, reference).accuracy.median, 1e-3);
  EvaluateOptions options = kFew;
  options.align = Align::kIcp;
  const Evaluation e = compare(moved, reference, options);
  EXPECT_TRUE(e.aligned);
  EXPECT_LT(e.accuracy.p95, 1e-5);
  EXPECT_TRUE(e.T_reference_mesh.isApprox(T, 1e-3));
  options.icp.max_iterations = 1;
  EXPECT_THAT(evaluate(moved, reference, options, {}, RunContext()).error().message,
              testing::HasSubstr("not converged"));
}

TEST(Evaluate, StatisticsAreByNearestRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const ErrorStatistics s = error_statistics(values);
  EXPECT_EQ(s.count, 100u);
  EXPECT_EQ(s.mean, 50.5);
  EXPECT_EQ(s.median, 50.0);
  EXPECT_EQ(s.p95, 95.0);
  EXPECT_EQ(s.max, 100.0);
  EXPECT_NEAR(s.rms, std::sqrt(3383.5), 1e-12);
  EXPECT_EQ(error_statistics({3.0}).median, 3.0);
  EXPECT_EQ(error_statistics({}).count, 0u);
}

TEST(Evaluate, DeviationsAreNegativeInsideTheReference) {
  // The upper half 0.5 mm too large, the lower half 0.3 mm too small.
  TriangleMesh mesh = sphere(0.010, 6);
  for (Vec3f& v : mesh.vertices) v *= v.z() > 0.0f ? 1.05f : 0.97f;
  EvaluateOptions options = kFew;
  options.tolerance_m = 0.4e-3;
  const Evaluation e = compare(mesh, sphere(0.010, 6), options);
  EXPECT_NEAR(e.deviation.high, 0.5e-3, 5e-6);
  EXPECT_NEAR(e.deviation.low, -0.3e-3, 5e-6);
  EXPECT_NEAR(e.deviation.max, 0.5e-3, 5e-6);
  EXPECT_NEAR(e.deviation.min, -0.3e-3, 5e-6);
  EXPECT_EQ(e.deviation.count, 20000u);
  ASSERT_TRUE(e.tolerance);
  const double upper = 1.05 * 1.05, lower = 0.97 * 0.97;
  EXPECT_NEAR(e.tolerance->above, upper / (upper + lower), 0.03) << "less the step between them";
  EXPECT_EQ(e.tolerance->below, 0.0);
  EXPECT_NEAR(e.tolerance->in + e.tolerance->above + e.tolerance->below, 1.0, 1e-12);
  options.tolerance_m = 0.2e-3;
  EXPECT_GT(compare(mesh, sphere(0.010, 6), options).tolerance->below, 0.4);
  EXPECT_FALSE(compare(mesh, sphere(0.010, 6)).tolerance);
  options.tolerance_m = 0.0;
  EXPECT_EQ(evaluate(mesh, mesh, options, {}, RunContext()).error().code,
            ErrorCode::kInvalidOption);
}

TEST(Evaluate, DeviationStatisticsAreSignedAndByNearestRank) {
  std::vector<double> values;
  for (int i = 1; i <= 200; ++i) values.push_back(i - 100);
  const DeviationStatistics s = deviation_statistics(values);
  EXPECT_EQ(s.count, 200u);
  EXPECT_DOUBLE_EQ(s.mean, 0.5);
  EXPECT_NEAR(s.sigma, std::sqrt((200.0 * 200.0 - 1.0) / 12.0), 1e-9);
  EXPECT_EQ(s.low, -95.0);
  EXPECT_EQ(s.high, 95.0);
  EXPECT_EQ(s.min, -99.0);
  EXPECT_EQ(s.max, 100.0);
  EXPECT_EQ(deviation_statistics({}).count, 0u);
}

TEST(Evaluate, ThresholdsAreLengthsWithUnits) {
  EXPECT_EQ(*parse_thresholds("1mm,0.5mm,1cm"), (std::vector<double>{0.0005, 0.001, 0.01}));
  for (const char* text : {"", "1", "1mm,", "0mm", "-1mm", "1mm,,2mm", "nanmm", "1deg"}) {
    EXPECT_FALSE(parse_thresholds(text)) << text;
  }
}

TEST(Evaluate, IsTheSameForOneAndTwoThreads) {
  const TriangleMesh mesh = sphere(0.0102, 5), reference = torus(0.008, 0.003, 50, 30);
  set_thread_count(1);
  const auto one = evaluate(mesh, reference, kFew, upper_half, RunContext());
  set_thread_count(2);
  const auto two = evaluate(mesh, reference, kFew, upper_half, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(to_json(*one), to_json(*two));
}

TEST(Evaluate, FailsByNameAndSaysWhichMesh) {
  const RunContext context;
  const TriangleMesh good = sphere(0.01, 2);
  TriangleMesh nan = good, index = good;
  nan.vertices[5].x() = std::numeric_limits<float>::quiet_NaN();
  index.triangles[5][0] = 100000;
  const auto error = [&](const TriangleMesh& mesh, const TriangleMesh& reference,
                         const EvaluateOptions& options = kFew, const SeenTest& seen = {}) {
    const auto result = evaluate(mesh, reference, options, seen, context);
    return result ? Error{ErrorCode::kLibrary, "success", ""} : result.error();
  };
  EXPECT_EQ(error(TriangleMesh(), good).code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(error(good, TriangleMesh()).code, ErrorCode::kTooFewPoints);
  for (const TriangleMesh& bad : {nan, index}) {
    EXPECT_EQ(error(bad, good).code, ErrorCode::kFormat);
    EXPECT_THAT(error(bad, good).message, testing::StartsWith("mesh: "));
    EXPECT_THAT(error(good, bad).message, testing::StartsWith("reference: "));
    EXPECT_EQ(color_by_error(good, bad, 1.0, context).error().code, ErrorCode::kFormat);
  }
  EXPECT_EQ(error(good, good, {.samples = 0}).code, ErrorCode::kInvalidOption);
  EXPECT_EQ(error(good, good, {.thresholds = "x"}).code, ErrorCode::kInvalidOption);
  const SeenTest nothing = [](auto points, auto) -> Result<std::vector<std::uint8_t>> {
    return std::vector<std::uint8_t>(points.size(), 0);
  };
  EXPECT_EQ(error(good, good, kFew, nothing).code, ErrorCode::kTooFewPoints);
  const SeenTest broken = [](auto, auto) -> Result<std::vector<std::uint8_t>> {
    return fail(ErrorCode::kMissingData, "no poses");
  };
  EXPECT_EQ(error(good, good, kFew, broken).code, ErrorCode::kMissingData);
  context.cancel();
  EXPECT_EQ(error(good, good).code, ErrorCode::kCancelled);
  EXPECT_EQ(color_by_error(good, good, 1.0, context).error().code, ErrorCode::kCancelled);
}

TEST(Evaluate, StopsWhenCancelledInAnyPhase) {
  const TriangleMesh mesh = sphere(0.01, 4);
  for (const std::string phase : {"sample", "accuracy", "completeness", "seen"}) {
    RunContext context;
    context.set_listener([&](const Progress& progress) {
      if (progress.phase == phase) context.cancel();
    });
    EXPECT_EQ(evaluate(mesh, mesh, kFew, upper_half, context).error().code, ErrorCode::kCancelled)
        << phase;
  }
}

TEST(EvaluateJson, HasTheKeysOfThePage) {
  EvaluateOptions options = kFew;
  auto json = nlohmann::json::parse(to_json(compare(sphere(0.0105, 4), sphere(0.010, 4), options)));
  for (const char* part : {"accuracy", "completeness", "invented"}) {
    for (const char* key : {"samples", "mean_m", "median_m", "p95_m", "max_m", "rms_m"}) {
      EXPECT_TRUE(json[part][key].is_number()) << part << "." << key;
    }
  }
  for (const char* key : {"samples", "mean_m", "sigma_m", "p2_5_m", "p97_5_m", "min_m", "max_m"}) {
    EXPECT_TRUE(json["deviation"][key].is_number()) << key;
  }
  EXPECT_TRUE(json["tolerance"].is_null());
  for (const char* key : {"bias_m", "mesh_area_m2", "reference_area_m2", "seen_area_m2"}) {
    EXPECT_TRUE(json[key].is_number()) << key;
  }
  EXPECT_TRUE(json["invented"]["area_m2"].is_number());
  EXPECT_EQ(json["scores"].size(), 2u);
  EXPECT_DOUBLE_EQ(json["scores"][1]["threshold_m"].get<double>(), 0.0006);
  EXPECT_EQ(json["scores"][1]["f"].get<double>(), 1.0);
  EXPECT_TRUE(json["alignment"].is_null());
  Evaluation aligned;
  aligned.aligned = true;
  aligned.tolerance = ToleranceShares{0.0002, 0.75, 0.25, 0.0};
  json = nlohmann::json::parse(to_json(aligned));
  EXPECT_EQ(json["alignment"]["T_reference_mesh"][3][3].get<double>(), 1.0);
  EXPECT_EQ(json["tolerance"]["in"].get<double>(), 0.75);
}

TEST(ColorByError, GoesFromVioletToYellow) {
  TriangleMesh mesh = plane(2);
  mesh.vertices[0].z() = 0.001f * 4.0f / 9.0f;
  mesh.vertices[1].z() = 0.001f;
  mesh.vertices[2].z() = 1.0f;
  const auto colored = color_by_error(mesh, plane(2), 0.001, RunContext());
  ASSERT_TRUE(colored);
  EXPECT_EQ(colored->colors[0], (Rgb{38, 130, 142})) << "the fifth of ten colours";
  EXPECT_EQ(colored->colors[1], (Rgb{253, 231, 37}));
  EXPECT_EQ(colored->colors[2], (Rgb{253, 231, 37})) << "beyond the largest error";
  EXPECT_EQ(colored->colors[3], (Rgb{68, 1, 84}));
  EXPECT_EQ(colored->triangles, mesh.triangles);
  EXPECT_EQ(color_by_error(mesh, plane(2), 0.0, RunContext()).error().code,
            ErrorCode::kInvalidOption);
  EXPECT_EQ(color_by_error(mesh, TriangleMesh(), 1.0, RunContext()).error().code,
            ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace turnscan
