#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tests/support/synthetic_cloud.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/reconstruction/poisson/poisson.hpp>
#include <turnscan/reconstruction/poisson/poisson_kernel.hpp>
#include <turnscan/reconstruction/poisson/poisson_surface.hpp>
#include <turnscan/reconstruction/surface/surface_repair.hpp>

namespace turnscan::poisson {
namespace {

float noise(std::uint64_t stream, std::uint64_t i) {
  return float(2.0 * uniform01(hash_key(17, stream, i)) - 1.0);
}

/// The quadratic B-spline around 0.5, the centre of cell 0, and its slope.
double spline(double x) {
  const double d = std::abs(x - 0.5);
  return d < 0.5 ? 0.75 - d * d : d < 1.5 ? 0.5 * (1.5 - d) * (1.5 - d) : 0.0;
}
double slope(double x) {
  const double d = x - 0.5;
  if (std::abs(d) < 0.5) return -2.0 * d;
  return std::abs(d) < 1.5 ? (d > 0 ? d - 1.5 : d + 1.5) : 0.0;
}

/// Gauss's three points: exact for a product of two splines in a cell.
template <class F>
double integral(const F& f, int from, int to) {
  double sum = 0.0;
  for (int cell = from; cell < to; ++cell)
    sum += (5.0 * f(cell + 0.5 - std::sqrt(0.15)) + 8.0 * f(cell + 0.5) +
            5.0 * f(cell + 0.5 + std::sqrt(0.15))) /
           18.0;
  return sum;
}

/// Integrals of products of a spline with the one `apart` cells on.
struct Products {
  double mass[5], stiff[5], slope_here[5];  // by apart + 2
  Products() {
    for (int a = -2; a <= 2; ++a) {
      mass[a + 2] = integral([&](double x) { return spline(x) * spline(x - a); }, -3, 4);
      stiff[a + 2] = integral([&](double x) { return slope(x) * slope(x - a); }, -3, 4);
      slope_here[a + 2] = integral([&](double x) { return slope(x) * spline(x - a); }, -3, 4);
    }
  }
};

Block random_block(std::uint64_t stream) {
  Block block;
  for (std::size_t i = 0; i < block.size(); ++i) block[i] = noise(stream, i);
  return block;
}

/// Sum over the 125 splines that overlap one of weight(di, dj, dk) times their coefficients.
template <class Weight>
double gathered(const Block& block, int i, int j, int k, const Weight& weight) {
  double sum = 0.0;
  for (int dk = -2; dk <= 2; ++dk)
    for (int dj = -2; dj <= 2; ++dj)
      for (int di = -2; di <= 2; ++di)
        sum += weight(di + 2, dj + 2, dk + 2) * double(block[in_block(i + di, j + dj, k + dk)]);
  return sum;
}

TEST(PoissonKernel, StiffnessIsTheIntegralOfTheProductOfGradients) {
  const Products p;
  const Block block = random_block(1);
  std::array<float, kCells> out;
  stiffness(block.data(), out.data());
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        ASSERT_NEAR(gathered(block, i, j, k,
                             [&](int a, int b, int c) {
                               return p.stiff[a] * p.mass[b] * p.mass[c] +
                                      p.mass[a] * p.stiff[b] * p.mass[c] +
                                      p.mass[a] * p.mass[b] * p.stiff[c];
                             }),
                    out[in_brick(i, j, k)], 2e-6);
}

TEST(PoissonKernel, DivergenceIsTheIntegralOfTheFieldAlongTheGradient) {
  const Products p;
  const Block x = random_block(1), y = random_block(2), z = random_block(3);
  std::array<float, kCells> out;
  divergence(x.data(), y.data(), z.data(), out.data());
  for (int n = 0; n < int(kCells); n += 7) {
    const int i = n % 8, j = n / 8 % 8, k = n / 64;
    const auto along = [&](int axis) {
      return [&p, axis](int a, int b, int c) {
        return (axis == 0 ? p.slope_here : p.mass)[a] * (axis == 1 ? p.slope_here : p.mass)[b] *
               (axis == 2 ? p.slope_here : p.mass)[c];
      };
    };
    ASSERT_NEAR(gathered(x, i, j, k, along(0)) + gathered(y, i, j, k, along(1)) +
                    gathered(z, i, j, k, along(2)),
                out[in_brick(i, j, k)], 2e-6);
  }
}

TEST(PoissonKernel, RefiningKeepsTheFunction) {
  std::array<float, 512> coarse;
  for (std::size_t i = 0; i < coarse.size(); ++i) coarse[i] = noise(5, i);
  Block fine;
  refine(coarse.data(), fine.data());
  for (std::uint64_t n = 0; n < 50; ++n) {
    double at[3];  // in coarse cells, within the brick
    for (std::uint64_t a = 0; a < 3; ++a) at[a] = 4.0 * uniform01(hash_key(23, n, a));
    double from_coarse = 0.0, from_fine = 0.0;
    for (int k = 0; k < 8; ++k)
      for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i)
          from_coarse += double(coarse[std::size_t(i + 8 * (j + 8 * k))]) *
                         spline(at[0] - (i - 2)) * spline(at[1] - (j - 2)) *
                         spline(at[2] - (k - 2));
    for (int k = -2; k < 10; ++k)
      for (int j = -2; j < 10; ++j)
        for (int i = -2; i < 10; ++i)
          from_fine += double(fine[in_block(i, j, k)]) * spline(2 * at[0] - i) *
                       spline(2 * at[1] - j) * spline(2 * at[2] - k);
    ASSERT_NEAR(from_coarse, from_fine, 1e-5);
  }
}

TEST(PoissonKernel, CoarseningIsHalfTheTransposeOfRefining) {
  constexpr int kFine = 18;
  std::vector<float> fine(std::size_t(kFine) * kFine * kFine);
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = noise(6, i);
  std::array<float, kCells> out{};
  coarsen(fine.data(), out.data());
  // A coarse spline is made of the fine ones of its two halves and of those beside them.
  const double part[4] = {0.25, 0.75, 0.75, 0.25};
  for (int n = 0; n < int(kCells); n += 5) {
    const int i = n % 8, j = n / 8 % 8, k = n / 64;
    double sum = 0.0;
    for (int c = 0; c < 64; ++c) {
      const int a = c % 4, b = c / 4 % 4, d = c / 16;
      sum += 0.5 * part[a] * part[b] * part[d] *
             double(fine[std::size_t((2 * i + a) + kFine * ((2 * j + b) + kFine * (2 * k + d)))]);
    }
    ASSERT_NEAR(sum, out[in_brick(i, j, k)], 1e-6);
  }
}

TEST(PoissonBricks, BeyondTheFacesLiesTheNegativeMirrorImage) {
  SparseBricks bricks(4);  // 2^3 bricks
  for (int n = 0; n < 8; ++n) bricks.add({n & 1, n >> 1 & 1, n >> 2});
  Field field(bricks.size() * kCells);
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = noise(7, i);
  const auto value = [&](int i, int j, int k) {
    double sign = 1.0;
    for (int* x : {&i, &j, &k}) {
      if (*x < 0) *x = -1 - *x, sign = -sign;
      if (*x > 15) *x = 31 - *x, sign = -sign;
    }
    return float(sign) * field[std::size_t(bricks.cell(i, j, k))];
  };
  for (std::size_t s = 0; s < bricks.size(); ++s) {
    Block block;
    bricks.gather(field, s, block);
    const Index& b = bricks[s];
    for (int k = -2; k < 10; ++k)
      for (int j = -2; j < 10; ++j)
        for (int i = -2; i < 10; ++i)
          ASSERT_EQ(block[in_block(i, j, k)], value(8 * b[0] + i, 8 * b[1] + j, 8 * b[2] + k));
  }
}

TEST(PoissonBricks, WhereNoBrickIsTheWindowAsksAndTheBlockIsZero) {
  SparseBricks bricks(5);
  bricks.add({1, 1, 1});
  bricks.add({2, 1, 1});
  bricks.add({1, 1, 1});
  EXPECT_EQ(bricks.size(), 2u);
  Field field(kCells, 3.0f);  // the second brick has no values
  Block block;
  bricks.gather(field, 0, block);
  EXPECT_EQ(block[in_block(7, 0, 0)], 3.0f);
  EXPECT_EQ(block[in_block(8, 0, 0)], 0.0f);
  std::array<float, 1000> window;
  bricks.window(
      field, {7, 7, 7}, 10, [](int, int, int) { return -1.0f; }, window.data());
  int asked = 0;
  for (const float v : window) asked += v == -1.0f ? 1 : 0;
  EXPECT_EQ(asked, 1000 - 512);
  EXPECT_EQ(window[0], -1.0f);
  EXPECT_EQ(window[1 + 10 * (1 + 10 * 1)], 3.0f);
}

PointCloud sphere(std::size_t n, double radius_m, std::uint64_t seed = 1) {
  PointCloud cloud;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double y = 2 * uniform01(hash_key(seed, i, 0)) - 1, r = std::sqrt(1 - y * y);
    const double a = 2 * std::numbers::pi * uniform01(hash_key(seed, i, 1));
    const Vec3f normal(float(r * std::cos(a)), float(y), float(r * std::sin(a)));
    cloud.points.push_back(float(radius_m) * normal);
    cloud.normals.push_back(normal);
  }
  return cloud;
}

