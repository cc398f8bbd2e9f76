#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/reconstruction/estimation/sensor_filter.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_sharpen.hpp>
#include <turnscan/reconstruction/views/view_drawing.hpp>

namespace turnscan::mesh_refinement {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A camera half a metre from the table's axis, 1.6 mm a pixel there; the platter turned by `turn`.
views::DepthView camera(double turn) {
  views::DepthView view;
  view.rotation = (Pose(Eigen::AngleAxisd(0.3, Vec3d::UnitX())) * rotation_about_y(turn))
                      .linear()
                      .cast<float>();
  view.translation = Vec3f(0.0f, 0.0f, 0.5f);
  view.fx = view.fy = 310.0f;
  view.cx = 39.5f, view.cy = 29.5f;
  view.width = 80, view.height = 60;
  view.pixels.assign(4800, 0);
  return view;
}

/// A box of 60 x 40 x 2 mm, its surface in squares of 1 mm.
TriangleMesh plate() {
  const std::array<int, 3> half{30, 20, 1};
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {-1, 1}) {
      const auto first = std::uint32_t(mesh.vertices.size());
      const int nu = 2 * half[std::size_t(u)] + 1, nv = 2 * half[std::size_t(v)] + 1;
      for (int j = 0; j < nv; ++j) {
        for (int i = 0; i < nu; ++i) {
          Vec3f p;
          p[axis] = 1e-3f * float(side * half[std::size_t(axis)]);
          p[u] = 1e-3f * float(i - half[std::size_t(u)]);
          p[v] = 1e-3f * float(j - half[std::size_t(v)]);
          mesh.vertices.push_back(p);
          if (i == 0 || j == 0) continue;
          const std::uint32_t d = first + std::uint32_t(j * nu + i), c = d - 1,
                              b = d - std::uint32_t(nu), a = b - 1;
          mesh.triangles.push_back(side > 0 ? Corners{a, b, d} : Corners{a, d, b});
          mesh.triangles.push_back(side > 0 ? Corners{a, d, c} : Corners{a, c, d});
        }
      }
    }
  }
  // Corners and edges were made for each side: the same places become one vertex.
  std::map<std::array<long, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> to(mesh.vertices.size());
  std::vector<Vec3f> kept;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Vec3f p = 1e3f * mesh.vertices[i];
    const auto [found, made] =
        places.emplace(std::array{std::lround(p.x()), std::lround(p.y()), std::lround(p.z())},
                       std::uint32_t(kept.size()));
    if (made) kept.push_back(mesh.vertices[i]);
    to[i] = found->second;
  }
  mesh.vertices = std::move(kept);
  for (Corners& t : mesh.triangles) t = {to[t[0]], to[t[1]], to[t[2]]};
  return mesh;
}

/// The mesh as a camera measures it that averages over 3 x 3 pixels, so many times, while the
/// platter turns by `turn` from one to the next.
std::vector<views::DepthView> filtered(const TriangleMesh& mesh, int count = 24,
                                       double turn = 0.26) {
  std::vector<views::DepthView> views;
  for (int v = 0; v < count; ++v) {
    views::DepthView view = camera(turn * v);
    const views::ViewDrawing drawing(view, mesh);
    for (int y = 1; y < 59; ++y) {
      for (int x = 1; x < 79; ++x) {
        views::ViewDrawing::Received sum;
        for (int n = 0; n < 9; ++n) {
          const auto one = drawing.received(x + n % 3 - 1, y + n / 3 - 1);
          sum.light += one.light;
          sum.depth += one.depth;
        }
        if (sum.light > 0.0f && drawing.received(x, y).light > 0.0f)
          view.pixels[std::size_t(80 * y + x)] =
              views::DepthView::pack(std::uint32_t(std::lround(sum.mean() / 1e-4f)), false, 0);
      }
    }
    views.push_back(std::move(view));
  }
  return views;
}

const std::vector<views::DepthView>& filtered_views() {
  static const std::vector<views::DepthView> views = filtered(plate());
  return views;
}

MeshFitScale scale() {
  MeshFitScale out;
  out.noise_m = 0.001;
  out.reach_m = 0.0015;
  return out;
}

double mean_error(const TriangleMesh& mesh, const TriangleMesh& truth) {
  const MeshDistance distance(truth);
  double sum = 0.0;
  for (const Vec3f& p : mesh.vertices) sum += distance.closest(p.cast<double>()).distance;
  return sum / double(mesh.vertices.size());
}

/// How far the ends of the plate, 2 mm thick, lie too far inside, in the mean.
double shortened(const TriangleMesh& mesh, const TriangleMesh& truth) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (std::abs(truth.vertices[v].x()) < 0.0299f || std::abs(truth.vertices[v].y()) > 0.015f)
      continue;
    sum += 0.03 - double(std::abs(mesh.vertices[v].x()));
    ++count;
  }
  return sum / count;
}

