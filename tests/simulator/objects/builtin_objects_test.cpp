#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/implicit_mesh.hpp>
#include <turnscan/simulator/objects/labelled_cylinder.hpp>

#include "tests/simulator/shapes.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

using test::kPi;

TriangleMesh object(std::string_view name) {
  auto mesh = builtin_object(name);
  EXPECT_TRUE(mesh) << (mesh ? "" : mesh.error().text());
  return mesh ? *mesh : TriangleMesh();
}

void expect_box(const TriangleMesh& mesh, const Vec3d& low, const Vec3d& high, double tolerance) {
  const Box box = bounds(mesh.vertices);
  EXPECT_LE((box.min - low).cwiseAbs().maxCoeff(), tolerance) << box.min.transpose();
  EXPECT_LE((box.max - high).cwiseAbs().maxCoeff(), tolerance) << box.max.transpose();
}

// One test, as the figures take a while to mesh.
TEST(BuiltinObjects, AreClosedTwoManifoldOutwardOnThePlatterWithColoursAndAName) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const std::string& name : builtin_object_names()) {
    const TriangleMesh mesh = object(name);
    EXPECT_TRUE(test::closed_and_oriented(mesh)) << name;
    EXPECT_TRUE(test::one_ring_each(mesh)) << name;
    EXPECT_GT(test::volume_of(mesh), 0.0) << name;
    EXPECT_NEAR(bounds(mesh.vertices).min.y(), 0.0, 1e-6) << name;
    EXPECT_TRUE(mesh.colors.size() == mesh.vertices.size() || has_texture(mesh)) << name;
    EXPECT_EQ(mesh.name, name);
  }
}

TEST(BuiltinObjects, NamesTheKnownOnesWhenAskedForAnother) {
  const auto mesh = builtin_object("teapot");
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kNotFound);
  EXPECT_NE(mesh.error().message.find(
                "letter-a, cylinder, labelled-cylinder, doll, scorpion, skull, action-figure, "
                "robed-figure, ball, ball-bar, plate"),
            std::string::npos);
}

TEST(LetterA, HasTheSizeOfTheWoodenOne) {
  expect_box(object("letter-a"), {-0.087, 0.0, -0.008}, {0.087, 0.194, 0.008}, 1e-7);
}

TEST(LetterA, HasTheVolumeOfItsOutline) {
  // Trapezium less the gap and the counter, in cm.
  const double lean = (8.7 - 1.9) / 19.4, gap_top = 4.9 - lean * 5.0, base = 4.9 - lean * 8.2;
  const double area = (8.7 + 1.9) * 19.4 - (4.9 + gap_top) * 5.0 - base * (4.9 / lean - 8.2);
  EXPECT_NEAR(test::volume_of(object("letter-a")) * 1e6, area * 1.6, 1e-4);
}

TEST(LetterA, HasOneHandle) {
  const TriangleMesh mesh = object("letter-a");
  const auto euler =
      static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2;
  EXPECT_EQ(euler, 0);
}

TEST(Cylinder, HasItsDiameterHeightAndVolume) {
  const TriangleMesh mesh = object("cylinder");
  expect_box(mesh, {-0.04, 0.0, -0.04}, {0.04, 0.16, 0.04}, 1e-7);
  const double n = SolidCylinder::segments;
  const double polygon = 0.5 * n * std::sin(2.0 * kPi / n) * 0.04 * 0.04;
  EXPECT_NEAR(test::volume_of(mesh), polygon * 0.16, 1e-9);
}

TEST(LabelledCylinder, IsTheCylinderWithItsTextReadableFromOutside) {
  const TriangleMesh mesh = object("labelled-cylinder");
  EXPECT_EQ(mesh.vertices, object("cylinder").vertices);
  ASSERT_TRUE(has_texture(mesh));
  /// Grey level at an angle from the front and a height, on the triangle that is there.
  const auto level = [&](double angle, double y) {
    const Vec3f p = Vec3d(0.04 * std::sin(angle), y, 0.04 * std::cos(angle)).cast<float>();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& v = mesh.triangles[t];
      const Vec3f a = mesh.vertices[v[0]], b = mesh.vertices[v[1]] - a, c = mesh.vertices[v[2]] - a;
      const Vec3f n = b.cross(c), d = p - a;
      const float over = 1.0f / n.squaredNorm();
      const float u = d.cross(c).dot(n) * over, w = b.cross(d).dot(n) * over;
      if (std::abs(d.dot(n.normalized())) < 1e-5f && u > -1e-4f && w > -1e-4f && u + w < 1.0001f)
        return texture_at(mesh, t, u, w).mean();
    }
    return -1.0f;
  };
  for (const objects::LabelLine& line : objects::label_lines()) {
    const double dot = line.cap_height_m / objects::kGlyphRows;
    // Its first character, and the last one, dot by dot from the left and from the top.
    for (const std::size_t i : {std::size_t(0), line.text.size() - 1}) {
      const auto glyph = objects::glyph_of(line.text[i]);
      for (int c = 0; c < objects::kGlyphColumns; c += 2)
        for (int r = 0; r < objects::kGlyphRows; r += 3) {
          const double x = (double(i) * objects::kGlyphAdvance + c + 0.5) * dot;
          const double y = line.baseline_m + (objects::kGlyphRows - r - 0.5) * dot;
          const bool inked = (glyph[std::size_t(c)] >> r & 1u) != 0;
          EXPECT_EQ(level(line.angle_rad + x / 0.04, y) < 128.0f, inked)
              << line.text[i] << ' ' << c << ' ' << r;
        }
    }
  }
}

