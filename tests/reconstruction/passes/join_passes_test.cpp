#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <set>
#include <tests/reconstruction/passes/lumpy_object.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/passes/joint_adjustment.hpp>
#include <turnscan/reconstruction/passes/object_assignment.hpp>
#include "tests/support/sanitizers.hpp"

namespace turnscan::passes {
namespace {

using namespace turnscan::testing;

Eigen::Matrix3d tipped(double tip_deg, double yaw_deg) {
  const double degree = std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(yaw_deg * degree, Vec3d::UnitY()) *
          Eigen::AngleAxisd(tip_deg * degree, Vec3d::UnitX()))
      .toRotationMatrix();
}

/// An object in several poses.
struct Scene {
  std::vector<Pose> T_table_object;
  std::vector<PassSurface> surfaces;

  Scene(const RadiusOf& radius, const std::vector<Eigen::Matrix3d>& rotations,
        double noise_m = 2e-4) {
    const TriangleMesh object = star_mesh(radius);
    for (std::size_t k = 0; k < rotations.size(); ++k) {
      T_table_object.push_back(set_down(object, rotations[k]));
      surfaces.push_back(pass_of(object, T_table_object.back(), noise_m, k + 1));
    }
  }
  double error_m(const PassMotion& motion, std::size_t k) const {
    const Pose truth = T_table_object[0] * T_table_object[k].inverse();
    double sum = 0.0;
    for (const Vec3f& p : surfaces[k].points)
      sum += (motion.T_first_pass * p.cast<double>() - truth * p.cast<double>()).squaredNorm();
    return std::sqrt(sum / double(surfaces[k].points.size()));
  }
};

std::vector<PassMotion> join(const std::vector<PassSurface>& surfaces) {
  auto motions = join_passes(surfaces, {}, {});
  EXPECT_TRUE(motions.has_value());
  return motions ? *motions : std::vector<PassMotion>(surfaces.size());
}

TEST(JoinPasses, TheMotionOfALumpyObjectIsFoundHoweverItWasTipped) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const auto& [tip, yaw] : {std::pair(90.0, 70.0), {180.0, 200.0}}) {
    const Scene scene(lumpy_radius, {tipped(0, 0), tipped(tip, yaw)});
    const auto motions = join(scene.surfaces);
    EXPECT_TRUE(motions[1].joined) << motions[1].reason;
    EXPECT_LT(scene.error_m(motions[1], 1), 5e-5);
    EXPECT_LT(motions[1].sigma_m, 1e-4);
    EXPECT_GT(motions[1].overlap_m2, 0.005);
  }
}

TEST(JoinPasses, ABallIsNotJoined) {
  const Scene scene(ball_radius, {tipped(0, 0), tipped(90, 30)});
  const auto motions = join(scene.surfaces);
  EXPECT_FALSE(motions[1].joined);
  EXPECT_NE(motions[1].reason.find("any turn about the axis"), std::string::npos)
      << motions[1].reason;
}

TEST(JoinPasses, AVaseIsNotJoinedAndItsAxisIsNamed) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Scene scene(vase_radius, {tipped(90, 0), tipped(0, 30)});
  const auto motions = join(scene.surfaces);
  EXPECT_FALSE(motions[1].joined);
  const std::string& reason = motions[1].reason;
  const auto axis = reason.find("any turn about the axis (");
  ASSERT_NE(axis, std::string::npos) << reason;
  // Lying, its axis is z: the third component is nearly 1.
  EXPECT_NE(reason.find("00)", axis), std::string::npos) << reason;
}

TEST(JoinPasses, AVaseWithAKnobIsJoinedThoughMostOfItIsRound) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const auto with_knob = [](const Vec3d& d) {
    const double beside = (d - Vec3d(0.8, 0.6, 0.0)).squaredNorm();
    return vase_radius(d) + 0.02 * std::exp(-beside / 0.05);
  };
  const Scene scene(with_knob, {tipped(0, 0), tipped(90, 30)});
  const auto motions = join(scene.surfaces);
  EXPECT_TRUE(motions[1].joined) << motions[1].reason;
  EXPECT_LT(scene.error_m(motions[1], 1), 1e-4);
}