constexpr double kSide_m = 0.11;
Cube cube_of_side() { return {Vec3d::Constant(-0.5 * kSide_m), kSide_m}; }

/// Bricks of a level around the samples, for what is asked level by level.
SparseBricks all_bricks(int depth) {
  SparseBricks bricks(depth);
  for (int k = 0; k < bricks.side(); ++k)
    for (int j = 0; j < bricks.side(); ++j)
      for (int i = 0; i < bricks.side(); ++i) bricks.add({i, j, k});
  return bricks;
}

double area_m2(const OrientedSamples& samples, int depth) {
  double sum = 0.0;
  for (const SampleCluster& c : samples.clusters(all_bricks(depth)).all) sum += double(c.area);
  const double cell = kSide_m / std::ldexp(1.0, depth);
  return sum * cell * cell;
}

TEST(PoissonSamples, TheirAreasAreThatOfTheSurfaceHoweverManyTheyAre) {
  const double truth = 4.0 * std::numbers::pi * 0.05 * 0.05;
  for (const std::size_t n : {500u, 5000u, 50000u}) {
    const OrientedSamples samples(sphere(n, 0.05), cube_of_side(), 8, 1.5);
    EXPECT_NEAR(area_m2(samples, 4), truth, 0.07 * truth) << n;
    EXPECT_NEAR(area_m2(samples, 6), area_m2(samples, 4), 1e-9) << n;
  }
}

