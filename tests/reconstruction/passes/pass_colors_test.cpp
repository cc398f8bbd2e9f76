#include <gtest/gtest.h>

#include <numbers>
#include <tests/reconstruction/passes/lumpy_object.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/passes/color_match.hpp>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/passes/surface_colors.hpp>
#include "tests/support/sanitizers.hpp"

namespace turnscan::passes {
namespace {

using namespace turnscan::testing;

/// Of a place on the object, as PassSurface::colors.
using ColorOf = std::function<Vec3f(const Vec3d& p_object)>;

/// Patches of a few centimetres, of which no two places have the same surroundings.
Vec3f patches(const Vec3d& p) {
  const double u = std::sin(95.0 * p.x() + 1.0) + std::cos(70.0 * p.z() - 40.0 * p.y());
  const double v = std::cos(80.0 * p.x() + 60.0 * p.y()) - std::sin(110.0 * p.z());
  return Vec3f(u > 0.3 ? 0.0f : -0.4f, v > 0.2 ? 0.5f : 0.0f, u + v > 0.0 ? 0.2f : -0.2f);
}
/// A dark label on one side, small against the whole.
Vec3f label(const Vec3d& p) {
  const bool on = std::abs(p.y()) < 0.02 && p.x() > 0.0 && std::abs(p.z() - 0.01) < 0.02;
  return on ? Vec3f(-1.0f, 0.2f, 0.0f) : Vec3f::Zero();
}
/// Eight stripes alike.
Vec3f stripes(const Vec3d& p) {
  return std::cos(8.0 * std::atan2(p.z(), p.x())) > 0.0 ? Vec3f(-0.6f, 0.2f, 0.0f) : Vec3f::Zero();
}
Vec3f plain(const Vec3d&) { return Vec3f::Zero(); }

Eigen::Matrix3d laid(double tip_deg, double yaw_deg) {
  const double degree = std::numbers::pi / 180.0;
  return (Eigen::AngleAxisd(yaw_deg * degree, Vec3d::UnitY()) *
          Eigen::AngleAxisd(tip_deg * degree, Vec3d::UnitX()))
      .toRotationMatrix();
}

/// Two passes of a coloured object, each with its own light from above, exposure and noise.
struct Painted {
  std::array<Pose, 2> T_table_object;
  std::vector<PassSurface> surfaces;

  Painted(const RadiusOf& radius, const ColorOf& first, const ColorOf& second, double tip_deg) {
    const TriangleMesh object = star_mesh(radius);
    for (std::size_t k = 0; k < 2; ++k) {
      T_table_object[k] = set_down(object, k == 0 ? laid(10, 0) : laid(tip_deg, 65));
      surfaces.push_back(pass_of(object, T_table_object[k], 2e-4, k + 1));
      paint(surfaces[k], T_table_object[k], k == 0 ? first : second, k);
    }
  }
  static void paint(PassSurface& surface, const Pose& T_table_object, const ColorOf& color,
                    std::uint64_t seed) {
    const Pose T_object_table = T_table_object.inverse();
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
      const float up = surface.normals[i].y();
      const auto noise = [&](std::uint64_t c) {
        return 0.03f * float(standard_normal(hash_key(seed, i, c)));
      };
      surface.colors.push_back(color(T_object_table * surface.points[i].cast<double>()) +
                               Vec3f(0.3f * up + 0.1f * up * up + 0.2f * float(seed), 0.02f, 0.0f) +
                               Vec3f(noise(1), noise(2), noise(3)));
    }
  }
  PassMotion joined() const {
    auto motions = join_passes(surfaces, {}, {});
    EXPECT_TRUE(motions.has_value());
    return motions ? (*motions)[1] : PassMotion();
  }
  double error_m(const PassMotion& motion) const {
    const Pose truth = T_table_object[0] * T_table_object[1].inverse();
    double sum = 0.0;
    for (const Vec3f& p : surfaces[1].points)
      sum += (motion.T_first_pass * p.cast<double>() - truth * p.cast<double>()).squaredNorm();
    return std::sqrt(sum / double(surfaces[1].points.size()));
  }
};

TEST(PassColors, TellHowAVaseWithAPatternLay) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Painted vase(vase_radius, patches, patches, 90.0);
  const PassMotion motion = vase.joined();
  EXPECT_TRUE(motion.joined) << motion.reason;
  EXPECT_TRUE(motion.by_colors);
  EXPECT_LT(vase.error_m(motion), 2e-4);
  EXPECT_LT(motion.sigma_m, 4e-4);
}

TEST(PassColors, ALabelOnAVaseIsEnough) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Painted vase(vase_radius, label, label, 90.0);
  const PassMotion motion = vase.joined();
  EXPECT_TRUE(motion.joined) << motion.reason;
  EXPECT_LT(vase.error_m(motion), 4e-4);
}

TEST(PassColors, OfAPlainVaseTellNothingHoweverItIsLit) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const double tip : {90.0, 10.0}) {
    const PassMotion motion = Painted(vase_radius, plain, plain, tip).joined();
    EXPECT_FALSE(motion.joined);
    EXPECT_TRUE(motion.open);
    EXPECT_NE(motion.reason.find("its shape does not determine"), std::string::npos)
        << motion.reason;
  }
}

TEST(PassColors, OfStripesAlikeTellNothing) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const PassMotion motion = Painted(vase_radius, stripes, stripes, 90.0).joined();
  EXPECT_FALSE(motion.joined);
  EXPECT_NE(motion.reason.find("by its colours"), std::string::npos) << motion.reason;
}