TEST(JoinPasses, WhatIsAlikeFromBehindIsNotJoinedWhereItOverlapsMost) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  // Half a turn about x leaves it as it is. Tipped by 75 degrees it overlaps most where it lies,
  // tipped by 105 degrees where it does not.
  const auto alike = [](const Vec3d& d) {
    const double square = d.y() * d.y(), mixed = d.y() * d.z();
    return 0.06 + 0.012 * std::sin(3.1 * d.x() + 1.0) +
           0.01 * std::cos(4.3 * square - 2.0 * mixed) +
           0.006 * std::sin(7.0 * mixed + 3.0 * d.x());
  };
  for (const double tip : {75.0, 105.0}) {
    const Scene scene(alike, {tipped(0, 0), tipped(tip, 40)});
    const auto motions = join(scene.surfaces);
    EXPECT_FALSE(motions[1].joined) << tip << ": " << scene.error_m(motions[1], 1);
    EXPECT_NE(motions[1].reason.find("turned by 180 deg"), std::string::npos) << motions[1].reason;
  }
}

TEST(JoinPasses, DifferentObjectsAreNotJoined) {
  const Scene one(lumpy_radius, {tipped(0, 0)});
  const Scene other(
      [](const Vec3d& d) {
        return 1.3 * lumpy_radius({d.z(), -d.x(), d.y() + 0.3});
      },
      {tipped(60, 20)});
  const auto motions = join({one.surfaces[0], other.surfaces[0]});
  EXPECT_FALSE(motions[1].joined);
  EXPECT_NE(motions[1].reason.find("different objects"), std::string::npos) << motions[1].reason;
}

TEST(JoinPasses, ThreePassesAgreeWithEachOther) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Scene scene(lumpy_radius, {tipped(0, 0), tipped(90, 50), tipped(180, 10)});
  const auto motions = join(scene.surfaces);
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_TRUE(motions[k].joined) << motions[k].reason;
    EXPECT_LT(scene.error_m(motions[k], k), 5e-5);
  }
}

TEST(JoinPasses, APassThatDoesNotFitIsLeftBesideTheOthers) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  Scene scene(lumpy_radius, {tipped(0, 0), tipped(90, 50)});
  const Scene other(
      [](const Vec3d& d) {
        return 1.3 * lumpy_radius({d.z(), -d.x(), d.y() + 0.3});
      },
      {tipped(60, 20)});
  scene.surfaces.insert(scene.surfaces.begin() + 1, other.surfaces[0]);
  const auto motions = join(scene.surfaces);
  EXPECT_TRUE(motions[0].joined);
  EXPECT_FALSE(motions[1].joined);
  EXPECT_TRUE(motions[2].joined) << motions[2].reason;
}

/// Other shapes than the lumpy one.
double other_radius(const Vec3d& d) { return 1.3 * lumpy_radius({d.z(), -d.x(), d.y() + 0.3}); }
double third_radius(const Vec3d& d) {
  return 0.055 + 0.012 * std::sin(3.7 * d.z() + 0.4) + 0.01 * std::cos(5.1 * d.x() + 2.0 * d.y());
}

/// Which parts each object has, as "PASS.OBJECT" in order.
std::vector<std::string> parts_of(const std::vector<std::vector<ObjectPart>>& objects) {
  std::vector<std::string> out;
  for (const auto& parts : objects) {
    std::string& text = out.emplace_back();
    for (const ObjectPart& part : parts) text += fmt::format("{}.{} ", part.pass, part.object);
  }
  return out;
}

TEST(JoinObjects, EachFindsItsPartnerWhateverPlacesTheyHave) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Scene one(lumpy_radius, {tipped(0, 0), tipped(90, 70)});
  const Scene two(other_radius, {tipped(0, 0), tipped(180, 30)});
  const Scene three(third_radius, {tipped(0, 0)});
  // The third is not there in the second pass.
  const std::vector<std::vector<PassSurface>> passes{
      {two.surfaces[0], one.surfaces[0], three.surfaces[0]}, {one.surfaces[1], two.surfaces[1]}};
  const auto objects = join_objects(passes, {}, {});
  ASSERT_TRUE(objects.has_value());
  EXPECT_EQ(parts_of(*objects), (std::vector<std::string>{"0.0 1.1 ", "0.1 1.0 ", "0.2 "}));
  EXPECT_LT(two.error_m((*objects)[0][1].motion, 1), 5e-5);
  EXPECT_LT(one.error_m((*objects)[1][1].motion, 1), 5e-5);
  EXPECT_FALSE((*objects)[0][1].motion.interchangeable);
  EXPECT_FALSE((*objects)[2][0].motion.joined);
  EXPECT_NE((*objects)[2][0].motion.reason, "");
}

