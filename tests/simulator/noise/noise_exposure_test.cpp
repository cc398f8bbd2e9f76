// Motion within a frame.

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <tests/simulator/noise/noise_scenes.hpp>
#include <tests/simulator/shapes.hpp>

namespace turnscan {
namespace {

using namespace test;

ScannerModel time_of_flight() {
  ScannerModel m = camera(40, 30, 365.5);
  m.sensing = Sensing::kTimeOfFlight;
  m.far_m = 4.5;
  m.noise.physics = SensorPhysics::kKinectV2;
  m.noise.tof_read_noise = m.noise.tof_shot_noise = m.noise.tof_relative_noise = 0.0;
  return m;
}

/// A wall that is moved by `along` from moment to moment; in the middle it is where it is given.
class MovingWall {
 public:
  MovingWall(const ScannerModel& model, const TriangleMesh& mesh, const Vec3d& along)
      : model_(model),
        scene_(Scene::create(std::span(&mesh, 1)).value()),
        tracer_(SampleTracer::create(model).value()),
        moments_(kExposureMoments) {
    for (std::size_t j = 0; j < moments_.size(); ++j) {
      SensorMoment& moment = moments_[j];
      Pose T = Pose::Identity();
      T.translation() = (double(j) - 4.0) * along;
      moment.bodies = {{&scene_, T}};
      tracer_.trace(moment.bodies, pose_, moment.exact);
    }
  }

  MeasuredGrid measure(const char* kind, bool exposed = true) const {
    const auto noise = SensorNoise::create(model_, noise_of(kind), 1, 0).value();
    std::span<const SensorMoment> moments;
    if (exposed) moments = moments_;
    MeasuredGrid out;
    noise.apply({tracer_, moments_[4].bodies, pose_, nullptr, moments}, moments_[4].exact, 0, out);
    return out;
  }
  const SampleGrid& exact() const { return moments_[4].exact; }

