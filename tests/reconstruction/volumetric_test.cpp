#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>
#include <tests/support/memory_sequence.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/closest_point.hpp>
#include <turnscan/reconstruction/depth_window.hpp>
#include <turnscan/reconstruction/mesh_color.hpp>
#include <turnscan/reconstruction/mesh_fit.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/profiles.hpp>
#include <turnscan/reconstruction/volume.hpp>
#include <turnscan/reconstruction/volumetric.hpp>

namespace turnscan {
namespace {

using ::testing::HasSubstr;
using turnscan::testing::MemorySequence;

/// Distance along a ray (from the table frame's origin o, direction d) to what stands there, or 0.
using Trace = std::function<double(const Vec3d& o, const Vec3d& d)>;

double to_ball(const Vec3d& o, const Vec3d& d, const Vec3d& center, double radius) {
  const Vec3d m = o - center;
  const double a = d.squaredNorm(), b = m.dot(d);
  const double q = b * b - a * (m.squaredNorm() - radius * radius);
  const double t = (-b - std::sqrt(std::max(0.0, q))) / a;
  return q > 0.0 && t > 0.0 ? t : 0.0;
}

double to_box(const Vec3d& o, const Vec3d& d, const Vec3d& low, const Vec3d& high) {
  double in = 0.0, out = 1e9;
  for (int a = 0; a < 3; ++a) {
    const double p = (low[a] - o[a]) / d[a], q = (high[a] - o[a]) / d[a];
    in = std::max(in, std::min(p, q));
    out = std::min(out, std::max(p, q));
  }
  return in < out ? in : 0.0;
}

double nearer(double a, double b) { return a > 0.0 && (b == 0.0 || a < b) ? a : b; }

struct Rig {
  int frames = 24;
  double noise_m = 0.0005;
  double flying = 0.0;  ///< share of silhouette pixels that are moved back by up to 80 mm
  double dropped = 0.0;
  std::uint64_t seed = 1;
  bool platter = true;
};

/// Depth images, 160 x 120, of things on a turning platter, from 0.6 m away and 25 degrees up.
MemorySequence scan(const Trace& things, const Rig& rig) {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.intrinsics.width = 160, sensor.intrinsics.height = 120;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 260.0;
  sensor.intrinsics.cx = 79.5, sensor.intrinsics.cy = 59.5;
  const double up = 25.0 * std::numbers::pi / 180.0;
  const Vec3d aim(0, 0.04, 0);
  const Vec3d eye = aim + 0.6 * Vec3d(0, std::sin(up), -std::cos(up));
  const Vec3d z = (aim - eye).normalized(), x = z.cross(Vec3d::UnitY()).normalized();
  Pose pose = Pose::Identity();
  pose.linear().col(0) = x;
  pose.linear().col(1) = z.cross(x);
  pose.linear().col(2) = z;
  pose.translation() = eye;
  sensor.T_table_sensor = pose;
  sequence.header_value.sensors = {sensor};
  TurntableInfo table;
  table.axis = pose.linear().transpose() * Vec3d::UnitY();
  table.center_m = pose.inverse() * Vec3d::Zero();
  table.radius_m = 0.12;
  sequence.header_value.turntable = table;
  for (std::uint32_t f = 0; f < std::uint32_t(rig.frames); ++f) {
    Frame frame;
    frame.info.index = f;
    frame.info.angle_rad = 2.0 * std::numbers::pi * f / rig.frames;
    if (uniform01(hash_key(rig.seed, f, 77)) < rig.dropped)
      frame.info.status = FrameStatus::kDropped;
    const Pose view = rotation_about_y(-*frame.info.angle_rad) * pose;
    frame.depth = DepthImage(160, 120);
    std::vector<double> depth(160 * 120, 0.0);
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        const Vec3d ray = sensor.intrinsics.ray(u, v);
        const Vec3d d = view.linear() * ray;
        double t = things(view.translation(), d);
        const double floor = -view.translation().y() / d.y();
        const Vec3d hit = view.translation() + floor * d;
        if (rig.platter && floor > 0.0 && std::hypot(hit.x(), hit.z()) < 0.12) t = nearer(floor, t);
        depth[std::size_t(v * 160 + u)] = t;
      }
    }
    for (int i = 0; i < 160 * 120; ++i) {
      double t = depth[std::size_t(i)];
      if (t == 0.0) continue;
      const int u = i % 160;
      const double beside = u + 1 < 160 ? depth[std::size_t(i + 1)] : 0.0;
      const bool edge = beside == 0.0 || beside > t + 0.02;
      const std::uint64_t key = hash_key(rig.seed, f, std::uint64_t(i));
      if (edge && uniform01(hash_key(key, 1, 0)) < rig.flying)
        t += 0.08 * uniform01(hash_key(key, 2, 0));
      t += rig.noise_m * standard_normal(hash_key(key, 3, 0));
      frame.depth.pixels[std::size_t(i)] = std::uint16_t(std::lround(t * 1e4));
    }
    sequence.add(std::move(frame));
  }
  return sequence;
}

