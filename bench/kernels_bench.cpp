// What each step of the point methods costs by itself, in points and bytes a second: the doll on
// its platter, seen by a Kinect v2 (512 x 424). Rates are for a second of processor time, of all
// threads together: what one core does.

#include <benchmark/benchmark.h>

#include <turnscan/io/image/image_io.hpp>
#include <turnscan/reconstruction/points/normals.hpp>
#include <turnscan/reconstruction/points/refine.hpp>
#include <turnscan/reconstruction/poisson/poisson.hpp>
#include <turnscan/reconstruction/poisson/poisson_bricks.hpp>
#include <turnscan/reconstruction/poisson/poisson_kernel.hpp>
#include <turnscan/reconstruction/voxels/merge.hpp>
#include <turnscan/reconstruction/voxels/point_sums.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace {

using namespace turnscan;
using namespace turnscan::points;
using namespace turnscan::voxels;

constexpr std::uint32_t kFrames = 64;
constexpr double kVoxel = 0.0016, kNoise = 0.0013;

/// The steps' inputs, each made by the step before.
struct Data {
  SensorInfo sensor;
  RayTable rays;
  Pose pose;
  Cylinder cylinder;
  Frame frame;
  std::string png;
  FramePoints all, cropped;
  std::vector<FramePart> parts;
  std::vector<Viewpoint> viewpoints;
  std::size_t merged = 0;  ///< points of all parts

  std::vector<PointsSeen> seen() const {
    std::vector<PointsSeen> out;
    for (std::size_t i = 0; i < parts.size(); ++i)
      out.push_back({parts[i].cloud.points, {}, viewpoints[i]});
    return out;
  }
};

Data make() {
  SceneDescription scene;
  scene.motion.frames = kFrames;
  std::vector<TriangleMesh> objects;
  objects.push_back(builtin_object("doll").value());
  const auto scan = VirtualScan::create(std::move(objects), scan_options(scene).value()).value();
  Data d;
  d.sensor = scan.header().sensors[0];
  d.rays = RayTable(d.sensor.intrinsics);
  d.cylinder.margin_m = 0.004;
  d.cylinder.radius_m = 0.15;
  FrameRecipe recipe;
  recipe.header = &scan.header();
  recipe.rays = {d.rays};
  recipe.cylinder = d.cylinder;
  FramePoser poser(scan.header(), std::nullopt);
  for (std::uint32_t f = 0; f < kFrames; ++f) {
    const Frame frame = scan.read(f).value();
    const Pose pose = poser(frame.info).value();
    d.parts.push_back(process_frame(frame, recipe, pose).value());
    d.viewpoints.push_back(d.sensor.viewpoint.transformed(pose));
    d.merged += d.parts.back().cloud.size();
    if (f > 0) continue;
    d.frame = frame;
    d.pose = pose;
  }
  d.png = encode_depth_png(d.frame.depth).value();
  d.all = points_of(d.frame, d.sensor, d.rays).value();
  d.cropped = crop(d.all, SensorCrop(d.cylinder, d.pose));
  return d;
}

const Data& data() {
  static const Data instance = make();
  return instance;
}

/// items: points or pixels of one round; bytes: read and written.
void report(benchmark::State& state, std::size_t items, std::size_t bytes) {
  state.SetItemsProcessed(state.iterations() * std::int64_t(items));
  state.SetBytesProcessed(state.iterations() * std::int64_t(bytes));
}

std::size_t pixels() { return data().frame.depth.pixels.size(); }

void png_decode(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(decode_depth_png(data().png));
  report(state, pixels(), 2 * pixels() + data().png.size());
}

void png_encode(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(encode_depth_png(data().frame.depth));
  report(state, pixels(), 2 * pixels() + data().png.size());
}

void depth_to_points(benchmark::State& state) {
  const Data& d = data();
  for (auto _ : state) benchmark::DoNotOptimize(points_of(d.frame, d.sensor, d.rays));
  report(state, d.all.cloud.size(), 2 * pixels() + 16 * d.all.cloud.size());
}

void crop_points(benchmark::State& state) {
  const Data& d = data();
  const SensorCrop cylinder(d.cylinder, d.pose);
  for (auto _ : state) benchmark::DoNotOptimize(crop(d.all, cylinder));
  report(state, d.all.cloud.size(), 16 * (d.all.cloud.size() + d.cropped.cloud.size()));
}