 private:
  ScannerModel model_;
  Scene scene_;
  SampleTracer tracer_;
  std::vector<SensorMoment> moments_;
  Pose pose_ = Pose::Identity();
};

/// Half path that three phase images of each frequency give, the wall being at z[0..8] in turn.
double decoded(const std::array<double, 9>& z) {
  constexpr double kFrequency[3] = {80e6, 16e6, 120e6}, kLight = 299792458.0;
  double turns = 0.0;
  for (std::size_t f = 0; f < 3; ++f) {
    std::complex<double> sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double phase = 4.0 * std::numbers::pi * kFrequency[f] * z[3 * f + k] / kLight;
      const double step = 2.0 * std::numbers::pi * double(k) / 3.0;
      sum += std::cos(phase + step) / (z[3 * f + k] * z[3 * f + k]) *
             std::exp(std::complex<double>(0.0, -step));
    }
    const double wrapped = std::arg(sum) / (2.0 * std::numbers::pi);
    const double true_turns = 2.0 * kFrequency[f] * z[3 * f + 1] / kLight;
    turns += wrapped + std::round(true_turns - wrapped);
  }
  return turns * kLight / (2.0 * 216e6);
}

TEST(Exposure, OfASceneAtRestIsWhatAnInstantGives) {
  for (const char* kind : {"none", "gaussian:2mm", "model", "physics"}) {
    ScannerModel model = time_of_flight();
    model.noise.axial_constant_m = 1e-3;
    model.noise.tof_read_noise = 1.2;
    model.noise.footprint_px = 1.0;
    const MovingWall wall(model, half_wall(1.0, 0.0, 0.1), Vec3d::Zero());
    EXPECT_EQ(wall.measure(kind).z, wall.measure(kind, false).z) << kind;
    EXPECT_EQ(wall.measure(kind).miss, wall.measure(kind, false).miss) << kind;
  }
}

TEST(Exposure, TakesTheNinePhaseImagesOneAfterTheOther) {
  // Approaching at 2 m/s, 30 ms: an error that depends on the phase (Lindner and Kolb 2009).
  const double step = -0.06 / 9.0;
  double least = 1.0, most = -1.0;
  for (double z = 0.8; z < 1.6; z += 0.097) {
    const MovingWall wall(time_of_flight(), test::wall(z), Vec3d(0, 0, step));
    const MeasuredGrid out = wall.measure("physics");
    std::array<double, 9> there{};
    for (std::size_t j = 0; j < 9; ++j) there[j] = z + (double(j) - 4.0) * step;
    const std::size_t middle = wall.exact().index(20, 15);
    // Whole numbers and eight bits of the code remain.
    EXPECT_NEAR(out.z[middle], decoded(there), 1e-3) << z;
    EXPECT_NEAR(wall.measure("physics", false).z[middle], z, 1.5e-3) << z;
    least = std::min(least, decoded(there) - z);
    most = std::max(most, decoded(there) - z);
  }
  EXPECT_GT(most - least, 3.5e-3);
}

TEST(Exposure, BlursDepthToItsMean) {
  ScannerModel model = time_of_flight();
  for (const Sensing sensing : {Sensing::kTimeOfFlight, Sensing::kStructuredLight}) {
    model.sensing = sensing;
    // A ball that passes: the mean over the moments is not what is there in the middle.
    const MovingWall wall(model, test::sphere_mesh(Vec3d(0, 0, 1.4), 0.4, 400), Vec3d(0.004, 0, 0));
    const MeasuredGrid out = wall.measure("none");
    const std::size_t i = wall.exact().index(20, 15);
    const Vec3d d((20 - 19.5) / 365.5, (15 - 14.5) / 365.5, 1.0);
    double mean = 0.0;
    for (int j = -4; j <= 4; ++j) {
      const Vec3d c(0.004 * j, 0, 1.4);
      const double b = c.dot(d), a = d.squaredNorm();
      mean += (b - std::sqrt(b * b - a * (c.squaredNorm() - 0.16))) / a / 9.0;
    }
    EXPECT_GT(mean - wall.exact().z[i], 1e-4);
    EXPECT_NEAR(out.z[i], mean, 1e-5);
  }
}

/// A bar three pixels wide at 1 m, before a wall.
TriangleMesh bar_before_wall(double wall_z) {
  TriangleMesh mesh = test::wall(wall_z);
  const double half = 1.5 / 365.5;
  for (const auto& [x, y] : {std::pair(-half, -1.0), {half, -1.0}, {half, 1.0}, {-half, 1.0}})
    mesh.vertices.emplace_back(float(x), float(y), 1.0f);
  mesh.triangles.push_back({4, 5, 6});
  mesh.triangles.push_back({4, 6, 7});
  return mesh;
}

TEST(Exposure, LosesWhatPassesQuicklyWhereASensorMatches) {
  ScannerModel model = time_of_flight();
  model.sensing = Sensing::kStructuredLight;
  const MovingWall wall(model, bar_before_wall(1.5), Vec3d(1.0 / 365.5, 0, 0));
  const MeasuredGrid out = wall.measure("none");
  int bar = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    const bool on_bar = wall.exact().z[i] < 1.2f;
    bar += on_bar ? 1 : 0;
    // It is there for 3 moments of 9; the wall behind it for 6.
    EXPECT_EQ(out.miss[i], on_bar ? Miss::kRejected : Miss::kNone);
  }
  EXPECT_GT(bar, 60);
}

TEST(Exposure, MixesWhatPassesWhereLightAddsUp) {
  ScannerModel model = time_of_flight();
  for (const double behind : {0.03, 0.5}) {
    model.noise.mixed_rejection_m = 0.04;
    const MovingWall wall(model, bar_before_wall(1.0 + behind), Vec3d(1.0 / 365.5, 0, 0));
    const MeasuredGrid out = wall.measure("none");
    const std::size_t i = wall.exact().index(20, 15);
    ASSERT_NEAR(wall.exact().z[i], 1.0, 1e-6);
    if (behind < 0.1) {
      EXPECT_NEAR(out.z[i], 1.0 + behind * 6.0 / 9.0, 1e-5);
    } else {
      EXPECT_EQ(out.miss[i], Miss::kRejected);
    }
  }
}

}  // namespace
}  // namespace turnscan
