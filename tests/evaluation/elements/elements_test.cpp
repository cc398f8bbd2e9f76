#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/evaluation/elements/elements.hpp>
#include <turnscan/evaluation/elements/fit.hpp>
#include <turnscan/evaluation/evaluate.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using elements::Kind;
using elements::Shape;
using testing::HasSubstr;

/// The mesh of a map of the unit square, n x n squares; u wraps around if `around`.
TriangleMesh mapped(int n, bool around, const std::function<Vec3d(double, double)>& map) {
  TriangleMesh mesh;
  const auto columns = std::uint32_t(around ? n : n + 1), m = std::uint32_t(n);
  for (std::uint32_t v = 0; v <= m; ++v)
    for (std::uint32_t u = 0; u < columns; ++u)
      mesh.vertices.push_back(map(double(u) / n, double(v) / n).cast<float>());
  const auto at = [&](std::uint32_t u, std::uint32_t v) { return v * columns + u % columns; };
  for (std::uint32_t v = 0; v < m; ++v)
    for (std::uint32_t u = 0; u < m; ++u) {
      mesh.triangles.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1)});
      mesh.triangles.push_back({at(u, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  return mesh;
}

Shape shape(Kind kind, const Vec3d& point, const Vec3d& direction = Vec3d::UnitZ(),
            double radius = 0.0, double half_angle = 0.0) {
  Shape out;
  out.kind = kind;
  out.point = point;
  out.direction = out.section_normal = direction.normalized();
  out.radius_m = radius;
  out.half_angle_rad = half_angle;
  return out;
}

/// A shape, and a mesh whose vertices (or edges' crossings) lie on it.
struct Sample {
  Shape shape;
  TriangleMesh mesh;
};

Vec3d around(double u, double radius, double z) {
  return {radius * std::cos(kTurn * u), radius * std::sin(kTurn * u), z};
}

std::vector<Sample> samples() {
  std::vector<Sample> out;
  out.push_back({shape(Kind::kSphere, {0.01, 0.0, 0.0}, Vec3d::UnitZ(), 0.02),
                 test::sphere(0.02, 5, {0.01, 0.0, 0.0})});
  out.push_back({shape(Kind::kPlane, {0.0, 0.0, 0.01}), mapped(40, false, [](double u, double v) {
                   return Vec3d(0.05 * u, 0.04 * v, 0.01);
                 })});
  const TriangleMesh cylinder =
      mapped(60, true, [](double u, double v) { return around(u, 0.015, 0.01 + 0.03 * v); });
  out.push_back({shape(Kind::kCylinder, Vec3d::Zero(), Vec3d::UnitZ(), 0.015), cylinder});
  const double half = 20.0 * kRadiansPerDegree;
  out.push_back({shape(Kind::kCone, {0.0, 0.0, -0.01}, Vec3d::UnitZ(), 0.0, half),
                 mapped(60, true, [half](double u, double v) {
                   const double along = 0.01 + 0.04 * v;
                   return around(u, along * std::tan(half), along - 0.01);
                 })});
  // Through a row of vertices, so that its points lie on the circle and not on chords.
  out.push_back({shape(Kind::kCircle, {0.0, 0.0, 0.025}, Vec3d::UnitZ(), 0.015), cylinder});
  Shape line = shape(Kind::kLine, {0.0, 0.02, 0.01}, Vec3d::UnitX());
  line.section_normal = Vec3d::UnitY();
  out.push_back({line, out[1].mesh});
  return out;
}

/// The request for a shape that is known roughly: 0.3 mm, 0.3 deg, 1 %.
ElementRequest request(const Shape& true_shape, double within_m = 2e-3) {
  ElementRequest out;
  out.name = "it";
  out.nominal = true_shape;
  out.within_m = within_m;
  if (!elements::is_section(true_shape.kind)) {
    out.nominal.point += Vec3d(1e-4, -2e-4, 2e-4);
    out.nominal.direction = (out.nominal.direction + Vec3d(4e-3, -3e-3, 2e-3)).normalized();
    out.nominal.half_angle_rad *= 1.01;
  }
  out.nominal.radius_m *= 1.01;
  return out;
}

ElementReport measured(const TriangleMesh& mesh, const ElementPlan& plan) {
  const auto report = measure_elements(mesh, plan, RunContext());
  if (report) return *report;
  ADD_FAILURE() << report.error().text();
  return {};
}

const ElementFigure& figure(const MeasuredElement& element, const std::string& name) {
  for (const ElementFigure& f : element.figures)
    if (f.name == name) return f;
  throw std::out_of_range(name);
}

std::string error_of(const TriangleMesh& mesh, const ElementPlan& plan) {
  const auto report = measure_elements(mesh, plan, RunContext());
  return report ? "" : report.error().text();
}

TEST(Elements, TheFitOfExactPointsReturnsTheShape) {
  for (const Sample& s : samples()) {
    const MeasuredElement e = measured(s.mesh, {{request(s.shape)}, {}, {}}).elements.at(0);
    SCOPED_TRACE(elements::name_of(s.shape.kind));
    EXPECT_GE(e.points, 41u);
    EXPECT_LT(e.form_m, 1e-7);
    EXPECT_LT(e.rms_m, 1e-8);
    const Vec3d p(figure(e, "x").value, figure(e, "y").value, figure(e, "z").value);
    EXPECT_LT(std::abs(elements::distance(s.shape, p) +
                       (elements::has_radius(s.shape.kind) ? s.shape.radius_m : 0.0)),
              1e-7);
    for (const ElementFigure& f : e.figures) {
      if (f.name == "diameter") {
        EXPECT_NEAR(f.value, 2 * s.shape.radius_m, 1e-7);
      }
      if (f.name == "angle") {
        EXPECT_NEAR(f.value, 2 * s.shape.half_angle_rad, 1e-5);
      }
      if (f.name == "direction z") {
        EXPECT_NEAR(f.value, s.shape.direction.z(), 1e-6);
      }
    }
  }
}

TEST(Elements, TheDerivativesOfADistanceAreThoseOfItsDifferences) {
  for (const Sample& s : samples()) {
    SCOPED_TRACE(elements::name_of(s.shape.kind));
    const Vec3d p = s.mesh.vertices[33].cast<double>() + Vec3d(2e-4, 1e-4, -3e-4);
    const elements::Changes ways = elements::freedoms(s.shape, 0.02);
    for (int i = 0; i < elements::freedoms_of(s.shape.kind); ++i) {
      ASSERT_GT(ways.col(i).norm(), 0.5);
      const elements::Change small = 1e-7 * ways.col(i);
      const double difference = (elements::distance(elements::changed(s.shape, small), p) -
                                 elements::distance(elements::changed(s.shape, -small), p)) /
                                2e-7;
      EXPECT_NEAR(difference, ways.col(i).dot(elements::gradient(s.shape, p)), 1e-5);
    }
  }
}

TEST(Elements, FitsDoNotChangeUnderRigidMotion) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.7, Vec3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  pose.translation() = Vec3d(0.03, -0.05, 0.1);
  for (const Sample& s : samples()) {
    SCOPED_TRACE(elements::name_of(s.shape.kind));
    TriangleMesh rough = s.mesh;
    for (std::size_t i = 0; i < rough.vertices.size(); ++i)
      for (int k = 0; k < 3; ++k)
        rough.vertices[i][k] += float(1e-5 * standard_normal(hash_key(3, i, std::uint64_t(k))));
    ElementRequest here = request(s.shape), there = here;
    there.nominal = elements::transformed(here.nominal, pose);
    const auto a = measured(rough, {{here}, {}, {}}).elements.at(0);
    const auto b = measured(transformed(rough, pose), {{there}, {}, {}}).elements.at(0);
    EXPECT_EQ(a.points, b.points);
    EXPECT_NEAR(a.form_m, b.form_m, 1e-7);
    const auto place = [](const MeasuredElement& e) {
      return Vec3d(figure(e, "x").value, figure(e, "y").value, figure(e, "z").value);
    };
    EXPECT_LT((pose * place(a) - place(b)).norm(), 2e-7);
    for (const char* name : {"diameter", "angle"})
      for (std::size_t i = 0; i < a.figures.size(); ++i)
        if (a.figures[i].name == name) {
          EXPECT_NEAR(a.figures[i].value, b.figures[i].value, 1e-6);
          EXPECT_NEAR(*a.figures[i].sigma, *b.figures[i].sigma, 0.05 * *a.figures[i].sigma);
        }
  }
}

/// Errors of vertices along the normal, 20 um, each the mean of those within `reach` of it.
std::vector<double> errors_of(const TriangleMesh& mesh, double reach, std::uint64_t seed) {
  std::vector<double> out(mesh.vertices.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t j = 0; j < out.size(); ++j) {
      if (j != i && !((mesh.vertices[i] - mesh.vertices[j]).norm() < reach)) continue;
      sum += standard_normal(hash_key(seed, j, 9));
      ++count;
    }
    out[i] = 2e-5 * sum / std::sqrt(double(count));
  }
  return out;
}