TEST(SharpenMesh, TakesBackWhatTheFilterDidToRims) {
  const TriangleMesh truth = plate();
  const std::vector<views::DepthView>& views = filtered_views();
  const auto fitted = fit_mesh(truth, views, scale(), RunContext());
  ASSERT_TRUE(fitted);
  TriangleMesh mesh = fitted->mesh;
  const double before = shortened(mesh, truth);
  EXPECT_GT(before, 2e-4);
  ASSERT_TRUE(sharpen_mesh(mesh, views, 1.0 / 3.0, scale(), RunContext()));
  EXPECT_LT(std::abs(shortened(mesh, truth)), 0.85 * before);
}

TEST(SharpenMesh, MovesNothingThatMeasurementsExplain) {
  const TriangleMesh truth = plate();
  TriangleMesh mesh = truth;
  ASSERT_TRUE(sharpen_mesh(mesh, filtered_views(), 1.0 / 3.0, scale(), RunContext()));
  EXPECT_LT(mean_error(mesh, truth), 2e-5);
}

TEST(SharpenMesh, GivesTheSameForAnyNumberOfThreads) {
  const TriangleMesh truth = plate();
  const std::vector<views::DepthView>& views = filtered_views();
  std::vector<TriangleMesh> meshes;
  for (const int threads : {1, 2, 8}) {
    set_thread_count(threads);
    TriangleMesh mesh = truth;
    for (Vec3f& p : mesh.vertices) p *= 0.98f;
    EXPECT_TRUE(sharpen_mesh(mesh, views, 0.3, scale(), RunContext()));
    meshes.push_back(std::move(mesh));
  }
  set_thread_count(0);
  EXPECT_NE(meshes[0].vertices, truth.vertices);
  EXPECT_EQ(meshes[0].vertices, meshes[1].vertices);
  EXPECT_EQ(meshes[0].vertices, meshes[2].vertices);
}

TEST(SharpenMesh, LeavesTheMeshWhenCancelled) {
  const TriangleMesh truth = plate();
  TriangleMesh mesh = truth;
  RunContext context;
  context.cancel();
  const auto result = sharpen_mesh(mesh, filtered_views(), 0.3, scale(), context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(mesh.vertices, truth.vertices);
}

/// A wavy wall on a platter that turns by `turn` from view to view, with noise that was averaged
/// over neighbours along the rows.
std::vector<views::DepthView> noisy_views(double share, double sigma_m, double turn) {
  std::vector<views::DepthView> views;
  for (int v = 0; v < 6; ++v) {
    views::DepthView view = camera(turn * v);
    const auto noise = [&](int x, int y) {
      return sigma_m *
             standard_normal(hash_key(1, std::uint64_t(v), std::uint64_t(x + 5), std::uint64_t(y)));
    };
    for (int y = 1; y < 59; ++y) {
      for (int x = 1; x < 79; ++x) {
        const double wave = 0.004 * std::sin(0.2 * x + 30.0 * turn * v) * std::cos(0.15 * y);
        const double z = 0.5 + wave + share * noise(x - 1, y) + (1.0 - 2.0 * share) * noise(x, y) +
                         share * noise(x + 1, y);
        view.pixels[std::size_t(80 * y + x)] =
            views::DepthView::pack(std::uint32_t(std::lround(z * 1e4)), false, 0);
      }
    }
    views.push_back(std::move(view));
  }
  return views;
}

/// A ball of 40 mm with waves of 1.5 mm.
TriangleMesh wavy_ball() {
  TriangleMesh mesh;
  constexpr std::uint32_t columns = 120, rows = 60;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double a = kTurn * i / columns, b = 0.5 * kTurn * (double(j) / rows - 0.5);
      const double r = 0.04 + 0.0015 * std::sin(5.0 * a) * std::cos(6.0 * b);
      mesh.vertices.push_back(
          (r * Vec3d(std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a)))
              .cast<float>());
      if (j == 0) continue;
      const std::uint32_t right = (i + 1) % columns, low = (j - 1) * columns, up = j * columns;
      mesh.triangles.push_back({low + i, low + right, up + right});
      mesh.triangles.push_back({low + i, up + right, up + i});
    }
  }
  return mesh;
}

