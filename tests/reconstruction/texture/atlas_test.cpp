#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/atlas.hpp>
#include <turnscan/reconstruction/texture/chart_packing.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>

#include "tests/reconstruction/texture/painted_ellipsoid.hpp"

namespace turnscan::texture {
namespace {

/// A ring whose tube turns inside out as seen from any one side: no direction shows it all.
TriangleMesh torus(int around, int about) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < about; ++j) {
      const double a = 2.0 * std::numbers::pi * i / around, b = 2.0 * std::numbers::pi * j / about;
      const double r = 0.05 + 0.02 * std::cos(b);
      mesh.vertices.push_back(
          Vec3d(r * std::cos(a), 0.02 * std::sin(b), r * std::sin(a)).cast<float>());
    }
  const auto at = [&](int i, int j) { return std::uint32_t(i % around * about + j % about); };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < about; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  return mesh;
}

/// A strip that winds up about an axis: drawn along it, each turn lies on the one below.
TriangleMesh ramp() {
  TriangleMesh mesh;
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double a = 4.5 * 2.0 * std::numbers::pi * i / kSteps;
    for (const double r : {0.02, 0.05})
      mesh.vertices.push_back(Vec3d(r * std::cos(a), 0.0004 * i, r * std::sin(a)).cast<float>());
  }
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const std::uint32_t v = 2 * i;
    mesh.triangles.push_back({v, v + 2, v + 1});
    mesh.triangles.push_back({v + 1, v + 2, v + 3});
  }
  return mesh;
}

void expect_sound(const TriangleMesh& mesh, const Atlas& atlas) {
  ASSERT_EQ(atlas.corners.size(), mesh.triangles.size());
  std::vector<std::uint8_t> covered(std::size_t(atlas.size_px) * std::size_t(atlas.size_px), 0);
  std::map<std::pair<int, int>, std::set<std::uint32_t>> charts_of_block;
  for (std::size_t t = 0; t < atlas.corners.size(); ++t) {
    for (const Eigen::Vector2f& c : atlas.corners[t]) {
      ASSERT_GE(c.minCoeff(), float(kPadding_px)) << t;
      ASSERT_LE(c.maxCoeff(), float(atlas.size_px - kPadding_px)) << t;
      charts_of_block[{int(c.x()) / kBlock_px, int(c.y()) / kBlock_px}].insert(atlas.chart[t]);
    }
    for_each_texel(atlas.corners[t], [&](int x, int y) {
      std::uint8_t& texel = covered[std::size_t(y) * std::size_t(atlas.size_px) + std::size_t(x)];
      ASSERT_EQ(texel, 0) << "triangle " << t << " covers a texel twice";
      texel = 1;
      charts_of_block[{x / kBlock_px, y / kBlock_px}].insert(atlas.chart[t]);
    });
  }
  for (const auto& [block, charts] : charts_of_block) EXPECT_EQ(charts.size(), 1u);
}

/// Longest side of each triangle in the picture over that in space: between these.
std::pair<double, double> scales(const TriangleMesh& mesh, const Atlas& atlas) {
  double least = 1e9, most = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = mesh.triangles[t];
      const double space = double((mesh.vertices[v[k]] - mesh.vertices[v[(k + 1) % 3]]).norm());
      const double texels = double((atlas.corners[t][k] - atlas.corners[t][(k + 1) % 3]).norm());
      least = std::min(least, texels / space), most = std::max(most, texels / space);
    }
  return {least, most};
}

TEST(TextureAtlas, MapsEveryTriangleToAPlaceOfItsOwn) {
  for (const TriangleMesh& mesh : {torus(60, 30), testing::ellipsoid_mesh(40), ramp()}) {
    const auto atlas = make_atlas(mesh, 512, 1e9, RunContext());
    ASSERT_TRUE(atlas) << atlas.error().text();
    expect_sound(mesh, *atlas);
  }
}