/// rms of (found - true) / sigma of a sphere's centre, radius on 60 simulated scans.
double normalised_error(double reach) {
  const TriangleMesh exact = test::sphere(0.02, 4);
  double squares = 0.0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    TriangleMesh mesh = exact;
    const std::vector<double> errors = errors_of(exact, reach, seed);
    for (std::size_t i = 0; i < errors.size(); ++i)
      mesh.vertices[i] *= float(1.0 + errors[i] / 0.02);
    const auto e =
        measured(mesh,
                 {{request(shape(Kind::kSphere, Vec3d::Zero(), Vec3d::UnitZ(), 0.02))}, {}, {}})
            .elements.at(0);
    for (const ElementFigure& f : e.figures) {
      const double error = f.value - (f.name == "diameter" ? 0.04 : 0.0);
      squares += error * error / (*f.sigma * *f.sigma);
      ++count;
    }
  }
  return std::sqrt(squares / count);
}

// 240 figures: the rms is known to 5 %, if these were independent and sigma exact.
TEST(Elements, SigmaIsThatOfSimulatedScans) { EXPECT_NEAR(normalised_error(0.0), 1.0, 0.15); }

TEST(Elements, SigmaIsThatOfSimulatedScansWhoseNeighboursShareTheirErrors) {
  // Each error reaches 3 mm; as if they were independent, sigma would be 4 times too small.
  EXPECT_NEAR(normalised_error(3e-3), 1.0, 0.15);
}