void filter(benchmark::State& state) {
  const std::vector<Vec3f>& points = data().cropped.cloud.points;
  for (auto _ : state) benchmark::DoNotOptimize(outliers::statistical_outlier_mask(points, {}));
  report(state, points.size(), 13 * points.size());
}

void rotation(benchmark::State& state) {
  const Data& d = data();
  const Eigen::Matrix3f turn = d.pose.linear().cast<float>();
  const Vec3f shift = d.pose.translation().cast<float>();
  std::vector<Vec3f> out(d.cropped.cloud.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = turn * d.cropped.cloud.points[i] + shift;
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  report(state, out.size(), 24 * out.size());
}

void count(benchmark::State& state, CandidateMethod method) {
  const Data& d = data();
  CandidateOptions options;
  options.method = method;
  PointSums sums(kVoxel, options);
  const auto seen = d.seen();
  for (auto _ : state) benchmark::DoNotOptimize(sums.add(seen));
  report(state, d.merged, 40 * d.merged);  // a point, and its cell read and written
}
void count_voxels(benchmark::State& state) { count(state, CandidateMethod::kCentroid); }
void count_sub_voxels(benchmark::State& state) { count(state, CandidateMethod::kSubVoxel); }

MeasuredCells measured() {
  PointSums sums(kVoxel, {});
  const bool added = sums.add(data().seen()).has_value();
  return added ? sums.collect(1, RunContext()).value() : MeasuredCells();
}

void collect(benchmark::State& state) {
  PointSums sums(kVoxel, {});
  if (!sums.add(data().seen())) return;
  std::size_t cells = 0;
  for (auto _ : state) cells = sums.collect(1, RunContext())->size();
  report(state, cells, 56 * cells);
}

void normals(benchmark::State& state) {
  const MeasuredCells m = measured();
  Candidates candidates = find_candidates(m, m.grid, RunContext()).value();
  for (auto _ : state)
    benchmark::DoNotOptimize(estimate_normals(candidates, 2.5 * kVoxel, RunContext()));
  report(state, candidates.cloud.size(), 40 * candidates.cloud.size());
}

void refine(benchmark::State& state) {
  const MeasuredCells m = measured();
  Candidates candidates = find_candidates(m, m.grid, RunContext()).value();
  if (!estimate_normals(candidates, 2.5 * kVoxel, RunContext())) return;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        refine_candidates(m, m.grid, candidates, {kVoxel, kNoise}, 3, RunContext()));
  report(state, candidates.cloud.size(), 28 * m.size());
}

/// One product with the stiffness matrix, most of a step of the solver.
void poisson_stiffness(benchmark::State& state) {
  poisson::Block block;
  for (std::size_t i = 0; i < block.size(); ++i) block[i] = float(i % 7);
  std::array<float, poisson::kCells> out;
  for (auto _ : state) {
    poisson::stiffness(block.data(), out.data());
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  report(state, poisson::kCells, sizeof block + sizeof out);
}

void poisson_surface_of_candidates(benchmark::State& state) {
  const MeasuredCells m = measured();
  Candidates candidates = find_candidates(m, m.grid, RunContext()).value();
  if (!estimate_normals(candidates, 2.5 * kVoxel, RunContext())) return;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        poisson::poisson_surface(candidates.cloud, SurfaceOptions(), RunContext()));
  report(state, candidates.cloud.size(), 24 * candidates.cloud.size());
}

BENCHMARK(png_decode)->MeasureProcessCPUTime();
BENCHMARK(png_encode)->MeasureProcessCPUTime();
BENCHMARK(depth_to_points)->MeasureProcessCPUTime();
BENCHMARK(crop_points)->MeasureProcessCPUTime();
BENCHMARK(filter)->MeasureProcessCPUTime();
BENCHMARK(rotation)->MeasureProcessCPUTime();
BENCHMARK(count_voxels)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(count_sub_voxels)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(collect)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(normals)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(refine)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(poisson_stiffness)->MeasureProcessCPUTime();
BENCHMARK(poisson_surface_of_candidates)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  data();  // not within the first measurement
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