TEST(PoissonSamples, FourTimesTheSamplesReachALevelDeeper) {
  const auto deepest = [](std::size_t n, double wanted) {
    return OrientedSamples(sphere(n, 0.05), cube_of_side(), 10, wanted).deepest();
  };
  EXPECT_EQ(deepest(16000, 1.5), deepest(4000, 1.5) + 1);
  EXPECT_EQ(deepest(64000, 1.5), deepest(4000, 1.5) + 2);
  EXPECT_EQ(deepest(16000, 6.0), deepest(4000, 1.5));
  // And never deeper than was asked for.
  EXPECT_EQ(OrientedSamples(sphere(64000, 0.05), cube_of_side(), 5, 1.5).deepest(), 5);
}

TEST(PoissonSamples, ManyPointsAtOnePlaceMakeNoDeepLevels) {
  PointCloud cloud = sphere(4000, 0.05);
  const int even = OrientedSamples(cloud, cube_of_side(), 13, 1.5).deepest();
  for (int i = 0; i < 2000; ++i) {
    cloud.points.push_back(cloud.points[0]);
    cloud.normals.push_back(cloud.normals[0]);
  }
  EXPECT_LE(OrientedSamples(cloud, cube_of_side(), 13, 1.5).deepest(), even + 2);
}

TEST(PoissonSamples, TheMedianIsThatOfTheFunctionAtTheSamples) {
  // Well within the cube: what is 0 on its faces is not linear there.
  const OrientedSamples samples(sphere(301, 0.03), cube_of_side(), 4, 1.5);
  const SparseBricks bricks = all_bricks(4);
  Field height(bricks.size() * kCells);
  for (std::size_t s = 0; s < bricks.size(); ++s)
    for (int n = 0; n < int(kCells); ++n)
      height[s * kCells + std::size_t(n)] = float(bricks[s][1] * kSide + n / 8 % 8) + 0.5f;
  std::vector<double> truth;  // a linear function is its own spline
  for (const Vec3f& p : sphere(301, 0.03).points)
    truth.push_back((double(p.y()) / kSide_m + 0.5) * 16.0);
  std::sort(truth.begin(), truth.end());
  EXPECT_NEAR(samples.median(bricks, height), truth[150], 1e-4);
}

