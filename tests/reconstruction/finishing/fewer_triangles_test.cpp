#include <gtest/gtest.h>

#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/reconstruction/finishing/fewer_triangles.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using finishing::reduce_triangles;

constexpr float kBallRadius = 0.05f;
constexpr double kVoxel_m = 0.001;

/// A ball that is expected to be 0.4 mm off, three times that on its left half, and whose cap
/// nothing measured.
ObjectResult known_ball() {
  ObjectResult out;
  out.mesh = test::sphere(kBallRadius, 6);
  std::vector<std::uint8_t> unseen(out.mesh.vertices.size(), 0);
  for (const auto& triangle : out.mesh.triangles) {
    const bool invented = out.mesh.vertices[triangle[0]].y() > 0.8f * kBallRadius;
    out.evidence.push_back(invented ? Evidence::kInvented : Evidence::kMeasured);
    if (invented)
      for (const std::uint32_t v : triangle) unseen[v] = 1;
  }
  for (std::size_t v = 0; v < unseen.size(); ++v) {
    const Vec3f& p = out.mesh.vertices[v];
    out.confidence.push_back(unseen[v] ? 0.0f : 1.0f);
    const float measured = p.x() < 0.0f ? 0.0012f : 0.0004f;
    out.quality.push_back({unseen[v] ? 0.02f : measured, std::uint16_t(unseen[v] ? 0 : 40), 6});
  }
  out.check = check_mesh(out.mesh);
  return out;
}

Reconstruction made_of(ObjectResult object) {
  Reconstruction out;
  out.voxel_size_m = kVoxel_m;
  out.objects.push_back(std::move(object));
  return out;
}

double rms_distance(const TriangleMesh& from, const TriangleMesh& to) {
  const MeshDistance distance(to);
  double squares = 0.0;
  for (const Vec3f& p : from.vertices)
    squares += std::pow(distance.closest(p.cast<double>()).distance, 2);
  return std::sqrt(squares / double(from.vertices.size()));
}

double invented_area(const ObjectResult& object) {
  double out = 0.0;
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    if (object.evidence[t] == Evidence::kInvented) out += triangle_area(object.mesh, t);
  return out;
}

const ResolvedParameter* choice_of(const Reconstruction& made, const std::string& option) {
  for (const ResolvedParameter& choice : made.choices)
    if (choice.option == option) return &choice;
  return nullptr;
}

TEST(FewerTriangles, AreWorthAnEighthOfTheExpectedError) {
  Reconstruction made = made_of(known_ball());
  const TriangleMesh full = made.objects[0].mesh;
  ASSERT_TRUE(reduce_triangles({}, made, {}));
  const ObjectResult& object = made.objects[0];
  EXPECT_LT(object.mesh.triangles.size(), full.triangles.size() / 2);
  EXPECT_TRUE(object.check.watertight());
  EXPECT_LT(rms_distance(full, object.mesh), 0.4e-3 / 8.0);
  EXPECT_GT(rms_distance(full, object.mesh), 0.4e-3 / 8.0 / 4.0);
  const ResolvedParameter* choice = choice_of(made, "triangles");
  ASSERT_NE(choice, nullptr);
  EXPECT_EQ(choice->value, std::to_string(object.mesh.triangles.size()));
  EXPECT_NE(choice->reason.find("an eighth of the expected error, 0.4 mm"), std::string::npos)
      << choice->reason;
}

void expect_share_of_voxel(const ObjectResult& object, double share, const std::string& reason) {
  Reconstruction made = made_of(object);
  ASSERT_TRUE(reduce_triangles({}, made, {}));
  const double rms_m = rms_distance(object.mesh, made.objects[0].mesh);
  EXPECT_LT(rms_m, share * kVoxel_m);
  EXPECT_GT(rms_m, share * kVoxel_m / 4.0);
  EXPECT_NE(choice_of(made, "triangles")->reason.find(reason + " of a voxel of 1 mm"),
            std::string::npos);
}

TEST(FewerTriangles, AreWorthAQuarterOfAVoxelWhereTheErrorIsLarger) {
  ObjectResult worse = known_ball();
  for (VertexQuality& quality : worse.quality) quality.expected_error_m = 0.01f;
  expect_share_of_voxel(worse, 0.25, "a quarter");
}

TEST(FewerTriangles, AreWorthATwentiethOfAVoxelWhereTheErrorIsNotKnown) {
  ObjectResult unknown = known_ball();
  unknown.quality.clear();
  expect_share_of_voxel(unknown, 0.05, "a twentieth");
}