/// The ball from all sides, with noise that was averaged over neighbours along the rows.
std::vector<views::DepthView> noisy_views_of(const TriangleMesh& mesh, double share,
                                             double sigma_m) {
  std::vector<views::DepthView> views;
  for (int v = 0; v < 24; ++v) {
    views::DepthView view = camera(0.26 * v);
    const views::ViewDrawing drawing(view, mesh);
    const auto noise = [&](int x, int y) {
      return sigma_m *
             standard_normal(hash_key(2, std::uint64_t(v), std::uint64_t(x + 5), std::uint64_t(y)));
    };
    for (int y = 1; y < 59; ++y) {
      for (int x = 1; x < 79; ++x) {
        const auto received = drawing.received(x, y);
        if (!(received.light > 0.0f)) continue;
        const double z = double(received.mean()) + share * noise(x - 1, y) +
                         (1.0 - 2.0 * share) * noise(x, y) + share * noise(x + 1, y);
        view.pixels[std::size_t(80 * y + x)] =
            views::DepthView::pack(std::uint32_t(std::lround(z * 1e4)), false, 0);
      }
    }
    views.push_back(std::move(view));
  }
  return views;
}

TEST(ShareOfNeighbours, IsThatOfTheFilter) {
  const auto found = [](double share, double sigma_m) {
    return estimation::share_of_neighbours(noisy_views(share, sigma_m, 0.005), 0.0015).value();
  };
  EXPECT_EQ(found(0.0, 0.0015), 0.0);
  EXPECT_NEAR(found(0.2, 0.003), 0.2, 0.03);
  EXPECT_NEAR(found(0.25, 0.003), 0.25, 0.03);
  EXPECT_NEAR(found(1.0 / 3.0, 0.003), 1.0 / 3.0, 0.03);
}

TEST(ShareOfNeighbours, IsThatOfTheFilterWhereEveryViewIsFromAnotherSide) {
  const TriangleMesh ball = wavy_ball();
  TriangleMesh rough = ball;  // as noise leaves it
  for (std::size_t v = 0; v < rough.vertices.size(); ++v)
    rough.vertices[v] *= 1.0f + 0.005f * float(standard_normal(hash_key(3, v)));
  for (const TriangleMesh& mesh : {ball, rough}) {
    for (const double share : {0.0, 0.2, 0.25, 1.0 / 3.0}) {
      const auto views = noisy_views_of(ball, share, 0.002);
      EXPECT_FALSE(estimation::share_of_neighbours(views, 0.0015));
      EXPECT_NEAR(estimation::share_of_neighbours(views, mesh, 0.0015), share, 0.04);
    }
  }
}

TEST(ShareOfNeighbours, IsNothingOrZeroWhereNothingTells) {
  EXPECT_FALSE(estimation::share_of_neighbours({}, 0.001));
  EXPECT_EQ(estimation::share_of_neighbours({}, plate(), 0.001), 0.0);
  // Without noise.
  EXPECT_FALSE(estimation::share_of_neighbours(noisy_views(0.3, 0.0, 0.005), 3e-5));
  // What differs is the surface, which turned: a mesh may tell.
  EXPECT_FALSE(estimation::share_of_neighbours(noisy_views(0.3, 0.0001, 0.02), 3e-5));
  // The mesh is of something else, or none of it is there.
  const auto views = noisy_views_of(wavy_ball(), 0.3, 0.002);
  EXPECT_EQ(estimation::share_of_neighbours(views, plate(), 0.0015), 0.0);
  EXPECT_EQ(estimation::share_of_neighbours(views, TriangleMesh(), 0.0015), 0.0);
  // What the mesh lacks bends.
  TriangleMesh smooth = wavy_ball();
  for (Vec3f& p : smooth.vertices) p *= 0.04f / p.norm();
  EXPECT_EQ(
      estimation::share_of_neighbours(noisy_views_of(wavy_ball(), 0.0, 0.0002), smooth, 0.0015),
      0.0);
  // Rays of another kind.
  std::vector<views::DepthView> parallel = noisy_views(0.3, 0.003, 0.005);
  for (views::DepthView& view : parallel) view.parallel = true;
  EXPECT_FALSE(estimation::share_of_neighbours(parallel, 0.0015));
}

TEST(ViewDrawing, HoldsTheNearestSurfaceAndItsLight) {
  const TriangleMesh mesh = plate();
  views::DepthView view = camera(0.0);
  view.rotation.setIdentity();
  const views::ViewDrawing drawing(view, mesh);
  // The front of the plate, 2 mm thick, lies at 497 mm.
  const auto middle = drawing.received(39, 29), outside = drawing.received(2, 2);
  EXPECT_NEAR(middle.mean(), 0.499f, 1e-5f);
  EXPECT_NEAR(middle.light, 9.0f / (0.499f * 0.499f), 0.1f);
  EXPECT_EQ(outside.light, 0.0f);
  // Half of a pixel's samples at the edge, 30 mm from the middle: 18.7 pixels.
  double lit = 0.0;
  for (int x = 40; x < 70; ++x) lit += double(drawing.received(x, 29).light / middle.light);
  EXPECT_NEAR(lit, 30.0 / 499.0 * 310.0, 0.4);
}

}  // namespace
}  // namespace turnscan::mesh_refinement
