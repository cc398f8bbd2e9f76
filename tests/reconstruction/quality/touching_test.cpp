#include <gtest/gtest.h>

#include <turnscan/reconstruction/quality/touching.hpp>

namespace turnscan::quality {
namespace {

struct Block {
  Vec3f low, high;  // mm
};

/// Closed blocks, which may touch but not overlap.
TriangleMesh blocks(const std::vector<Block>& all) {
  TriangleMesh mesh;
  for (const Block& block : all) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (int c = 0; c < 8; ++c)
      mesh.vertices.push_back(1e-3f * Vec3f(c & 1 ? block.high.x() : block.low.x(),
                                            c & 2 ? block.high.y() : block.low.y(),
                                            c & 4 ? block.high.z() : block.low.z()));
    for (const auto& [a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      mesh.triangles.push_back({first + a, first + b, first + c});
      mesh.triangles.push_back({first + a, first + c, first + d});
    }
  }
  return mesh;
}

const Block kLeft{{-50, 0, -20}, {-2, 40, 20}}, kRight{{2, 0, -20}, {50, 60, 20}};

TEST(Touching, TheNeckBetweenTwoBlocksIsMeasured) {
  const auto neck =
      narrowest_neck(blocks({kLeft, {{-2, 0, -5}, {2, 20, 5}}, kRight}), 0.001, 0.002);
  ASSERT_TRUE(neck);
  EXPECT_NEAR(neck->area_m2, 0.010 * 0.020, 2e-6);
  EXPECT_NEAR(neck->share, 0.010 * 0.020 / (0.040 * 0.040), 0.02);
  EXPECT_NEAR(neck->place.x(), 0.0, 0.0025);
  EXPECT_NEAR(neck->place.z(), 0.0, 0.001);
}

TEST(Touching, AWideSectionIsNoNeck) {
  EXPECT_FALSE(narrowest_neck(blocks({kLeft, {{-2, 0, -15}, {2, 30, 15}}, kRight}), 0.001, 0.002));
}

TEST(Touching, ABarBetweenThemIsNoNeck) {
  const Block right{{82, 0, -20}, {130, 60, 20}};
  EXPECT_FALSE(narrowest_neck(blocks({kLeft, {{-2, 0, -5}, {82, 20, 5}}, right}), 0.001, 0.002));
}

TEST(Touching, LegsThatWouldFallAreNoThingsOfTheirOwn) {
  // A gate, thin in the middle of its lintel.
  const auto neck = narrowest_neck(blocks({{{-60, 0, -10}, {-50, 100, 10}},
                                           {{-50, 80, -10}, {-2, 100, 10}},
                                           {{-2, 80, -2}, {2, 84, 2}},
                                           {{2, 80, -10}, {50, 100, 10}},
                                           {{50, 0, -10}, {60, 100, 10}}}),
                                   0.001, 0.002);
  EXPECT_FALSE(neck);
}

}  // namespace
}  // namespace turnscan::quality