TEST(LabelledCylinder, HasAGlyphForEveryCharacterOfItsText) {
  for (const objects::LabelLine& line : objects::label_lines())
    for (const char character : line.text) {
      const auto glyph = objects::glyph_of(character);
      EXPECT_NE(glyph == decltype(glyph){}, character != ' ') << character;
    }
}

TEST(Gauges, HaveTheirSizes) {
  expect_box(object("ball"), {-0.03, 0.0, -0.03}, {0.03, 0.06, 0.03}, 1e-7);
  expect_box(object("ball-bar"), {-0.095, 0.0, -0.02}, {0.095, 0.04, 0.02}, 1e-7);
  expect_box(object("plate"), {-0.08, 0.0, -0.006}, {0.08, 0.12, 0.006}, 1e-7);
  for (const Vec3f& p : object("ball").vertices)
    ASSERT_NEAR((p - Vec3f(0.0f, 0.03f, 0.0f)).norm(), 0.03, 1e-8);
  // Each vertex of the bar lies on one of its balls.
  for (const Vec3f& p : object("ball-bar").vertices)
    ASSERT_NEAR((p - Vec3f(p.x() < 0.0f ? -0.075f : 0.075f, 0.02f, 0.0f)).norm(), 0.02, 1e-8);
}

TEST(Doll, IsAsTallAsItSays) {
  const Box box = bounds(object("doll").vertices);
  EXPECT_NEAR(box.max.y(), Doll::height_m, 5e-5);
  EXPECT_LT(box.size().x(), 0.16);
  EXPECT_LT(box.size().z(), 0.12);
}

TEST(Doll, HasOneHandleInTheBagsLoop) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const TriangleMesh mesh = object("doll");
  const auto euler =
      static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2;
  EXPECT_EQ(euler, 0);
}

TEST(Doll, HasNoSlivers) {
  const TriangleMesh mesh = object("doll");
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]].cast<double>(), b = mesh.vertices[t[1]].cast<double>(),
                c = mesh.vertices[t[2]].cast<double>();
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    ASSERT_GT((b - a).cross(c - a).norm() / longest, 0.05 * Doll::cell_m);
    ASSERT_LT(longest, 2.0 * Doll::cell_m);
  }
}

TEST(Doll, IsTheSameForEveryNumberOfThreads) {
  set_thread_count(1);
  const TriangleMesh one = object("doll");
  set_thread_count(4);
  const TriangleMesh four = object("doll");
  set_thread_count(0);
  EXPECT_EQ(one.vertices, four.vertices);
  EXPECT_EQ(one.triangles, four.triangles);
  EXPECT_EQ(one.colors, four.colors);
}

long euler_characteristic(const TriangleMesh& mesh) {
  return static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2;
}

TEST(Scorpion, IsOnePieceWithoutHandlesAsTallAsItSays) {
  const TriangleMesh mesh = object("scorpion");
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_NEAR(bounds(mesh.vertices).max.y(), Scorpion::height_m, 5e-4);
}

TEST(Scorpion, StandsOnThinFeetAndHidesItsUnderside) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  std::size_t under = 0;
  for (const Vec3f& p : object("scorpion").vertices) {
    const bool below_body = std::abs(p.x()) < 0.015f && std::abs(p.z()) < 0.04f;
    if (below_body && p.y() < 0.024f) {
      ++under;
      ASSERT_GT(p.y(), 0.999 * Scorpion::body_clearance_m);
    }
    // Nothing but feet reaches the platter.
    if (p.y() < 0.002f) {
      ASSERT_GT(std::abs(p.x()), 0.07f);
    }
  }
  EXPECT_GT(under, 500u);
}

TEST(Skull, HasTwoCheekbonesAndAJawThatStandFree) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const TriangleMesh mesh = object("skull");
  EXPECT_EQ(euler_characteristic(mesh), 2 - 2 * 3);
  EXPECT_NEAR(bounds(mesh.vertices).max.y(), Skull::height_m, 5e-4);
}

