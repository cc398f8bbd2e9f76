#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/rays/coverage.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

#include "tests/simulator/scans.hpp"
#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

using test::kPi;

constexpr double kLimit = 75.0 * kPi / 180.0;

Scene scene_of(const std::vector<TriangleMesh>& meshes, std::optional<double> platter = {}) {
  return std::move(*Scene::create(meshes, platter));
}

/// A camera at `eye` that looks at the origin.
CoverageView view_from(const Vec3d& eye) {
  CoverageView view;
  const Vec3d z = -eye.normalized(), x = z.unitOrthogonal();
  view.T_table_sensor.linear() << x, z.cross(x), z;
  view.T_table_sensor.translation() = eye;
  return view;
}

struct Samples {
  std::vector<Vec3f> points, normals;
};

Samples samples_on_sphere(double radius, int rings) {
  const TriangleMesh mesh = test::sphere_mesh(Vec3d::Zero(), 1.0, rings);
  Samples out;
  out.normals = mesh.vertices;
  for (const Vec3f& n : mesh.vertices) out.points.push_back(float(radius) * n);
  return out;
}

Samples samples_on_faces(const TriangleMesh& mesh) {
  Samples out;
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    out.points.push_back((a + b + c) / 3.0f);
    out.normals.push_back((b - a).cross(c - a).normalized());
  }
  return out;
}

std::vector<float> information_of(const Scene& scene, const std::vector<CoverageView>& views,
                                  const Samples& s, double enough = 0.0) {
  CoverageOptions options;
  options.enough = enough;
  return *view_information(scene, views, s.points, s.normals, options, RunContext());
}

/// Whether any view sees each point.
std::vector<std::uint32_t> seen_of(const Scene& scene, const std::vector<CoverageView>& views,
                                   const Samples& s) {
  std::vector<std::uint32_t> out;
  for (const float sum : information_of(scene, views, s)) out.push_back(sum > 0.0f ? 1 : 0);
  return out;
}

TEST(Coverage, OfASphereIsTheCapThatTheIncidenceAllows) {
  const double radius = 0.1, distance = 0.5;
  const Scene scene = scene_of({test::sphere_mesh(Vec3d::Zero(), radius, 200)});
  const Vec3d eye = distance * Vec3d(0.3, 0.5, -0.8).normalized();
  // Triangle of centre, point and eye: the incidence is the outer angle at the point.
  const double cap = kLimit - std::asin(radius / distance * std::sin(kLimit));
  const Samples s = samples_on_sphere(radius, 90);
  const auto counts = seen_of(scene, {view_from(eye)}, s);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double angle = std::acos(s.normals[i].cast<double>().dot(eye) / distance);
    if (std::abs(angle - cap) < 1e-3) continue;
    ASSERT_EQ(counts[i], angle < cap ? 1u : 0u) << angle;
    seen += counts[i];
  }
  EXPECT_GT(seen, 3000u);
}

TEST(Coverage, FromParallelRaysIsTheCapOfTheLimitItself) {
  const Scene scene = scene_of({test::sphere_mesh(Vec3d::Zero(), 0.1, 200)});
  CoverageView view;
  view.T_table_sensor = rotation_about_y(0.7);
  view.viewpoint = {Vec3d(0, 0, -1), true};
  const Vec3d towards = view.T_table_sensor.linear() * Vec3d(0, 0, -1);
  const Samples s = samples_on_sphere(0.1, 60);
  const auto counts = seen_of(scene, {view}, s);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double angle = std::acos(std::clamp(s.normals[i].cast<double>().dot(towards), -1.0, 1.0));
    if (std::abs(angle - kLimit) < 1e-3) continue;
    ASSERT_EQ(counts[i], angle < kLimit ? 1u : 0u);
  }
}

TEST(Coverage, LeavesOutWhatLiesInAnotherObjectsShadow) {
  const TriangleMesh wall = test::box_mesh({-0.1, -0.1, 0.0}, {0.1, 0.1, 0.01});
  const TriangleMesh ball = test::sphere_mesh({0, 0, 0.2}, 0.02, 100);
  const Scene scene = scene_of({wall, ball});
  const double eye = 0.6;
  Samples s;
  for (int i = 0; i < 100; ++i) {
    s.points.emplace_back(0.001f * float(i), 0.0f, 0.01f);
    s.normals.push_back(Vec3f::UnitZ());
  }
  const auto counts = seen_of(scene, {view_from({0, 0, eye})}, s);
  // The ball's cone of shadow, cut by the wall's plane.
  const double edge = (eye - 0.01) * std::tan(std::asin(0.02 / (eye - 0.2)));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double x = s.points[i].x();
    if (std::abs(x - edge) < 2e-4) continue;
    EXPECT_EQ(counts[i], x > edge ? 1u : 0u) << x;
  }
}