TEST(FewerTriangles, LeaveNoVertexFartherOffThanHalfAVoxel) {
  ObjectResult spiked = known_ball();
  for (VertexQuality& quality : spiked.quality) quality.expected_error_m = 0.0019f;
  spiked.mesh.vertices[200] *= 1.03f;  // 1.5 voxels, of which the mean around it hardly tells
  Reconstruction made = made_of(spiked);
  ASSERT_TRUE(reduce_triangles({}, made, {}));
  EXPECT_LT(made.objects[0].mesh.triangles.size(), spiked.mesh.triangles.size() / 4);
  const MeshDistance distance(made.objects[0].mesh);
  for (const Vec3f& p : spiked.mesh.vertices)
    EXPECT_LE(distance.closest(p.cast<double>()).distance, 0.5 * kVoxel_m);
}

TEST(FewerTriangles, AreNotMadeWhenAllAreAskedFor) {
  Reconstruction made = made_of(known_ball());
  const TriangleMesh full = made.objects[0].mesh;
  ReconstructOptions options;
  options.finish.triangles = "all";
  ASSERT_TRUE(reduce_triangles(options, made, {}));
  EXPECT_EQ(made.objects[0].mesh.triangles, full.triangles);
  EXPECT_TRUE(made.stages.empty());
}

TEST(FewerTriangles, AreNotMadeOfAMeshWhoseVerticesCarryColours) {
  Reconstruction made = made_of(known_ball());
  TriangleMesh& mesh = made.objects[0].mesh;
  mesh.colors.assign(mesh.vertices.size(), Rgb{200, 100, 50});
  const TriangleMesh full = mesh;
  ReconstructOptions options;
  options.color = true;
  ASSERT_TRUE(reduce_triangles(options, made, {}));
  EXPECT_EQ(made.objects[0].mesh.triangles, full.triangles);
  EXPECT_NE(choice_of(made, "triangles")->reason.find("colours"), std::string::npos);
  options.finish.triangles = "500";
  ASSERT_TRUE(reduce_triangles(options, made, {}));
  EXPECT_LE(made.objects[0].mesh.triangles.size(), 500u);
  EXPECT_EQ(made.objects[0].mesh.colors.size(), made.objects[0].mesh.vertices.size());
}

TEST(FewerTriangles, KeepWhatIsKnownOfTheSurface) {
  Reconstruction made = made_of(known_ball());
  const ObjectResult full = made.objects[0];
  ASSERT_TRUE(reduce_triangles({}, made, {}));
  const ObjectResult& object = made.objects[0];
  ASSERT_EQ(object.evidence.size(), object.mesh.triangles.size());
  ASSERT_EQ(object.confidence.size(), object.mesh.vertices.size());
  ASSERT_EQ(object.quality.size(), object.mesh.vertices.size());
  EXPECT_NEAR(invented_area(object), invented_area(full), 0.01 * invented_area(full));
  EXPECT_NEAR(object.invented_area_m2, invented_area(object), 1e-9);
  for (std::size_t v = 0; v < object.quality.size(); ++v) {
    const Vec3f& p = object.mesh.vertices[v];
    const VertexQuality& quality = object.quality[v];
    if (object.confidence[v] == 0.0f) {
      EXPECT_FLOAT_EQ(quality.expected_error_m, 0.02f);
      EXPECT_EQ(quality.frames, 0);
      continue;
    }
    EXPECT_EQ(quality.frames, 40);
    if (std::abs(p.x()) < 0.01f) {  // both halves are near
      EXPECT_GE(quality.expected_error_m, 0.00039f);
      EXPECT_LE(quality.expected_error_m, 0.00121f);
    } else {
      EXPECT_NEAR(quality.expected_error_m, p.x() < 0.0f ? 0.0012 : 0.0004, 1e-6);
    }
  }
}

TEST(FewerTriangles, OfAGivenNumberKeepWhatWasMeasuredApart) {
  Reconstruction made = made_of(known_ball());
  ReconstructOptions options;
  options.finish.triangles = "400";
  ASSERT_TRUE(reduce_triangles(options, made, {}));
  const ObjectResult& object = made.objects[0];
  EXPECT_LE(object.mesh.triangles.size(), 400u);
  for (std::size_t v = 0; v < object.quality.size(); ++v) {
    if (object.confidence[v] > 0.0f) {
      EXPECT_LT(object.quality[v].expected_error_m, 0.00121f);
    } else {
      EXPECT_FLOAT_EQ(object.quality[v].expected_error_m, 0.02f);
    }
  }
}

TEST(FewerTriangles, AreAskedForByNumberOrWord) {
  EXPECT_EQ(*triangles_wanted("auto"), std::nullopt);
  EXPECT_EQ(*triangles_wanted("all"), kAllTriangles);
  EXPECT_EQ(*triangles_wanted("500"), std::optional<std::size_t>(500));
  for (const char* text : {"", "3", "2.5", "many", "1e12", "nan", "-4"})
    EXPECT_EQ(triangles_wanted(text).error().code, ErrorCode::kInvalidOption) << text;
}

}  // namespace
}  // namespace turnscan