const Vec3d kCenter(0.01, 0.05, -0.005);
constexpr double kRadius = 0.03;

double ball(const Vec3d& o, const Vec3d& d) {
  // On a stand, so that it is closed below by what is seen.
  return nearer(to_ball(o, d, kCenter, kRadius), to_box(o, d, kCenter - Vec3d(0.015, 0.05, 0.015),
                                                        kCenter + Vec3d(0.015, 0, 0.015)));
}

ReconstructOptions volumetric() {
  ReconstructOptions options;
  options.surface.method = SurfaceMethod::kVolumetric;
  return options;
}

/// Closed, 2-manifold and of positive volume, told from the triangles alone: every edge runs once
/// each way, and the triangles around every vertex are one ring.
::testing::AssertionResult is_solid(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> runs;
  std::vector<std::map<std::uint32_t, std::uint32_t>> around(mesh.vertices.size());
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (++runs[{t[c], t[(c + 1) % 3]}] > 1) return ::testing::AssertionFailure() << "edge twice";
      around[t[c]][t[(c + 1) % 3]] = t[(c + 2) % 3];
    }
    volume += mesh.vertices[t[0]].cast<double>().dot(
        mesh.vertices[t[1]].cast<double>().cross(mesh.vertices[t[2]].cast<double>()));
  }
  for (const auto& [edge, count] : runs) {
    if (runs.count({edge.second, edge.first}) == 0)
      return ::testing::AssertionFailure() << "open edge";
  }
  for (const auto& next : around) {
    if (next.empty()) continue;
    std::uint32_t v = next.begin()->first;
    std::size_t steps = 0;
    do {
      v = next.at(v);
      ++steps;
    } while (v != next.begin()->first && steps <= next.size());
    if (steps != next.size()) return ::testing::AssertionFailure() << "two fans at a vertex";
  }
  if (!(volume > 0.0)) return ::testing::AssertionFailure() << "not outward";
  return ::testing::AssertionSuccess();
}