TEST(Coverage, LeavesOutWhatIsOutsideTheImage) {
  const Scene scene = scene_of({});
  CoverageView view = view_from({0, 0, 1.0});
  view.intrinsics = CameraIntrinsics{100, 50, 100.0, 100.0, 49.5, 24.5, {}};
  const Vec3d across = view.T_table_sensor.linear().col(0);
  const Vec3d down = view.T_table_sensor.linear().col(1);
  Samples s;
  for (const auto& [u, v] : {std::pair(0.49, 0.0), {0.51, 0.0}, {0.0, 0.24}, {0.0, 0.26}}) {
    s.points.push_back((u * across + v * down).cast<float>());
    s.normals.push_back(Vec3f::UnitZ());
  }
  s.points.emplace_back(0.0f, 0.0f, 1.5f);  // behind the camera
  s.normals.push_back(-Vec3f::UnitZ());
  EXPECT_EQ(seen_of(scene, {view}, s), (std::vector<std::uint32_t>{1, 0, 1, 0, 0}));
}

// On a convex object without a platter nothing hides anything: the sum is that of the incidences.
TEST(Coverage, OfAConvexObjectAddsTheSquaredCosinesOfTheFramesThatItFaces) {
  const TriangleMesh mesh = *builtin_object("cylinder");
  VirtualScanOptions o = test::plain_scan();
  o.motion.frames = 50;
  o.platter.visible = false;
  const auto scan = VirtualScan::create({mesh}, o);
  ASSERT_TRUE(scan);
  const Samples s = samples_on_faces(mesh);
  const auto sums = information_of(scan->scene(), *views_of(*scan), s);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    double expected = 0.0;
    for (std::size_t f = 0; f < 50; ++f) {
      const Vec3d way = scan->T_table_sensor(f).translation() - s.points[i].cast<double>();
      const double cosine = s.normals[i].cast<double>().dot(way.normalized());
      if (cosine > std::cos(kLimit)) expected += cosine * cosine;
    }
    ASSERT_NEAR(sums[i], expected, 1e-4);
  }
}

TEST(Coverage, StopsAtEnough) {
  const TriangleMesh mesh = *builtin_object("letter-a");
  VirtualScanOptions o = test::plain_scan();
  o.motion.frames = 37;
  const auto scan = VirtualScan::create({mesh}, o);
  ASSERT_TRUE(scan);
  const Samples s = samples_on_faces(mesh);
  const auto views = *views_of(*scan);
  const auto all = information_of(scan->scene(), views, s),
             some = information_of(scan->scene(), views, s, 2.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(some[i] >= 2.0f, all[i] >= 2.0f);
    EXPECT_LT(some[i], 3.0f);
    if (all[i] < 2.0f) {
      EXPECT_EQ(some[i], all[i]);
    }
  }
  EXPECT_GT(*std::max_element(all.begin(), all.end()), 3.0f);
}

TEST(Coverage, IsTheSameForEveryNumberOfThreads) {
  const TriangleMesh mesh = *builtin_object("cylinder");
  VirtualScanOptions o = test::plain_scan();
  o.motion.frames = 20;
  const auto scan = VirtualScan::create({mesh}, o);
  ASSERT_TRUE(scan);
  const Samples s = samples_on_faces(mesh);
  set_thread_count(1);
  const auto one = information_of(scan->scene(), *views_of(*scan), s);
  set_thread_count(4);
  const auto four = information_of(scan->scene(), *views_of(*scan), s);
  set_thread_count(0);
  EXPECT_EQ(one, four);
}

TEST(Coverage, SeesWallsDownToThePlatterButNotTheUnderside) {
  const TriangleMesh mesh = *builtin_object("cylinder");
  VirtualScanOptions o = test::plain_scan();
  o.motion.frames = 36;
  const auto scan = VirtualScan::create({mesh}, o);
  ASSERT_TRUE(scan);
  Samples s;
  s.points = {{0.04f, 0.0f, 0.0f}, {0.01f, 0.0f, 0.0f}, {0.01f, 0.16f, 0.0f}};
  s.normals = {Vec3f::UnitX(), -Vec3f::UnitY(), Vec3f::UnitY()};
  const auto seen = seen_mask(scan->scene(), *scan, s.points, s.normals, RunContext());
  ASSERT_TRUE(seen);
  // The camera stands 10 deg above the cylinder's top: that is under 75 deg from its normal only
  // for cameras above 15 deg.
  EXPECT_EQ(*seen, (std::vector<std::uint8_t>{1, 0, 0}));
}

TEST(Coverage, CanBeCancelled) {
  const TriangleMesh mesh = *builtin_object("cylinder");
  const Scene scene = scene_of({mesh});
  const Samples s = samples_on_faces(mesh);
  RunContext context;
  context.cancel();
  const std::vector<CoverageView> views{view_from({0, 0, 1})};
  const auto sums = view_information(scene, views, s.points, s.normals, {}, context);
  ASSERT_FALSE(sums);
  EXPECT_EQ(sums.error().code, ErrorCode::kCancelled);
}

