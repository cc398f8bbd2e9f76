#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/turntable/detection/picked_points.hpp>

namespace turnscan {
namespace {

const Vec3d kAxis = Vec3d(0.1, -0.8, -0.5).normalized();
const Vec3d kCenter(0.03, 0.08, 0.9);
constexpr double kRadius = 0.15;

std::vector<Vec3d> rim_points(int n, double noise_m, std::uint64_t seed = 1, double arc = 1.0) {
  const Vec3d u = kAxis.cross(Vec3d::UnitX()).normalized(), v = kAxis.cross(u);
  std::vector<Vec3d> points;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * arc * i / n;
    Vec3d p = kCenter + kRadius * (std::cos(a) * u + std::sin(a) * v);
    for (int k = 0; k < 3; ++k) p[k] += noise_m * standard_normal(hash_key(seed, i, k));
    points.push_back(p);
  }
  return points;
}

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(PickedPoints, OfATrueCircleGiveThatCircle) {
  for (const int n : {3, 4, 12}) {
    const auto fit = fit_picked_points(rim_points(n, 0.0), Vec3d::Zero());
    ASSERT_TRUE(fit) << fit.error().text();
    EXPECT_LT((fit->circle.center - kCenter).norm(), 1e-9);
    EXPECT_LT(angle_between(fit->circle.axis, kAxis), 1e-8);
    EXPECT_NEAR(fit->circle.radius_m, kRadius, 1e-9);
    EXPECT_LT((fit->triples.center - kCenter).norm(), 1e-9);
    EXPECT_NEAR(fit->triples.radius_m, kRadius, 1e-9);
  }
}

TEST(PickedPoints, GiveAnAxisTowardsTheSensorWhateverTheirOrder) {
  auto points = rim_points(5, 0.0);
  for (int i = 0; i < 5; ++i) {
    std::rotate(points.begin(), points.begin() + 1, points.end());
    if (i == 2) std::reverse(points.begin(), points.end());
    EXPECT_GT(fit_picked_points(points, Vec3d::Zero())->circle.axis.dot(kAxis), 0.999);
    EXPECT_LT(fit_picked_points(points, 2.0 * kCenter)->circle.axis.dot(kAxis), -0.999);
  }
}

TEST(PickedPoints, RadiusOfTheThesisIsTheAreaWeightedMeanOfTheTriples) {
  // Equation 3.2 with the weight that it lacks in print, written out.
  const auto points = rim_points(6, 0.004);
  double sum = 0.0, areas = 0.0;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j)
      for (std::size_t k = j + 1; k < 6; ++k) {
        const double a = (points[j] - points[i]).norm(), b = (points[k] - points[j]).norm(),
                     c = (points[i] - points[k]).norm();
        const double area = 0.5 * (points[j] - points[i]).cross(points[k] - points[i]).norm();
        sum += area * (a * b * c / (4.0 * area));
        areas += area;
      }
  EXPECT_NEAR(circle_from_triples(points, Vec3d::Zero())->radius_m, sum / areas, 1e-12);
}

TEST(PickedPoints, LeastSquaresIsNearerToTheTruthThanTheTriplesOverManyTrials) {
  double triples = 0.0, squares = 0.0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto fit = fit_picked_points(rim_points(7, 0.002, seed, 0.8), Vec3d::Zero());
    ASSERT_TRUE(fit);
    triples += (fit->triples.center - kCenter).norm();
    squares += (fit->circle.center - kCenter).norm();
  }
  EXPECT_LT(squares, triples);
}

TEST(PickedPoints, TheirStandardDeviationsAreThoseOfManyTrials) {
  double radius2 = 0.0, center2 = 0.0, claimed_radius2 = 0.0, claimed_center2 = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto fit = fit_picked_points(rim_points(9, 0.001, seed), Vec3d::Zero());
    const Vec3d d = fit->circle.center - kCenter;
    radius2 += std::pow(fit->circle.radius_m - kRadius, 2);
    center2 += (d - d.dot(kAxis) * kAxis).squaredNorm();
    claimed_radius2 += std::pow(fit->radius_sigma_m, 2);
    claimed_center2 += std::pow(fit->center_sigma_m, 2);
  }
  EXPECT_NEAR(std::sqrt(claimed_radius2 / radius2), 1.0, 0.25);
  EXPECT_NEAR(std::sqrt(claimed_center2 / center2), 1.0, 0.25);
}

TEST(CircleError, OfDeviationsOfBothSignsDoesNotCancel) {
  Circle circle{Vec3d::Zero(), Vec3d::UnitY(), 1.0};
  const std::vector<Vec3d> points{{1.1, 0, 0}, {0, 0, 0.9}};
  EXPECT_NEAR(circle_error(points, circle).mean_abs_m, 0.1, 1e-12);
  EXPECT_NEAR(circle_error(points, circle).rms_m, 0.1, 1e-12);
}

TEST(PickedPoints, AreRefusedByName) {
  const auto message = [](std::vector<Vec3d> points) {
    const auto fit = fit_picked_points(points, Vec3d::Zero());
    return fit ? std::string() : fit.error().message;
  };
  EXPECT_NE(message(rim_points(2, 0.0)).find("2 are given"), std::string::npos);
  auto same = rim_points(5, 0.0);
  same[3] = same[1];
  EXPECT_NE(message(same).find("points 2 and 4 are the same"), std::string::npos);
  auto broken = rim_points(5, 0.0);
  broken[2].y() = std::nan("");
  EXPECT_NE(message(broken).find("point 3 is not finite"), std::string::npos);
  std::vector<Vec3d> line;
  for (int i = 0; i < 4; ++i) line.emplace_back(0.1 * i, 0.2 * i, 1.0 + 0.05 * i);
  EXPECT_NE(message(line).find("one line"), std::string::npos);
  EXPECT_FALSE(message(std::vector<Vec3d>(301, Vec3d::Zero())).empty());
}

TEST(PickedPoints, WithThreeOfThemHaveNoErrorFigure) {
  const auto calibration = calibrate_from_points(rim_points(3, 0.001), Vec3d::Zero());
  ASSERT_TRUE(calibration);
  EXPECT_TRUE(std::isnan(calibration->radius_sigma_m));
  EXPECT_NEAR(calibration->residual_rms_m, 0.0, 1e-9);
}

}  // namespace
}  // namespace turnscan