TEST(Elements, OfFewPointsSigmaIsNotKnown) {
  const TriangleMesh few = test::sphere(0.02, 1);
  const auto e =
      measured(few, {{request(shape(Kind::kSphere, Vec3d::Zero(), Vec3d::UnitZ(), 0.02))}, {}, {}});
  EXPECT_EQ(e.elements.at(0).points, 18u);
  EXPECT_FALSE(figure(e.elements[0], "diameter").sigma);
}

/// A box, 1 high, with 20 x 20 squares on each side: planes bottom, left, front.
ElementPlan box_plan() {
  ElementPlan plan;
  const auto add = [&](const char* name, const Vec3d& point, const Vec3d& normal) {
    ElementRequest r;
    r.name = name;
    r.nominal = shape(Kind::kPlane, point, normal);
    r.within_m = 0.02;
    plan.elements.push_back(r);
  };
  add("bottom", {0.5, 0.5, 0.0}, {0.0, 0.0, -1.0});
  add("left", {0.0, 0.5, 0.5}, {-1.0, 0.0, 0.0});
  add("top", {0.5, 0.5, 1.0}, {0.0, 0.0, 1.0});
  add("front", {0.5, 0.0, 0.5}, {0.0, -1.0, 0.0});
  return plan;
}

TriangleMesh box() { return test::subdivided(test::cube(), 5); }

TEST(Elements, RelationsAreThoseOfTheShapes) {
  ElementPlan plan = box_plan();
  ElementRequest edge, corner;
  edge.name = "edge";
  edge.of = {0, 1};
  corner.name = "corner";
  corner.of = {4, 3};
  plan.elements.insert(plan.elements.end(), {edge, corner});
  plan.relations = {{"height", false, {0, 2}},
                    {"square", true, {0, 1}},
                    {"level", true, {0, 4}},
                    {"up", false, {5, 2}},
                    {"parallel", true, {0, 2}}};
  const ElementReport report = measured(box(), plan);
  EXPECT_EQ(report.elements[4].kind, Kind::kLine);
  EXPECT_EQ(report.elements[5].kind, Kind::kPoint);
  EXPECT_NEAR(std::abs(figure(report.elements[4], "direction y").value), 1.0, 1e-9);
  for (const char* axis : {"x", "y", "z"})
    EXPECT_NEAR(figure(report.elements[5], axis).value, 0.0, 1e-7);
  const std::vector<double> values{1.0, kTurn / 4, 0.0, 1.0, 0.0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(report.relations[i].figure.value, values[i], 1e-7) << i;
    EXPECT_NEAR(report.relations[i].figure.nominal, values[i], 1e-12) << i;
  }
}