double median_error_to_ball(const TriangleMesh& mesh) {
  std::vector<double> errors;
  for (const Vec3f& v : mesh.vertices) {
    if (v.y() > kCenter.y())
      errors.push_back(std::abs((v.cast<double>() - kCenter).norm() - kRadius));
  }
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

TEST(Volumetric, IsFarBelowTheNoiseOfTheSensor) {
  const auto result = reconstruct(scan(ball, {60, 0.001}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
  EXPECT_LT(median_error_to_ball(result->objects[0].mesh), 0.00025);
}

std::vector<DepthView> views_of(const MemorySequence& sequence) {
  const SensorInfo& sensor = sequence.header().sensors[0];
  const RayTable rays(sensor.intrinsics);
  std::vector<DepthView> views;
  for (std::size_t f = 0; f < sequence.frames().size(); ++f) {
    const Pose pose = rotation_about_y(-*sequence.frames()[f].angle_rad) * *sensor.T_table_sensor;
    auto view = make_view(*sequence.read(f), sensor, rays, pose, {},
                          [&](const Vec3f& p) { return (pose * p.cast<double>()).y() > 0.005; });
    EXPECT_TRUE(view) << view.error().text();
    if (view) views.push_back(std::move(*view));
  }
  return views;
}

/// A ball of rings of quads, open at the poles.
TriangleMesh ball_mesh() {
  constexpr std::uint32_t kRings = 90, kAround = 180;
  TriangleMesh mesh;
  for (std::uint32_t r = 1; r < kRings; ++r) {
    for (std::uint32_t a = 0; a < kAround; ++a) {
      const double up = std::numbers::pi * r / kRings, turn = 2.0 * std::numbers::pi * a / kAround;
      const Vec3d n(std::sin(up) * std::cos(turn), std::cos(up), std::sin(up) * std::sin(turn));
      mesh.vertices.push_back((kCenter + kRadius * n).cast<float>());
      if (r + 1 == kRings) continue;
      const std::uint32_t v = (r - 1) * kAround + a, beside = v - a + (a + 1) % kAround;
      mesh.triangles.push_back({v, beside, v + kAround});
      mesh.triangles.push_back({beside, beside + kAround, v + kAround});
    }
  }
  return mesh;
}

/// The triangles within `rings` of the vertices, and where those are in what it gives.
TriangleMesh around(const TriangleMesh& mesh, std::vector<std::uint32_t>& vertices, int rings) {
  std::vector<bool> in(mesh.vertices.size(), false);
  for (const std::uint32_t v : vertices) in[v] = true;
  TriangleMesh out;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<bool> before = in;
    out.triangles.clear();
    for (const auto& t : mesh.triangles) {
      if (!before[t[0]] && !before[t[1]] && !before[t[2]]) continue;
      out.triangles.push_back(t);
      for (const std::uint32_t v : t) in[v] = true;
    }
  }
  std::vector<std::uint32_t> place(mesh.vertices.size(), 0);
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (!in[v]) continue;
    place[v] = std::uint32_t(out.vertices.size());
    out.vertices.push_back(mesh.vertices[v]);
  }
  for (auto& t : out.triangles) t = {place[t[0]], place[t[1]], place[t[2]]};
  for (std::uint32_t& v : vertices) v = place[v];
  return out;
}

TEST(MeshFit, LeavesOutOnlyViewsThatSeeNothingOfAPatch) {
  const std::vector<DepthView> views = views_of(scan(ball, {24, 0.001}));
  const TriangleMesh mesh = ball_mesh();
  MeshFitScale scale;
  scale.iterations = 0;
  const auto all = fit_mesh(mesh, views, scale, RunContext());
  ASSERT_TRUE(all) << all.error().text();
  double total = 0.0;
  for (std::uint32_t probe = 900; probe < 7000; probe += 611) {
    // Two places on opposite sides: no view is turned away from both.
    std::vector<std::uint32_t> places{probe, probe + 8010};
    const TriangleMesh part = around(mesh, places, 5);
    ASSERT_LT(part.vertices.size(), 256u);
    const auto alone = fit_mesh(part, views, scale, RunContext());
    ASSERT_TRUE(alone) << alone.error().text();
    EXPECT_EQ(alone->support[places[0]], all->support[probe]) << probe;
    EXPECT_EQ(alone->support[places[1]], all->support[probe + 8010]) << probe;
    total += all->support[probe] + all->support[probe + 8010];
  }
  EXPECT_GT(total, 20.0);
}

TEST(MeshFit, BringsVerticesBackToWhatWasMeasured) {
  const MemorySequence sequence = scan(ball, {60, 0.001});
  ReconstructOptions options = volumetric();
  options.volumetric.fit = false;
  auto result = reconstruct(sequence, options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  TriangleMesh mesh = result->objects[0].mesh;
  for (Vec3f& v : mesh.vertices) v += 0.0007f * (v - kCenter.cast<float>()).normalized();
  const std::vector<DepthView> views = views_of(sequence);
  MeshFitScale scale;
  scale.noise_m = 0.001;
  scale.reach_m = 0.0015;
  const auto fitted = fit_mesh(mesh, views, scale, RunContext());
  ASSERT_TRUE(fitted) << fitted.error().text();
  EXPECT_GT(median_error_to_ball(mesh), 0.0005);
  EXPECT_LT(median_error_to_ball(fitted->mesh), 0.0002);
}

TEST(MeshFit, FollowsAPlaceThatIsNoisierThanTheRest) {
  // A dark ball: its measurements scatter four times as far as the noise says.
  const std::vector<DepthView> views = views_of(scan(ball, {40, 0.004}));
  TriangleMesh mesh = ball_mesh();
  for (Vec3f& v : mesh.vertices) v += 0.005f * (v - kCenter.cast<float>()).normalized();
  MeshFitScale scale;
  scale.noise_m = 0.001;
  scale.reach_m = 0.003;
  scale.limit_m = 0.004;
  const auto fitted = fit_mesh(mesh, views, scale, RunContext());
  ASSERT_TRUE(fitted) << fitted.error().text();
  EXPECT_LT(median_error_to_ball(fitted->mesh), 0.0008);
}

TEST(MeshFit, WallsStandStraightOnThePlatter) {
  // An upright tube of rings 1 mm apart; every other vertex of the lower four stands out.
  constexpr std::uint32_t kRings = 20, kAround = 60;
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r < kRings; ++r) {
    for (std::uint32_t a = 0; a < kAround; ++a) {
      const double turn = 2.0 * std::numbers::pi * a / kAround;
      const double radius = 0.01 + (r < 4 && a % 2 == 0 ? 0.0006 : 0.0);
      mesh.vertices.push_back(
          Vec3d(radius * std::cos(turn), 0.001 * r, -radius * std::sin(turn)).cast<float>());
      if (r + 1 == kRings) continue;
      const std::uint32_t v = r * kAround + a, beside = v - a + (a + 1) % kAround;
      mesh.triangles.push_back({v, beside, v + kAround});
      mesh.triangles.push_back({beside, beside + kAround, v + kAround});
    }
  }
  MeshFitScale scale;
  scale.stiffness = 0.0;
  scale.limit_m = 0.002;
  scale.floor_height_m = 0.0035;
  const auto fitted = fit_mesh(mesh, {}, scale, RunContext());
  ASSERT_TRUE(fitted) << fitted.error().text();
  for (std::uint32_t v = 0; v < 4 * kAround; ++v) {
    const Vec3f& p = fitted->mesh.vertices[v];
    EXPECT_NEAR(std::hypot(p.x(), p.z()), 0.01, 0.0003) << v;
    EXPECT_EQ(p.y(), mesh.vertices[v].y());
  }
}

TEST(Volumetric, FlyingPixelsLeaveNothingBehind) {
  const auto result = reconstruct(scan(ball, {40, 0.001, 0.5}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  for (const Vec3f& v : result->objects[0].mesh.vertices)
    EXPECT_LT((v.cast<double>() - kCenter).norm(), 0.056);  // the stand's corners are at 0.0543
}

/// Where the surface lies on the +x axis of a ball of 15 cells of which a cap towards +x, 35
/// degrees wide, was never seen, nor what lies before it. Distances are known `inside` cells deep.
double cap_height(double inside) {
  constexpr int kBricks = 6, kHalf = 4 * kBricks;
  Volume volume;
  volume.cell_m = 1.0;
  volume.truncation_m = 3.0;
  volume.origin_m = Vec3d::Constant(-kHalf);
  volume.bricks = {kBricks, kBricks, kBricks};
  volume.slot.assign(kBricks * kBricks * kBricks, -1);
  volume.uniform.assign(volume.slot.size(), 0.0f);
  for (std::size_t b = 0; b < volume.slot.size(); ++b) volume.touch(b, 0.0f);
  const auto sample = [&](int i, int j, int k) {
    const auto slot = std::size_t(volume.slot[volume.brick_index({i / 8, j / 8, k / 8})]);
    return slot * 512 + std::size_t(i % 8 + 8 * (j % 8) + 64 * (k % 8));
  };
  for (int k = 0; k < 2 * kHalf; ++k) {
    for (int j = 0; j < 2 * kHalf; ++j) {
      for (int i = 0; i < 2 * kHalf; ++i) {
        const Vec3d p = volume.position(i, j, k);
        const double d = p.norm() - 15.0;
        const bool cap = p.x() > std::cos(35.0 * std::numbers::pi / 180.0) * p.norm();
        if (cap || d < -inside) continue;
        volume.value[sample(i, j, k)] = float(std::min(d, 3.0));
        volume.weight[sample(i, j, k)] = 1.0f;
      }
    }
  }
  VolumeScale scale;
  scale.cell_m = 1.0, scale.truncation_m = 3.0;
  close_volume(volume, scale, RunContext());
  int i = kHalf;
  while (i + 1 < 2 * kHalf && volume.value[sample(i, kHalf, kHalf)] < 0.0f) ++i;
  return volume.position(i, 0, 0).x() - 0.5;
}

TEST(Volumetric, WhatWasNotSeenNeitherSinksInNorBulges) {
  const double flat = 15.0 * std::cos(35.0 * std::numbers::pi / 180.0);
  for (const double inside : {1.0, 2.0, 3.0}) {
    EXPECT_GT(cap_height(inside), flat - 2.0) << inside;
    EXPECT_LT(cap_height(inside), 16.5) << inside;
  }
}

TEST(Volumetric, StandsFlatOnThePlatter) {
  const auto result = reconstruct(scan(ball, {}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const TriangleMesh& mesh = result->objects[0].mesh;
  EXPECT_NEAR(bounds(mesh.vertices).min.y(), 0.0, 1e-6);
  double flat = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3f &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if (std::max({a.y(), b.y(), c.y()}) < 1e-6f) flat += 0.5 * (b - a).cross(c - a).norm();
  }
  EXPECT_NEAR(flat, 0.03 * 0.03, 0.25 * 0.03 * 0.03);  // the rim is a voxel wide
  EXPECT_THAT(result->objects[0].notes, ::testing::Contains(HasSubstr("base closed")));
}

TEST(Volumetric, BothSidesOfAThinPlateSurvive) {
  for (const double thickness : {0.003, 0.005}) {  // pixels lie 2.3 mm apart
    const double half = 0.5 * thickness;
    const auto plate = [&](const Vec3d& o, const Vec3d& d) {
      return to_box(o, d, Vec3d(-0.03, 0, -half), Vec3d(0.03, 0.07, half));
    };
    const auto result = reconstruct(scan(plate, {60, 0.001}), volumetric(), {}, RunContext());
    ASSERT_TRUE(result) << result.error().text();
    double sum = 0.0;
    std::size_t n = 0;
    for (const Vec3f& v : result->objects[0].mesh.vertices) {
      if (std::abs(v.x()) > 0.022f || v.y() < 0.01f || v.y() > 0.06f) continue;
      sum += std::abs(double(v.z()));
      ++n;
    }
    ASSERT_GT(n, 100u);
    EXPECT_NEAR(2.0 * sum / double(n), thickness, 0.0005);
  }
}

TEST(Volumetric, AnArmTwoPixelsWideSurvives) {
  const auto post_with_arm = [](const Vec3d& o, const Vec3d& d) {
    return nearer(to_box(o, d, Vec3d(-0.015, 0, -0.015), Vec3d(0.015, 0.08, 0.015)),
                  to_box(o, d, Vec3d(0.015, 0.05, -0.0025), Vec3d(0.06, 0.055, 0.0025)));
  };
  const auto result = reconstruct(scan(post_with_arm, {60, 0.001}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  Box middle, whole = bounds(result->objects[0].mesh.vertices);
  for (const Vec3f& v : result->objects[0].mesh.vertices) {
    if (v.x() > 0.025f && v.x() < 0.05f) middle.add(v.cast<double>());
  }
  EXPECT_NEAR(whole.max.x(), 0.06, 0.0015);
  EXPECT_NEAR(middle.size().z(), 0.005, 0.002);  // each side within 1 mm
  EXPECT_NEAR(middle.max.y(), 0.055, 0.001);
}

/// Profiles of a line scanner whose upright sheet of light holds the axis: one every 3 degrees,
/// their points in no order.
MemorySequence line_scan(const Trace& things) {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.kind = SensorKind::kPointScanner;
  Pose pose = Pose::Identity();
  pose.linear().col(0) = -Vec3d::UnitX();
  pose.linear().col(1) = -Vec3d::UnitY();
  pose.translation() = Vec3d(0, 0.1, -0.4);
  sensor.T_table_sensor = pose;
  sequence.header_value.sensors = {sensor};
  TurntableInfo table;
  table.axis = -Vec3d::UnitY();
  table.center_m = Vec3d(0, 0.1, 0.4);
  table.radius_m = 0.12;
  sequence.header_value.turntable = table;
  for (std::uint32_t f = 0; f < 120; ++f) {
    Frame frame;
    frame.info.index = f;
    frame.info.angle_rad = 2.0 * std::numbers::pi * f / 120;
    const Pose view = rotation_about_y(-*frame.info.angle_rad) * pose;
    for (int i = 0; i < 300; ++i) {
      const Vec3d ray(0, 0.0015 * ((i * 7) % 300 - 150), 1);
      const double t = things(view.translation(), view.linear() * ray);
      if (t > 0.0) frame.points.points.push_back((t * ray).cast<float>());
    }
    sequence.add(std::move(frame));
  }
  return sequence;
}

TEST(Volumetric, MakesASolidOfTheProfilesOfALineScanner) {
  const auto result = reconstruct(line_scan(ball), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
  EXPECT_LT(median_error_to_ball(result->objects[0].mesh), 0.0001);
}

TEST(Profiles, ThatSawNothingPartTheirGroup) {
  const LightSheet sheet{Vec3d::UnitZ(), Vec3d::UnitY()};
  FramePoints line;
  for (int i = 0; i < 40; ++i) line.cloud.points.emplace_back(0.0f, 0.001f * float(i), 0.5f);
  line = in_sheet_order(line, sheet);
  const FramePoints nothing = in_sheet_order(FramePoints(), sheet);
  std::vector<Profile> group;
  for (const FramePoints& points : {line, nothing, line, line, nothing}) {
    group.push_back({points, Pose::Identity()});
    group.back().T_table_sensor.translation().x() = 0.001 * double(group.size());
  }
  const DepthView view = view_of_profiles(group, sheet, {0.01, 0.001});
  ASSERT_FALSE(view.empty());
  std::size_t between = 0;  // the pixels of the two lines beside each other, and between them
  for (const std::uint32_t word : view.pixels) between += (word & 0xffffu) != 0 ? 1 : 0;
  EXPECT_GT(between, 3u * 39u);
  EXPECT_LT(between, 6u * 80u);
  EXPECT_TRUE(view_of_profiles(std::vector<Profile>{group[1]}, sheet, {}).empty());
}

TEST(Profiles, AreToldFromRangeScans) {
  FramePoints line, plate, few;
  for (int i = 0; i < 40; ++i) {
    line.cloud.points.emplace_back(0.0f, 0.01f * float(i), 0.5f + 0.02f * float(i % 3));
    // A plate in a plane that does not hold the viewpoint.
    plate.cloud.points.emplace_back(0.01f * float(i % 6), 0.01f * float(i / 6), 0.5f);
  }
  few.cloud.points.assign(line.cloud.points.begin(), line.cloud.points.begin() + 9);
  const auto sheet = find_sheet(line);
  ASSERT_TRUE(sheet);
  EXPECT_NEAR(std::abs(sheet->across.x()), 0.0, 1e-6);
  EXPECT_FALSE(find_sheet(plate));
  EXPECT_FALSE(find_sheet(few));
}

TEST(Profiles, AreOrderedAlongTheLineWithGapsInTheirCells) {
  FramePoints line;
  for (const int i : {3, 0, 12, 1, 2, 11, 13, 10, 4, 5})
    line.cloud.points.emplace_back(0.0f, 0.001f * float(i), 0.5f);
  const FramePoints row = in_sheet_order(line, {Vec3d::UnitZ(), Vec3d::UnitY()});
  for (std::size_t i = 1; i < row.cloud.size(); ++i)
    EXPECT_GT(row.cloud.points[i].y(), row.cloud.points[i - 1].y());
  EXPECT_EQ(row.cell, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 7, 8, 9, 10}));
}

TEST(Profiles, AreGroupedWhileTheyAreSeenFromNearlyTheSamePlace) {
  ProfileGroups groups;
  std::vector<std::size_t> sizes;
  for (int i = 0; i < 40; ++i) {
    Profile profile;
    profile.points.cloud.points = {Vec3f(0, 0, 0.4f)};
    profile.T_table_sensor = rotation_about_y(i * std::numbers::pi / 180.0);
    profile.T_table_sensor.translate(Vec3d(0, 0, -0.4));
    const auto done = groups.add(profile);
    if (!done.empty()) sizes.push_back(done.size());
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{9, 9, 9, 9}));  // of 1 degree each, one shared
  EXPECT_EQ(groups.flush().size(), 8u);
  EXPECT_TRUE(groups.flush().empty());
}

TEST(Volumetric, WhatHangsInTheAirBelongsToWhatStandsBelow) {
  const auto with_balloon = [](const Vec3d& o, const Vec3d& d) {
    return nearer(ball(o, d), to_ball(o, d, Vec3d(0.06, 0.08, 0.0), 0.015));
  };
  const auto result = reconstruct(scan(with_balloon, {}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  ASSERT_EQ(result->objects.size(), 1u);
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
  EXPECT_EQ(result->objects[0].check.components, 2u);
  EXPECT_THAT(result->objects[0].notes, ::testing::Contains(HasSubstr("hangs in the air")));
}

TEST(Volumetric, IsSolidWhateverWasRecorded) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const auto random = [&](int k) { return uniform01(hash_key(seed, std::uint64_t(k), 5)); };
    std::vector<std::pair<Vec3d, double>> balls;
    for (int b = 0; b < 1 + int(4 * random(0)); ++b)
      balls.emplace_back(Vec3d(0.1 * random(10 + b) - 0.05, 0.01 + 0.05 * random(20 + b),
                               0.1 * random(30 + b) - 0.05),
                         0.006 + 0.025 * random(40 + b));
    const auto things = [&](const Vec3d& o, const Vec3d& d) {
      double t = 0.0;
      for (const auto& [center, radius] : balls) t = nearer(to_ball(o, d, center, radius), t);
      return t;
    };
    const Rig rig{2 + int(20 * random(1)), 0.002 * random(2), random(3), 0.5 * random(4), seed,
                  random(5) < 0.7};
    const auto result = reconstruct(scan(things, rig), volumetric(), {}, RunContext());
    if (!result) {
      EXPECT_EQ(result.error().code, ErrorCode::kTooFewPoints) << result.error().text();
      continue;
    }
    for (const ObjectResult& object : result->objects)
      EXPECT_TRUE(is_solid(object.mesh)) << "seed " << seed;
  }
}

TEST(Volumetric, TheSameForAnyNumberOfThreads) {
  const MemorySequence sequence = scan(ball, {16, 0.001, 0.3});
  set_thread_count(1);
  const auto one = reconstruct(sequence, volumetric(), {}, RunContext());
  set_thread_count(3);
  const auto three = reconstruct(sequence, volumetric(), {}, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->objects[0].mesh.vertices, three->objects[0].mesh.vertices);
  EXPECT_EQ(one->objects[0].mesh.triangles, three->objects[0].mesh.triangles);
}

TEST(Volumetric, TakesAsFewTrianglesAsAskedFor) {
  ReconstructOptions options = volumetric();
  options.volumetric.triangles = 500;
  const auto result = reconstruct(scan(ball, {}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LE(result->objects[0].mesh.triangles.size(), 550u);  // mending may add a few
  EXPECT_TRUE(is_solid(result->objects[0].mesh));
}

TEST(Volumetric, MaxErrorBoundsHowFarFewerTrianglesStray) {
  const MemorySequence sequence = scan(ball, {});
  const auto full = reconstruct(sequence, volumetric(), {}, RunContext());
  ReconstructOptions options = volumetric();
  options.volumetric.max_error_m = 0.0003;
  const auto fewer = reconstruct(sequence, options, {}, RunContext());
  ASSERT_TRUE(full && fewer);
  const TriangleMesh &a = full->objects[0].mesh, &b = fewer->objects[0].mesh;
  EXPECT_LT(b.triangles.size(), a.triangles.size() / 2);
  EXPECT_TRUE(is_solid(b));
  const MeshDistance distance(b);
  double farthest = 0.0;
  for (const Vec3f& v : a.vertices)
    farthest = std::max(farthest, distance.closest(v.cast<double>()).distance);
  EXPECT_LE(farthest, 0.0003);
  // Whichever ends sooner.
  options.volumetric.triangles = int(a.triangles.size() / 2);
  const auto both = reconstruct(sequence, options, {}, RunContext());
  EXPECT_GT(both->objects[0].mesh.triangles.size(), b.triangles.size());
}

/// The ball's frames with images in which it is red on the side of +x (in the table frame) and
/// green on the other.
MemorySequence two_colors(const Rig& rig) {
  MemorySequence sequence = scan(ball, rig);
  const SensorInfo& sensor = sequence.header().sensors[0];
  for (Frame& frame : sequence.data) {
    const Pose pose = rotation_about_y(-*frame.info.angle_rad) * *sensor.T_table_sensor;
    frame.color = ColorImage(160, 120);
    for (int i = 0; i < 160 * 120; ++i) {
      const double z = frame.depth.pixels[std::size_t(i)] * 1e-4;
      const Vec3d p = pose * Vec3d(z * sensor.intrinsics.ray(i % 160, i / 160));
      frame.color.pixels[std::size_t(i)] =
          p.x() > kCenter.x() ? Rgb{200, 20, 10} : Rgb{10, 180, 20};
    }
  }
  return sequence;
}

TEST(Volumetric, CarriesTheColoursOfTheFrames) {
  ReconstructOptions options = volumetric();
  options.color = true;
  const auto result = reconstruct(two_colors({}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const TriangleMesh& mesh = result->objects[0].mesh;
  ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
  std::size_t right = 0, looked = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const double x = double(mesh.vertices[v].x()) - kCenter.x();
    if (std::abs(x) < 0.003) continue;
    ++looked;
    right += (mesh.colors[v].r > mesh.colors[v].g) == (x > 0.0) ? 1 : 0;
  }
  EXPECT_GT(double(right), 0.98 * double(looked));
  const auto plain = reconstruct(two_colors({}), volumetric(), {}, RunContext());
  EXPECT_TRUE(plain->objects[0].mesh.colors.empty());
  EXPECT_EQ(plain->objects[0].mesh.vertices, mesh.vertices);
}

TEST(Volumetric, SaysThatARecordingHasNoColour) {
  ReconstructOptions options = volumetric();
  options.color = true;
  const auto result = reconstruct(scan(ball, {}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_TRUE(result->objects[0].mesh.colors.empty());
  EXPECT_THAT(result->objects[0].notes, ::testing::Contains(HasSubstr("no colour")));
}

TEST(Volumetric, ConfidenceIsLowWhereNothingWasMeasured) {
  const auto result = reconstruct(scan(ball, {}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const ObjectResult& object = result->objects[0];
  ASSERT_EQ(object.confidence.size(), object.mesh.vertices.size());
  double top = 0.0, base = 0.0;
  std::size_t at_top = 0, at_base = 0;
  for (std::size_t v = 0; v < object.confidence.size(); ++v) {
    EXPECT_GE(object.confidence[v], 0.0f);
    EXPECT_LE(object.confidence[v], 1.0f);
    const double y = object.mesh.vertices[v].y();
    if (y > kCenter.y() + 0.01) top += double(object.confidence[v]), ++at_top;
    if (y < 1e-5) base += double(object.confidence[v]), ++at_base;
  }
  ASSERT_GT(at_base, 0u);
  EXPECT_GT(top / double(at_top), 0.5);
  EXPECT_EQ(base, 0.0);
}

TEST(Volumetric, MarksWhatItInvented) {
  ReconstructOptions options = volumetric();
  options.volumetric.mark_invented = true;
  // A ball that floats: from above its underside is not seen.
  const auto floating = [](const Vec3d& o, const Vec3d& d) {
    return to_ball(o, d, kCenter, kRadius);
  };
  const auto result = reconstruct(scan(floating, {}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  const ObjectResult& object = result->objects[0];
  ASSERT_EQ(object.mesh.colors.size(), object.mesh.vertices.size());
  double area = 0.0;
  for (const auto& t : object.mesh.triangles) {
    const auto& p = object.mesh.vertices;
    if (std::all_of(t.begin(), t.end(),
                    [&](std::uint32_t v) { return object.mesh.colors[v] == kInventedColor; }))
      area += 0.5 * double((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm());
  }
  EXPECT_GT(object.invented_area_m2, 1e-4);
  EXPECT_GE(area, 0.999 * object.invented_area_m2);
  EXPECT_LT(area, 1.3 * object.invented_area_m2);
}

TEST(Volumetric, KeepsAsManyObjectsAsAskedFor) {
  const auto pair = [](const Vec3d& o, const Vec3d& d) {
    return nearer(to_ball(o, d, Vec3d(-0.05, 0.025, 0), 0.025),
                  to_ball(o, d, Vec3d(0.05, 0.02, 0), 0.02));
  };
  ReconstructOptions options = volumetric();
  EXPECT_EQ(reconstruct(scan(pair, {}), options, {}, RunContext())->objects.size(), 2u);
  options.components.keep = "largest";
  const auto one = reconstruct(scan(pair, {}), options, {}, RunContext());
  ASSERT_EQ(one->objects.size(), 1u);
  EXPECT_LT(bounds(one->objects[0].mesh.vertices).center().x(), 0.0);
}

TEST(Volumetric, RefusesWhatItCannotDo) {
  const auto nothing = [](const Vec3d&, const Vec3d&) { return 0.0; };
  EXPECT_EQ(reconstruct(scan(nothing, {}), volumetric(), {}, RunContext()).error().code,
            ErrorCode::kTooFewPoints);
  RunContext cancelled;
  cancelled.cancel();
  EXPECT_EQ(reconstruct(scan(ball, {}), volumetric(), {}, cancelled).error().code,
            ErrorCode::kCancelled);
}

TEST(Volumetric, FewViewsGetLargerSamplesAndALongerReach) {
  VolumetricInput input;
  input.noise_m = 0.0005, input.spacing_m = 0.0006;
  const Box box{Vec3d::Zero(), Vec3d::Constant(0.12)};
  const auto scale = [&](std::size_t views) {
    input.views.resize(views);
    return choose_scale(input, {}, box).volume;
  };
  const VolumeScale few = scale(8), more = scale(20), many = scale(24);
  EXPECT_GT(few.cell_m, more.cell_m);
  EXPECT_GT(more.cell_m, many.cell_m);
  EXPECT_GT(few.truncation_m, more.truncation_m);
  EXPECT_GT(more.truncation_m, many.truncation_m);
  EXPECT_DOUBLE_EQ(many.cell_m, scale(900).cell_m);
  EXPECT_DOUBLE_EQ(many.truncation_m, 3.0 * input.noise_m);
  input.cell_m = 0.0004;
  EXPECT_DOUBLE_EQ(scale(8).cell_m, 0.0004);
}

TEST(Volumetric, OptionsOutsideTheirRangesAreNamed) {
  for (const char* name : {"truncation", "fit-reach", "fit-iterations", "triangles", "max-error"}) {
    VolumetricOptions options;
    const auto wrong = describe(options).set(name, "-1");
    const auto checked = wrong ? describe(options).check() : wrong;
    ASSERT_FALSE(checked) << name;
    EXPECT_THAT(checked.error().message, HasSubstr(name));
  }
}

TEST(DepthView, PacksDepthEdgeAndWhatIsClear) {
  const std::uint32_t word = DepthView::pack(9001, true, 8000);
  EXPECT_EQ(word & 0xffffu, 9001u);
  EXPECT_NE(word & DepthView::kEdge, 0u);
  EXPECT_EQ(word >> 17 << 1, 8000u);
}

TEST(DepthView, SeesPastNothingThatANeighbourTwoPixelsAwaySaw) {
  RawWindow raw(9, 9);
  for (auto& depth : raw.pixels) depth = kOutsideCrop;
  raw.at(4, 4) = 9000;
  raw.at(0, 0) = kNoReturn;
  DepthView view;
  pack_window(raw, 0.01, view);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const std::uint32_t clear = view.pixels[std::size_t(11 * (y + 1) + x + 1)] >> 17 << 1;
      const bool near = std::abs(x - 4) <= 2 && std::abs(y - 4) <= 2;
      EXPECT_EQ(clear, x + y == 0 ? 0u : near ? 9000u : 65534u) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace turnscan