/// What the equation's solution makes least, straight from its definition on one brick: the
/// integral of |grad u - V|^2, plus weight times the sum of area (u + kOutside)^2 at the clusters.
class Energy {
 public:
  Energy(const OrientedSamples& samples, double weight) : bricks_(3), weight_(weight) {
    bricks_.add({0, 0, 0});
    for (Field& f : v_) f.assign(kCells, 0.0f);
    samples.splat(bricks_, v_[0], v_[1], v_[2]);
    clusters_ = samples.clusters(bricks_);
  }

  double operator()(const Field& u) const {
    double sum = 0.0;
    const double at[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
    const double w[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    for (int n = 0; n < int(kCells); ++n) {
      const int cell[3] = {n % 8, n / 8 % 8, n / 64};
      for (int g = 0; g < 27; ++g) {
        const int q[3] = {g % 3, g / 3 % 3, g / 9};
        Vec3d gradient = Vec3d::Zero();
        for (int c = 0; c < 27; ++c) {
          const int d[3] = {c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1};
          double s[3], t[3];
          for (int a = 0; a < 3; ++a) s[a] = spline(at[q[a]] - d[a]), t[a] = slope(at[q[a]] - d[a]);
          const double value = coefficient(u, cell[0] + d[0], cell[1] + d[1], cell[2] + d[2]);
          gradient += value * Vec3d(t[0] * s[1] * s[2], s[0] * t[1] * s[2], s[0] * s[1] * t[2]);
          for (int a = 0; a < 3; ++a)
            if (inside(cell[0] + d[0], cell[1] + d[1], cell[2] + d[2]))
              gradient[a] -=
                  s[0] * s[1] * s[2] *
                  coefficient(v_[std::size_t(a)], cell[0] + d[0], cell[1] + d[1], cell[2] + d[2]);
        }
        sum += w[q[0]] * w[q[1]] * w[q[2]] * gradient.squaredNorm();
      }
    }
    for (const SampleCluster& c : clusters_.all) {
      double value = kOutside;
      for_each_cell(c.spot, bricks_.neighbours({0, 0, 0}), [&](std::size_t at_cell, float weight) {
        value += double(weight * u[at_cell]);
      });
      sum += weight_ * double(c.area) * value * value;
    }
    return sum;
  }

 private:
  static bool inside(int i, int j, int k) {
    return i >= 0 && j >= 0 && k >= 0 && i < 8 && j < 8 && k < 8;
  }
  static double coefficient(const Field& u, int i, int j, int k) {
    double sign = 1.0;
    for (int* x : {&i, &j, &k}) {
      if (*x < 0) *x = -1 - *x, sign = -sign;
      if (*x > 7) *x = 15 - *x, sign = -sign;
    }
    return sign * double(u[in_brick(i, j, k)]);
  }

  SparseBricks bricks_;
  double weight_;
  std::array<Field, 3> v_;
  SampleClusters clusters_;
};

TEST(PoissonSolve, NoChangeOfTheSolutionLowersTheEnergy) {
  const OrientedSamples samples(sphere(3000, 0.03), cube_of_side(), kCoarsest, 1.5);
  for (const double weight : {0.0, 4.0}) {
    const Energy energy(samples, weight);
    OctreeLevels levels = make_levels(samples, RunContext()).value();
    ASSERT_TRUE(solve_level(levels, 0, samples, weight, RunContext()));
    const Field& u = levels[0].indicator;
    const double least = energy(u), start = energy(Field(kCells, 0.0f));
    ASSERT_LT(least, start);
    for (std::uint64_t n = 0; n < 6; ++n) {
      Field changed = u;
      for (std::size_t i = 0; i < kCells; ++i) changed[i] += 0.01f * noise(40 + n, i);
      EXPECT_GT(energy(changed), least) << weight;
    }
    for (const float scale : {0.95f, 1.05f}) {
      Field scaled = u;
      for (float& x : scaled) x *= scale;
      EXPECT_GT(energy(scaled), least) << weight << " " << scale;
    }
  }
}

TEST(PoissonSolve, TheIndicatorIsAHalfOutsideAndMinusAHalfInside) {
  const OrientedSamples samples(sphere(20000, 0.03), cube_of_side(), 6, 1.5);
  OctreeLevels levels = make_levels(samples, RunContext()).value();
  double iso = 1.0;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    iso = solve_level(levels, l, samples, 10.0, RunContext()).value();
    if (l + 1 < levels.size()) add_surface_bricks(levels, l, iso);
  }
  EXPECT_NEAR(iso, 0.0, 0.01);
  const std::size_t finest = levels.size() - 1;
  const int middle = levels[finest].bricks.cells() / 2;
  EXPECT_NEAR(kOutside + double(indicator(levels, finest, middle, middle, middle)), -0.5, 0.03);
  EXPECT_NEAR(kOutside + double(indicator(levels, finest, 1, 1, 1)), 0.5, 0.03);
  EXPECT_LT(kOutside + double(indicator_near(levels, finest, middle, middle, middle)), -0.4);
}

SurfaceOptions depth_of(int depth) {
  SurfaceOptions options;
  options.poisson_depth = depth;
  return options;
}

double worst_radius(const TriangleMesh& mesh, double radius_m) {
  double worst = 0.0;
  for (const Vec3f& v : mesh.vertices)
    worst = std::max(worst, std::abs(v.cast<double>().norm() - radius_m));
  return worst;
}

TEST(Poisson, IsClosedAndWithinAHundredthOfACellOnAnEvenSphere) {
  const auto mesh = poisson_surface(sphere(40000, 0.05), depth_of(7), RunContext());
  ASSERT_TRUE(mesh) << mesh.error().text();
  const MeshReport report = check_mesh(*mesh);
  EXPECT_TRUE(report.watertight()) << report.text();
  EXPECT_EQ(report.euler, 2);
  EXPECT_NEAR(report.volume_m3, 4.0 / 3.0 * std::numbers::pi * 1.25e-4, 1e-6);
  EXPECT_LT(worst_radius(*mesh, 0.05), 0.05 * 0.11 / 128);
}

TEST(Poisson, IsTheSameForOneTwoAndEightThreads) {
  const PointCloud points = sphere(20000, 0.05);
  set_thread_count(1);
  const auto one = poisson_surface(points, depth_of(7), RunContext());
  for (const int threads : {2, 8}) {
    set_thread_count(threads);
    const auto other = poisson_surface(points, depth_of(7), RunContext());
    ASSERT_TRUE(one && other);
    EXPECT_TRUE(one->vertices == other->vertices && one->triangles == other->triangles) << threads;
  }
  set_thread_count(0);
}

TEST(Poisson, DepthMakesFinerTrianglesAsFarAsThePointsAreDense) {
  const PointCloud points = sphere(20000, 0.05);
  const auto triangles = [&](int depth) {
    return double(poisson_surface(points, depth_of(depth), RunContext())->triangles.size());
  };
  EXPECT_NEAR(triangles(6) / triangles(5), 4.0, 0.2);
  EXPECT_EQ(triangles(11), triangles(10));
}

TEST(Poisson, MoreSamplesANodeSmoothNoise) {
  PointCloud points = sphere(20000, 0.05);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.points[i] += 0.0006f * noise(9, i) * points.normals[i];
  const auto roughness = [&](double samples) {
    SurfaceOptions options = depth_of(8);
    options.samples_per_node = samples;
    const auto mesh = poisson_surface(points, options, RunContext());
    double sum = 0.0;
    for (const Vec3f& v : mesh->vertices) sum += std::pow(double(v.norm()) - 0.05, 2);
    return std::sqrt(sum / double(mesh->vertices.size()));
  };
  EXPECT_LT(roughness(5.0), 0.7 * roughness(1.0));
}

TEST(Poisson, PointWeightPullsTheSurfaceOntoThePoints) {
  // The normals lean: they alone would make another surface.
  PointCloud points = sphere(20000, 0.05);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.normals[i] =
        (points.normals[i] + 0.3f * std::sin(120.0f * points.points[i].x()) * Vec3f::UnitX())
            .normalized();
  const auto worst = [&](double weight) {
    SurfaceOptions options = depth_of(7);
    options.point_weight = weight;
    return worst_radius(*poisson_surface(points, options, RunContext()), 0.05);
  };
  EXPECT_LT(worst(20.0), 0.5 * worst(0.0));
}

TEST(Poisson, ClosesWhatIsOpenWithinItsCube) {
  PointCloud all = sphere(20000, 0.05), cup;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.points[i].y() > 0.02f) continue;
    cup.points.push_back(all.points[i]);
    cup.normals.push_back(all.normals[i]);
  }
  const auto mesh = poisson_surface(cup, depth_of(7), RunContext());
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(check_mesh(*mesh).watertight());
  EXPECT_LT(bounds(mesh->vertices).max.y(), 0.055f);
}