TEST(Elements, ADatumFrameIsThatOfPlaneLineAndPoint) {
  ElementPlan plan = box_plan();
  plan.datum = {0, 1, 3};
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(0.4, Vec3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  pose.translation() = Vec3d(0.3, 0.1, -0.2);
  for (ElementRequest& e : plan.elements) e.nominal = elements::transformed(e.nominal, pose);
  const ElementReport report = measured(transformed(box(), pose), plan);
  ASSERT_TRUE(report.T_datum_mesh);
  // z points down out of the bottom; the trace of the left side is x.
  const Vec3d corner = *report.T_datum_mesh * (pose * Vec3d::Zero());
  EXPECT_LT(corner.norm(), 1e-6);
  EXPECT_NEAR((*report.T_datum_mesh * (pose * Vec3d(0, 0, 1))).z(), -1.0, 1e-6);
  EXPECT_NEAR(std::abs((*report.T_datum_mesh * (pose * Vec3d(0, 1, 0))).x()), 1.0, 1e-6);
  EXPECT_NEAR(figure(report.elements[2], "z").value, -1.0, 1e-6);
  EXPECT_NEAR(figure(report.elements[2], "z").deviation(), 0.0, 1e-6);
}

TEST(Elements, OneBetweenParallelPlanesHasTheSigmaOfBoth) {
  ElementPlan plan = box_plan();
  TriangleMesh mesh = box();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i].z() += float(1e-3 * standard_normal(hash_key(4, i, 1)));
  plan.relations = {{"height", false, {2, 0}}};
  const ElementReport report = measured(mesh, plan);
  const double own = *figure(report.elements[2], "z").sigma;
  EXPECT_NEAR(own, 1e-3 / std::sqrt(double(report.elements[2].points)), 0.4 * own);
  EXPECT_NEAR(*report.relations[0].figure.sigma,
              std::hypot(own, *figure(report.elements[0], "z").sigma), 0.1 * own);
}

TEST(Elements, PointsOutsideTheRegionAreNotTaken) {
  ElementPlan plan = box_plan();
  plan.elements[2].low_m = Vec3d(0.2, 0.3, -1.0);
  plan.elements[2].high_m = Vec3d(0.8, 0.9, 2.0);
  const auto all = measured(box(), box_plan()).elements[2].points;
  EXPECT_NEAR(double(measured(box(), plan).elements[2].points) / double(all), 0.36, 0.03);
}

TEST(Elements, WhatCannotBeMeasuredIsAnErrorThatNamesTheElement) {
  ElementPlan plan = box_plan();
  plan.elements[2].nominal.point.z() = 1.5;
  EXPECT_THAT(error_of(box(), plan), HasSubstr("element 'top': the 0 points within 20 mm"));
  plan = box_plan();
  plan.elements[2].low_m = Vec3d(0.0, 0.49, 0.0);  // one row of vertices, which lie on a line
  plan.elements[2].high_m = Vec3d(1.0, 0.51, 2.0);
  EXPECT_THAT(error_of(box(), plan), HasSubstr("element 'top': the 31 points"));
  plan = box_plan();
  ElementRequest edge;
  edge.name = "edge";
  edge.of = {0, 2};
  plan.elements.push_back(edge);
  EXPECT_THAT(error_of(box(), plan), HasSubstr("'edge': 'bottom' and 'top' do not cross"));
  plan = box_plan();
  plan.datum = {0, 2, 1};
  EXPECT_THAT(error_of(box(), plan), HasSubstr("datum: 'top' cannot be its line"));
  plan = box_plan();
  plan.elements[1].nominal = shape(Kind::kSphere, {0.5, 0.5, 0.5}, Vec3d::UnitZ(), 0.5);
  plan.elements[1].within_m = 0.05;
  plan.relations = {{"turn", true, {0, 1}}};
  EXPECT_THAT(error_of(box(), plan),
              HasSubstr("'turn': 'left' is a sphere, which has no direction"));
}

}  // namespace
}  // namespace turnscan