TEST(PassColors, OfAnotherVaseAreNotBroughtTogether) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const auto others = [](const Vec3d& p) { return patches({p.z() + 0.3, -p.y(), p.x() + 0.1}); };
  const PassMotion motion = Painted(vase_radius, patches, others, 90.0).joined();
  EXPECT_FALSE(motion.joined);
  EXPECT_NE(motion.reason.find("by its colours"), std::string::npos) << motion.reason;
}

TEST(PassColors, ChangeNothingWhereTheShapeTells) {
  Painted lumpy(lumpy_radius, patches, patches, 90.0);
  const PassMotion with = lumpy.joined();
  for (PassSurface& surface : lumpy.surfaces) surface.colors.clear();
  const PassMotion without = lumpy.joined();
  EXPECT_FALSE(with.by_colors);
  EXPECT_EQ(with.T_first_pass.matrix(), without.T_first_pass.matrix());
}

TEST(ShadingFit, FindsTheLightOfBothTables) {
  std::vector<ShadingFit::Pair> pairs;
  const auto light = [](float a, float b) {
    return Vec3f(0.3f * a - 0.2f * b * b + 0.1f, 0.05f * b, 0.02f);
  };
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto draw = [&](std::uint64_t k) { return float(uniform01(hash_key(9, i, k))); };
    const float a = 2.0f * draw(0) - 1.0f, b = 2.0f * draw(1) - 1.0f;
    // Every tenth lies where the colours have nothing to do with each other.
    const Vec3f color = i % 10 == 0 ? Vec3f(2.0f, -1.0f, 1.0f) : light(a, b);
    pairs.push_back({color, a, b, 1.0f});
  }
  const ShadingFit fit(pairs, 0.3f);
  for (const float a : {-0.8f, 0.0f, 0.9f})
    for (const float b : {-0.7f, 0.5f}) EXPECT_LT((fit.at(a, b) - light(a, b)).norm(), 0.02f);
}

/// Lambert's law with a lamp that stands beside the sensor, and some light from all sides.
float lit(const Vec3f& normal_view) {
  const Vec3f to_lamp = Vec3f(-0.6f, -0.5f, -0.6f).normalized();
  return 0.35f + 0.65f * std::max(0.0f, normal_view.dot(to_lamp));
}

/// What a lamp shows of a ball, grey above some places and dark below.
void light_ball(const Vec3f& center, const ColorOf& albedo, views::DepthView& view) {
  view.colors.assign(view.pixels.size(), Rgb());
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto at = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
      if ((view.pixels[at] & 0xffffu) == 0) continue;
      const float z = float(view.pixels[at] & 0xffffu) * view.unit_m + view.bias_m;
      const Vec3f p((float(x) - view.cx) / view.fx * z, (float(y) - view.cy) / view.fy * z, z);
      const Vec3f p_table = view.rotation.transpose() * (p - view.translation);
      const Vec3f normal = view.rotation * (p_table - center).normalized();
      const float light = std::exp(albedo((p_table - center).cast<double>()).x()) * lit(normal);
      const auto grey = std::uint8_t(std::lround(255.0f * std::pow(light, 1.0f / 2.2f)));
      view.colors[at] = {grey, grey, grey};
    }
  }
}

TEST(SurfaceColors, TheLampsLightIsTakenOut) {
  const TriangleMesh ball = star_mesh(ball_radius);
  PassSurface pass = pass_of(ball, set_down(ball, Eigen::Matrix3d::Identity()), 0.0, 1);
  const Vec3f center(0.004f, 0.06f, -0.007f);
  const auto dark = [](const Vec3d& p) {
    return Vec3f(std::sin(60.0 * p.x()) > 0.0 ? -0.1f : -1.0f, 0.0f, 0.0f);
  };
  std::vector<views::DepthView> views = *pass.views;
  for (views::DepthView& view : views) light_ball(center, dark, view);
  const auto colors = surface_colors(pass, views, {});
  ASSERT_TRUE(colors.has_value());
  ASSERT_EQ(colors->size(), pass.points.size());
  // Of one height, where what is left of the light is alike.
  float sum = 0.0f, count = 0.0f, worst = 0.0f;
  const auto error = [&](std::size_t i) {
    // Three logarithms, halved, over the root of three.
    return (*colors)[i].x() / (0.5f * std::sqrt(3.0f)) -
           dark((pass.points[i] - center).cast<double>()).x();
  };
  const auto counts = [&](std::size_t i) {
    const double wave = std::sin(60.0 * double(pass.points[i].x() - center.x()));
    return std::abs(pass.points[i].y() - 0.075f) < 0.004f && std::abs(wave) > 0.3 &&
           (*colors)[i].allFinite();
  };
  for (std::size_t i = 0; i < colors->size(); ++i)
    if (counts(i)) sum += error(i), count += 1.0f;
  ASSERT_GT(count, 200.0f);
  for (std::size_t i = 0; i < colors->size(); ++i)
    if (counts(i)) worst = std::max(worst, std::abs(error(i) - sum / count));
  EXPECT_LT(worst, 0.2f);  // the lamp alone makes 1.0 of it
}

TEST(SurfaceColors, WithoutColoursThereAreNone) {
  const TriangleMesh ball = star_mesh(ball_radius);
  const PassSurface pass = pass_of(ball, set_down(ball, Eigen::Matrix3d::Identity()), 0.0, 1);
  const auto colors = surface_colors(pass, *pass.views, {});
  ASSERT_TRUE(colors.has_value());
  EXPECT_TRUE(colors->empty());
}

}  // namespace
}  // namespace turnscan::passes