TEST(Poisson, RefusesPointsAtOnePlace) {
  PointCloud points;
  for (int i = 0; i < 20; ++i) {
    points.points.emplace_back(0.1f, 0.2f, 0.3f);
    points.normals.emplace_back(0.0f, 1.0f, 0.0f);
  }
  const auto mesh = poisson_surface(points, depth_of(7), RunContext());
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kTooFewPoints);
}

/// A plate of points that face up.
PointCloud plate() {
  PointCloud cloud;
  for (int i = 0; i < 60; ++i) {
    for (int j = 0; j < 60; ++j) {
      cloud.points.emplace_back(0.001f * float(i), 0.0f, 0.001f * float(j));
      cloud.normals.emplace_back(0.0f, 1.0f, 0.0f);
    }
  }
  return cloud;
}

TEST(Poisson, APlateSeenFromOneSideBecomesAClosedPieceAndStaysOne) {
  const auto mesh = poisson_surface(plate(), depth_of(6), RunContext());
  ASSERT_TRUE(mesh) << mesh.error().text();
  // Tightened its unseen side would lie on the seen one.
  const auto finished =
      surface::repair_poisson(*mesh, plate(), 0.003, surface::Parts::kMain, RunContext());
  ASSERT_TRUE(finished) << finished.error().text();
  EXPECT_TRUE(finished->check.watertight());
}