TEST(Coverage, ThrowsWhenPointsAndNormalsDiffer) {
  const Scene scene = scene_of({});
  const Samples s = samples_on_sphere(1.0, 4);
  EXPECT_THROW((void)view_information(scene, {}, s.points, {}, {}, RunContext()),
               std::invalid_argument);
}

TEST(Coverage, OfNothingIsNothing) {
  const Scene scene = scene_of({});
  EXPECT_TRUE(information_of(scene, {view_from({0, 0, 1})}, {}).empty());
  const Samples s = samples_on_sphere(1.0, 4);
  for (const float sum : information_of(scene, {}, s)) EXPECT_EQ(sum, 0.0f);
}

// Six views from around see every side of a cylinder once or twice, at up to 60 degrees.
TEST(Coverage, CountsAWallAsSeenForFewFramesAndMany) {
  const TriangleMesh mesh = *builtin_object("cylinder");
  for (const int frames : {6, 36, 240}) {
    VirtualScanOptions o = test::plain_scan();
    o.motion.frames = frames;
    const auto scan = VirtualScan::create({mesh}, o);
    ASSERT_TRUE(scan);
    Samples s;
    for (int i = 0; i < 90; ++i) {
      const float angle = 0.0698132f * float(i);
      s.normals.emplace_back(std::cos(angle), 0.0f, std::sin(angle));
      s.points.push_back(0.04f * s.normals.back() + Vec3f(0.0f, 0.08f, 0.0f));
    }
    const auto seen = seen_mask(scan->scene(), *scan, s.points, s.normals, RunContext());
    ASSERT_TRUE(seen);
    EXPECT_EQ(std::count(seen->begin(), seen->end(), 1), 90) << frames;
  }
}

/// Frames with poses but without images.
class Poses : public FrameSequence {
 public:
  SequenceHeader head;
  std::vector<FrameInfo> infos;
  const SequenceHeader& header() const override { return head; }
  const std::vector<FrameInfo>& frames() const override { return infos; }
  Result<Frame> read(std::size_t) const override { return Frame(); }
};

Poses three_frames() {
  Poses poses;
  poses.head.sensors.resize(1);
  poses.infos.resize(3);
  for (std::uint32_t i = 0; i < 3; ++i) poses.infos[i].index = i;
  return poses;
}

TEST(Views, TakeTheFramesOwnPoseFirst) {
  Poses poses = three_frames();
  poses.head.sensors[0].T_table_sensor = Pose::Identity();
  for (FrameInfo& info : poses.infos) {
    info.angle_rad = 1.0;
    info.T_table_sensor = Pose(Eigen::Translation3d(1, 2, 3));
  }
  const auto views = views_of(poses);
  ASSERT_TRUE(views);
  EXPECT_TRUE((*views)[2].T_table_sensor.isApprox(Pose(Eigen::Translation3d(1, 2, 3))));
}

TEST(Views, TurnTheSensorBackByTheAngleOrTheTime) {
  Poses poses = three_frames();
  const Pose T(Eigen::Translation3d(0, 0, 1));
  poses.head.sensors[0].T_table_sensor = T;
  poses.head.turntable.emplace();
  poses.head.turntable->speed_rad_s = 0.5;
  for (std::size_t i = 0; i < 3; ++i) poses.infos[i].time_s = 10.0 + double(i);
  poses.infos[1].angle_rad = 0.3;
  const auto views = views_of(poses);
  ASSERT_TRUE(views);
  EXPECT_TRUE((*views)[0].T_table_sensor.isApprox(T));
  EXPECT_TRUE((*views)[1].T_table_sensor.isApprox(rotation_about_y(-0.3) * T));
  EXPECT_TRUE((*views)[2].T_table_sensor.isApprox(rotation_about_y(-1.0) * T));
}

TEST(Views, LeaveOutDroppedFramesAndTheFieldOfViewOfPointScanners) {
  Poses poses = three_frames();
  poses.head.sensors[0].kind = SensorKind::kPointScanner;
  for (FrameInfo& info : poses.infos) info.T_table_sensor = Pose::Identity();
  poses.infos[1].status = FrameStatus::kDropped;
  const auto views = views_of(poses);
  ASSERT_TRUE(views);
  EXPECT_EQ(views->size(), 2u);
  EXPECT_FALSE((*views)[0].intrinsics);
}

TEST(Views, FailWithoutAPoseOrAnAngle) {
  Poses poses = three_frames();
  EXPECT_EQ(views_of(poses).error().code, ErrorCode::kMissingData);
  poses.head.sensors[0].T_table_sensor = Pose::Identity();
  EXPECT_EQ(views_of(poses).error().code, ErrorCode::kMissingData);
  poses.infos[0].sensor = 7;
  EXPECT_EQ(views_of(poses).error().code, ErrorCode::kFormat);
}

}  // namespace
}  // namespace turnscan
