#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/search/knn.hpp>

namespace turnscan {
namespace {

using Neighbours = std::vector<std::pair<std::uint32_t, float>>;

float squared_distance(const Vec3f& a, const Vec3f& b) {
  const float dx = a.x() - b.x(), dy = a.y() - b.y(), dz = a.z() - b.z();
  return dx * dx + dy * dy + dz * dz;
}

Neighbours all_by_distance(const std::vector<Vec3f>& points, const Vec3f& q) {
  Neighbours all;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) all.emplace_back(i, squared_distance(points[i], q));
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  });
  return all;
}

Neighbours nearest_by_tree(const KdTree& tree, const Vec3f& q, std::size_t k,
                           float reach_m = std::numeric_limits<float>::infinity()) {
  std::vector<std::uint32_t> index(k);
  std::vector<float> distance(k);
  const std::size_t found = tree.knn(q, k, index.data(), distance.data(), reach_m);
  Neighbours result;
  for (std::size_t i = 0; i < found; ++i) result.emplace_back(index[i], distance[i]);
  return result;
}

float random_value(std::uint64_t seed, std::uint64_t i, std::uint64_t axis) {
  return float(2.0 * uniform01(hash_key(seed, i, axis)) - 1.0);
}

std::vector<Vec3f> uniform_points(std::size_t n, std::uint64_t seed) {
  std::vector<Vec3f> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = Vec3f(random_value(seed, i, 0), random_value(seed, i, 1), random_value(seed, i, 2));
  }
  return points;
}

struct Distribution {
  const char* name;
  std::vector<Vec3f> (*make)(std::size_t n);
};

const Distribution kDistributions[] = {
    {"uniform", [](std::size_t n) { return uniform_points(n, 1); }},
    {"sphere",
     [](std::size_t n) {
       auto points = uniform_points(n, 2);
       for (Vec3f& p : points) p.normalize();
       return points;
     }},
    {"plane",
     [](std::size_t n) {
       auto points = uniform_points(n, 3);
       for (Vec3f& p : points) p.y() = 0.25f;
       return points;
     }},
    {"line",
     [](std::size_t n) {
       auto points = uniform_points(n, 4);
       for (Vec3f& p : points) p = Vec3f::Constant(p.x());
       return points;
     }},
    {"coarse grid with many ties",
     [](std::size_t n) {
       auto points = uniform_points(n, 5);
       for (Vec3f& p : points) p = (p * 3.0f).array().round().matrix() * 0.1f;
       return points;
     }},
    {"all the same point",
     [](std::size_t n) { return std::vector<Vec3f>(n, Vec3f(0.1f, 0.2f, 0.3f)); }},
    {"far from the origin",
     [](std::size_t n) {
       auto points = uniform_points(n, 6);
       for (Vec3f& p : points) p = p * 1e-3f + Vec3f(100, 200, 300);
       return points;
     }},
};

std::vector<Vec3f> queries_for(const std::vector<Vec3f>& points) {
  std::vector<Vec3f> queries = uniform_points(20, 77);
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 20) {
    queries.push_back(points[i]);
  }
  return queries;
}

TEST(Knn, GivesTheSameNeighboursAsBruteForce) {
  for (const Distribution& distribution : kDistributions) {
    for (const std::size_t n : {1, 2, 9, 10, 11, 100, 1500}) {
      const auto points = distribution.make(n);
      const KdTree tree(points);
      for (const Vec3f& q : queries_for(points)) {
        Neighbours expected = all_by_distance(points, q);
        for (const std::size_t k : {1, 3, 10, 64}) {
          const std::size_t count = std::min<std::size_t>(k, n);
          ASSERT_EQ(nearest_by_tree(tree, q, k),
                    Neighbours(expected.begin(), expected.begin() + std::ptrdiff_t(count)))
              << distribution.name << ", " << n << " points, k = " << k;
        }
      }
    }
  }
}

TEST(Knn, FindsThePointsWithinARadiusLikeBruteForce) {
  for (const Distribution& distribution : kDistributions) {
    const auto points = distribution.make(700);
    const KdTree tree(points);
    Neighbours found;
    for (const Vec3f& q : queries_for(points)) {
      for (const float radius : {0.0f, 0.1f, 0.3f, 5.0f}) {
        Neighbours expected = all_by_distance(points, q);
        std::erase_if(expected, [&](const auto& n) { return n.second > radius * radius; });
        tree.radius(q, radius, found);
        ASSERT_EQ(found, expected) << distribution.name << ", radius " << radius;
        expected.resize(std::min<std::size_t>(3, expected.size()));
        ASSERT_EQ(nearest_by_tree(tree, q, 3, radius), expected)
            << distribution.name << ", the three nearest within " << radius;
      }
    }
  }
}

TEST(Knn, TiesComeInTheOrderOfTheirIndices) {
  const std::vector<Vec3f> points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  const Neighbours expected = {{0, 1.0f}, {1, 1.0f}, {2, 1.0f}};
  EXPECT_EQ(nearest_by_tree(KdTree(points), Vec3f::Zero(), 3), expected);
}

TEST(Knn, FewerPointsThanAskedForAreAllReturned) {
  const KdTree tree(uniform_points(4, 9));
  EXPECT_EQ(nearest_by_tree(tree, Vec3f::Zero(), 10).size(), 4u);
}

TEST(Knn, NoPointsGiveNoNeighbours) {
  Neighbours found = {{7, 1.0f}};
  for (const KdTree& tree : {KdTree(), KdTree(std::vector<Vec3f>())}) {
    EXPECT_EQ(tree.size(), 0u);
    EXPECT_TRUE(nearest_by_tree(tree, Vec3f::Zero(), 3).empty());
    tree.radius(Vec3f::Zero(), 1.0f, found);
    EXPECT_TRUE(found.empty());
  }
}

TEST(Knn, PointsThatAreNotFiniteAreNobodysNeighbourButKeepTheirIndex) {
  auto points = uniform_points(50, 10);
  for (std::size_t i = 0; i < 50; i += 3) {
    points[i][Eigen::Index(i % 2)] =
        i % 2 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  }
  const KdTree tree(points);
  EXPECT_EQ(tree.size(), 33u);
  EXPECT_EQ(nearest_by_tree(tree, points[1], 50), all_by_distance(points, points[1]));
}

TEST(Knn, AQueryThatIsNotFiniteFindsNothing) {
  const KdTree tree(uniform_points(5, 11));
  Neighbours found;
  const Vec3f nan = Vec3f::Constant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(nearest_by_tree(tree, nan, 3).empty());
  tree.radius(nan, 1.0f, found);
  EXPECT_TRUE(found.empty());
  tree.radius(Vec3f::Zero(), std::numeric_limits<float>::quiet_NaN(), found);
  EXPECT_TRUE(found.empty());
  tree.radius(Vec3f::Zero(), -1.0f, found);
  EXPECT_TRUE(found.empty());
}

TEST(Knn, AMovedTreeStillAnswers) {
  const auto points = uniform_points(30, 12);
  KdTree first(points);
  const KdTree second = std::move(first);
  EXPECT_EQ(nearest_by_tree(second, points[7], 1).front().first, 7u);
}

}  // namespace
}  // namespace turnscan