TEST(ActionFigure, IsOnePieceWithoutHandlesOnTwoFeetAndAHand) {
  const TriangleMesh mesh = object("action-figure");
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_NEAR(bounds(mesh.vertices).max.y(), ActionFigure::height_m, 5e-4);
  std::array<bool, 3> stands{};
  for (const Vec3f& p : mesh.vertices) {
    if (p.y() > 5e-4f) continue;
    stands[p.z() > 0.04f ? 2 : p.x() > 0.0f ? 1 : 0] = true;
    ASSERT_GT(std::abs(p.x()), 0.02f);
  }
  EXPECT_TRUE(stands[0] && stands[1] && stands[2]);
}

TEST(RobedFigure, HasAHaloThatStandsFreeAboutTheHead) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const TriangleMesh mesh = object("robed-figure");
  EXPECT_EQ(euler_characteristic(mesh), 0);
  EXPECT_NEAR(bounds(mesh.vertices).max.y(), RobedFigure::height_m, 5e-4);
}

TEST(Placing, TurnsCounterClockwiseSeenFromAboveThenMoves) {
  TriangleMesh mesh;
  mesh.vertices = {{0.0f, 1.0f, 1.0f}};
  mesh.normals = {{0.0f, 0.0f, 1.0f}};
  mesh = place(mesh, 10.0, 20.0, kPi / 2);
  EXPECT_LT((mesh.vertices[0] - Vec3f(11, 1, 20)).norm(), 1e-6f);
  EXPECT_LT((mesh.normals[0] - Vec3f(1, 0, 0)).norm(), 1e-6f);
}

TEST(Standing, PutsTheFootOnThePlatterAndScalesToTheHeight) {
  const TriangleMesh mesh =
      stand_on_platter(test::box_mesh({1.0, 2.0, 3.0}, {2.0, 6.0, 5.0}), 0.25);
  expect_box(mesh, {-0.03125, 0.0, -0.0625}, {0.03125, 0.25, 0.0625}, 1e-7);
}

TEST(Standing, LeavesAMeshWithoutVerticesAlone) {
  EXPECT_TRUE(stand_on_platter(TriangleMesh(), 0.25).vertices.empty());
}

// A field of random signs meets every case of the table beside every other.
TEST(ImplicitMesh, IsManifoldForAFieldOfRandomSigns) {
  static constexpr float kCell = 0.001f;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const objects::SignedDistance field = [seed](const Vec3f& p) {
      const Vec3f q = p / kCell;
      float value = 0.0f;
      for (int c = 0; c < 8; ++c) {
        const Vec3f corner(std::floor(q.x()) + (c & 1), std::floor(q.y()) + (c >> 1 & 1),
                           std::floor(q.z()) + (c >> 2));
        const Vec3f w = Vec3f::Ones() - (q - corner).cwiseAbs();
        const bool border = corner.minCoeff() < 1.5f || corner.maxCoeff() > 22.5f;
        const auto key = hash_key(seed, std::uint64_t(corner.x()), std::uint64_t(corner.y()),
                                  std::uint64_t(corner.z()));
        const double at = border ? 1.0 : uniform01(key) - 0.5;
        value += w.x() * w.y() * w.z() * kCell * float(at);
      }
      return value;
    };
    const TriangleMesh mesh =
        *objects::mesh_of(field, {Vec3f::Zero(), Vec3f::Constant(24 * kCell), kCell, 0});
    ASSERT_GT(mesh.triangles.size(), 10000u);
    EXPECT_TRUE(test::closed_and_oriented(mesh)) << seed;
    EXPECT_TRUE(test::one_ring_each(mesh)) << seed;
    EXPECT_GT(test::volume_of(mesh), 0.0) << seed;
  }
}

TEST(ImplicitMesh, HasItsVerticesOnTheSurface) {
  const objects::SignedDistance ball = [](const Vec3f& p) { return p.norm() - 0.02f; };
  const TriangleMesh mesh =
      *objects::mesh_of(ball, {Vec3f::Constant(-0.0253f), Vec3f::Constant(0.025f), 0.001f, 3});
  ASSERT_FALSE(mesh.empty());
  for (const Vec3f& p : mesh.vertices) ASSERT_NEAR(p.norm(), 0.02f, 1e-7f);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    ASSERT_GT(mesh.normals[i].dot(mesh.vertices[i].normalized()), 0.999f);
}

TEST(ImplicitMesh, IsOnTheSurfaceBeforeItIsSmoothed) {
  const objects::SignedDistance ball = [](const Vec3f& p) { return p.norm() - 0.02f; };
  const TriangleMesh mesh =
      *objects::mesh_of(ball, {Vec3f::Constant(-0.0253f), Vec3f::Constant(0.025f), 0.001f, 0});
  // No vertex comes nearer to a corner of the grid than 0.5 % of a cell.
  for (const Vec3f& p : mesh.vertices) ASSERT_NEAR(p.norm(), 0.02f, 6e-6f);
}

}  // namespace
}  // namespace turnscan