TEST(TextureAtlas, StretchesNoSideBeyondWhatItSays) {
  const TriangleMesh mesh = torus(60, 30);
  const auto atlas = make_atlas(mesh, 1024, 1e9, RunContext());
  ASSERT_TRUE(atlas);
  EXPECT_LE(atlas->stretch, 1.0 / double(kMinChartCosine) + 1e-3);
  const auto [least, most] = scales(mesh, *atlas);
  EXPECT_LE(most, 1.02 * atlas->texels_per_m);
  EXPECT_GE(least, 0.97 * atlas->texels_per_m / atlas->stretch);
}

TEST(TextureAtlas, UsesMuchOfThePictureAndNoMoreThanTheScaleAskedFor) {
  const TriangleMesh mesh = testing::ellipsoid_mesh(60);
  const auto full = make_atlas(mesh, 1024, 1e9, RunContext());
  ASSERT_TRUE(full);
  std::size_t covered = 0;
  for (const auto& corners : full->corners) for_each_texel(corners, [&](int, int) { ++covered; });
  EXPECT_GT(double(covered), 0.4 * 1024 * 1024);
  const auto coarse = make_atlas(mesh, 1024, 2000.0, RunContext());
  ASSERT_TRUE(coarse);
  EXPECT_DOUBLE_EQ(coarse->texels_per_m, 2000.0);
}

TEST(TextureAtlas, IsTheSameForOneThreadAndSeveral) {
  const TriangleMesh mesh = torus(80, 40);
  set_thread_count(1);
  const auto one = make_atlas(mesh, 512, 1e9, RunContext());
  set_thread_count(4);
  const auto several = make_atlas(mesh, 512, 1e9, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && several);
  EXPECT_EQ(one->corners, several->corners);
  EXPECT_EQ(one->chart, several->chart);
}

TEST(TextureAtlas, SaysSoWhenThePictureIsTooSmall) {
  const auto atlas = make_atlas(torus(60, 30), 8, 1e9, RunContext());
  ASSERT_FALSE(atlas);
  EXPECT_EQ(atlas.error().code, ErrorCode::kResourceLimit);
}

TEST(TexelRaster, GivesATexelOnASharedEdgeToOneTriangle) {
  // A fan about a texel's centre, with corners on centres, too.
  const Eigen::Vector2f middle(4.5f, 4.5f);
  const std::array<Eigen::Vector2f, 5> around{
      Eigen::Vector2f(0.5f, 0.5f), {8.5f, 0.5f}, {8.5f, 8.5f}, {0.5f, 8.5f}, {0.5f, 0.5f}};
  std::map<std::pair<int, int>, int> times;
  for (std::size_t k = 0; k < 4; ++k)
    for_each_texel({middle, around[k], around[k + 1]}, [&](int x, int y) { ++times[{x, y}]; });
  for (int y = 1; y < 8; ++y)
    for (int x = 1; x < 8; ++x) EXPECT_EQ((times[{x, y}]), 1) << x << " " << y;
  for (const auto& [texel, n] : times) EXPECT_EQ(n, 1);
}

TEST(ChartPacking, PutsNothingOnTopOfAnother) {
  std::vector<ChartOutline> charts;
  for (int i = 0; i < 40; ++i) {
    ChartOutline chart;
    chart.width = 1 + i * 7 % 9;
    chart.height = 2 + i * 5 % 11;
    for (int c = 0; c < chart.width; ++c) {
      chart.bottom.push_back((i + c) % 2);
      chart.top.push_back(chart.height - (i + 2 * c) % 2);
    }
    charts.push_back(chart);
  }
  const auto places = pack_charts(charts, 64);
  ASSERT_TRUE(places);
  std::set<std::pair<int, int>> taken;
  for (std::size_t i = 0; i < charts.size(); ++i)
    for (int c = 0; c < charts[i].width; ++c)
      for (int r = charts[i].bottom[std::size_t(c)]; r < charts[i].top[std::size_t(c)]; ++r) {
        const std::pair cell((*places)[i].column + c, (*places)[i].row + r);
        EXPECT_TRUE(taken.insert(cell).second);
        EXPECT_LT(cell.first, 64);
        EXPECT_LT(cell.second, 64);
      }
  EXPECT_FALSE(pack_charts(charts, 20));
}

}  // namespace
}  // namespace turnscan::texture