TEST(JoinObjects, OfTwoOfTheSameShapeEitherIsRightAndSaysSo) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Scene twins(lumpy_radius, {tipped(0, 0), tipped(0, 120), tipped(90, 70), tipped(80, 10)});
  const auto objects =
      join_objects(std::vector<std::vector<PassSurface>>{{twins.surfaces[0], twins.surfaces[1]},
                                                         {twins.surfaces[2], twins.surfaces[3]}},
                   {}, {});
  ASSERT_TRUE(objects.has_value());
  ASSERT_EQ(objects->size(), 2u);
  for (const auto& parts : *objects) {
    ASSERT_EQ(parts.size(), 2u) << parts[0].motion.reason;
    EXPECT_TRUE(parts[1].motion.interchangeable);
  }
}

TEST(JoinObjects, WhatTwoFitThatDifferElsewhereIsNotGuessed) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  // Alike above, where the second pass sees one of them; not below.
  const auto flattened = [](const Vec3d& d) {
    return lumpy_radius(d) * (d.y() < -0.3 ? 1.0 + 0.25 * (d.y() + 0.3) : 1.0);
  };
  const Scene whole(lumpy_radius, {tipped(90, 0), tipped(20, 60)});
  const Scene flat(flattened, {tipped(90, 0)});
  PassSurface upper = whole.surfaces[1];
  const Pose T = whole.T_table_object[1].inverse();
  PassSurface kept = upper;
  kept.points.clear(), kept.normals.clear(), kept.areas.clear(), kept.weights.clear();
  for (std::size_t i = 0; i < upper.points.size(); ++i) {
    if ((T * upper.points[i].cast<double>()).y() < 0.0) continue;
    kept.points.push_back(upper.points[i]);
    kept.normals.push_back(upper.normals[i]);
    kept.areas.push_back(upper.areas[i]);
    kept.weights.push_back(upper.weights[i]);
  }
  kept.views.reset();
  const auto objects = join_objects(
      std::vector<std::vector<PassSurface>>{{whole.surfaces[0], flat.surfaces[0]}, {kept}}, {}, {});
  ASSERT_TRUE(objects.has_value());
  EXPECT_EQ(parts_of(*objects), (std::vector<std::string>{"0.0 ", "0.1 ", "1.0 "}));
  EXPECT_NE((*objects)[2][0].motion.reason.find("alike"), std::string::npos)
      << (*objects)[2][0].motion.reason;
}

TEST(AssignObjects, TheSumOfTheEvidenceIsTheLargest) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto draw = [&](std::uint64_t k) { return uniform01(hash_key(seed, k)); };
    const auto rows = std::size_t(1 + 4 * draw(100)), columns = std::size_t(1 + 4 * draw(101));
    EvidenceTable table(rows, std::vector<double>(columns));
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c) table[r][c] = draw(10 * r + c) - 0.3;
    std::vector<std::size_t> order(std::max(rows, columns));
    std::iota(order.begin(), order.end(), std::size_t(0));
    double most = 0.0;
    do {
      double sum = 0.0;
      for (std::size_t r = 0; r < rows; ++r)
        if (order[r] < columns) sum += std::max(0.0, table[r][order[r]]);
      most = std::max(most, sum);
    } while (std::next_permutation(order.begin(), order.end()));
    const Assignment found = assign_objects(table);
    EXPECT_NEAR(found.evidence, most, 1e-12);
    std::set<std::size_t> used;
    for (const auto& column : found.column_of) {
      if (column) {
        EXPECT_TRUE(used.insert(*column).second);
      }
    }
  }
}

/// Square of the error over what the covariance states, 6 on average.
double normalised_error(const Pose& truth, const Adjustment& adjusted) {
  const Pose error = adjusted.T_first_pass[1] * truth.inverse();
  const Eigen::AngleAxisd turn(error.linear());
  Eigen::Matrix<double, 6, 1> x;
  x << turn.angle() * turn.axis(), error * adjusted.center - adjusted.center;
  return x.dot(adjusted.covariances[1].inverse() * x);
}