TEST(Poisson, NormalsThatEncloseNothingAreAnError) {
  PointCloud inside_out = sphere(3000, 0.05);
  for (Vec3f& n : inside_out.normals) n = Vec3f::Zero();
  SurfaceOptions options = depth_of(6);
  options.point_weight = 0.0;
  const auto mesh = poisson_surface(inside_out, options, RunContext());
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kLibrary);
}

TEST(Poisson, IsClosedAndTwoManifoldWhateverThePoints) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto u = [&](std::uint64_t i, std::uint64_t which) {
      return uniform01(hash_key(seed, i, which));
    };
    PointCloud cloud;
    const std::uint64_t n = 10 + std::uint64_t(600 * u(0, 9));
    for (std::uint64_t i = 0; i < n; ++i) {
      Vec3f p(float(u(i, 0)), float(u(i, 1)), float(u(i, 2)));
      if (seed % 4 == 1) p = p.normalized();
      if (seed % 4 == 2) p.y() = 0.0f;
      if (seed % 4 == 3 && i % 2 == 0) p = Vec3f::Constant(0.3f);
      cloud.points.push_back(p);
      cloud.normals.push_back(
          Vec3f(float(u(i, 3)) - 0.4f, float(u(i, 4)) - 0.4f, float(u(i, 5)) - 0.4f).normalized());
    }
    SurfaceOptions options = depth_of(2 + int(seed % 5));
    options.point_weight = double(seed % 3) * 10.0;
    const auto mesh = poisson_surface(cloud, options, RunContext());
    if (!mesh) continue;
    const MeshReport report = check_mesh(*mesh);
    EXPECT_EQ(report.boundary_edges, 0) << seed;
    EXPECT_EQ(report.non_manifold_edges, 0) << seed;
    EXPECT_EQ(report.non_manifold_vertices, 0) << seed;
  }
}

TEST(Poisson, StopsWhenCancelled) {
  const RunContext context;
  context.cancel();
  EXPECT_EQ(poisson_surface(sphere(5000, 0.05), depth_of(7), context).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::poisson