/// Errors that neighbours share, as those of a fitted mesh: waves of 20 mm in random directions.
double wavy_error(const Vec3f& p, std::uint64_t seed) {
  constexpr std::uint64_t kWaves = 30;
  double sum = 0.0;
  for (std::uint64_t w = 0; w < kWaves; ++w) {
    const auto draw = [&](std::uint64_t k) { return standard_normal(hash_key(seed, w, k)); };
    const Vec3d direction = Vec3d(draw(0), draw(1), draw(2)).normalized();
    sum +=
        std::cos(2.0 * std::numbers::pi / 0.02 * direction.dot(p.cast<double>()) + 9.0 * draw(3));
  }
  return 2e-4 * std::sqrt(2.0 / double(kWaves)) * sum;
}

TEST(JoinPasses, StatedDeviationsAreThoseOfRepeatedScans) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Scene scene(lumpy_radius, {tipped(0, 0), tipped(90, 50)}, 0.0);
  const Pose truth = scene.T_table_object[0] * scene.T_table_object[1].inverse();
  double sum = 0.0;
  constexpr std::uint64_t kScans = 12;
  for (std::uint64_t i = 0; i < kScans; ++i) {
    std::vector<PassSurface> noisy = scene.surfaces;
    for (std::size_t k = 0; k < 2; ++k) {
      noisy[k].views.reset();
      for (std::size_t v = 0; v < noisy[k].points.size(); ++v)
        noisy[k].points[v] +=
            float(wavy_error(noisy[k].points[v], 2 * i + k)) * noisy[k].normals[v];
    }
    const PreparedPass a(noisy[0]), b(noisy[1]);
    const std::array<const PreparedPass*, 2> both{&a, &b};
    const PassPair pair{0, 1};
    const auto adjusted = adjust(both, {&pair, 1}, {Pose::Identity(), truth}, 0.006, {}, {});
    ASSERT_TRUE(adjusted.has_value());
    sum += normalised_error(truth, *adjusted);
  }
  EXPECT_GT(sum / double(kScans), 3.0);
  EXPECT_LT(sum / double(kScans), 12.0);
}

TEST(JoinPasses, WhatASensorFiltersIsLessCertain) {
  Scene scene(lumpy_radius, {tipped(0, 0), tipped(90, 70)});
  for (PassSurface& surface : scene.surfaces) surface.spacing_m = 0.004;
  const PassMotion sharp = join(scene.surfaces)[1];
  for (PassSurface& surface : scene.surfaces) surface.filtered = true;
  const PassMotion filtered = join(scene.surfaces)[1];
  ASSERT_TRUE(sharp.joined && filtered.joined);
  EXPECT_GT(filtered.sigma_m, 1.5 * sharp.sigma_m);
  EXPECT_GT(filtered.sigma_rad, 1.5 * sharp.sigma_rad);
  EXPECT_LT((filtered.T_first_pass.matrix() - sharp.T_first_pass.matrix()).norm(), 1e-12);
}

TEST(JoinPasses, TheBytesDoNotDependOnTheNumberOfThreads) {
  const Scene scene(lumpy_radius, {tipped(0, 0), tipped(120, 50)});
  set_thread_count(1);
  const auto one = join(scene.surfaces);
  set_thread_count(0);
  const auto all = join(scene.surfaces);
  EXPECT_EQ(one[1].T_first_pass.matrix(), all[1].T_first_pass.matrix());
  EXPECT_EQ(one[1].covariance, all[1].covariance);
}

TEST(JoinPasses, OnePassOrOneWithoutPointsIsRefused) {
  const Scene scene(lumpy_radius, {tipped(0, 0)});
  EXPECT_EQ(join_passes(scene.surfaces, {}, {}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(join_passes(std::vector{scene.surfaces[0], PassSurface()}, {}, {}).error().code,
            ErrorCode::kTooFewPoints);
}

TEST(JoinPasses, ACancelledJoinHasNoResult) {
  const Scene scene(lumpy_radius, {tipped(0, 0), tipped(90, 0)});
  const RunContext context;
  context.cancel();
  EXPECT_EQ(join_passes(scene.surfaces, {}, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::passes
