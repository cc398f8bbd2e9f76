// The live crop on one core: frames a second from a raw image of 512 x 424 to the points in the
// cylinder, beside the plain way (all points, then the crop).

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/turntable/crop/crop_kernel.hpp>
#include <turnscan/turntable/crop/live_crop.hpp>

namespace {

using namespace turnscan;

struct Shot {
  SensorInfo sensor;
  Frame frame;
  Cylinder cylinder;
};

/// A doll in a room: every pixel has a return.
const Shot& shot() {
  static const Shot instance = [] {
    SceneDescription scene;
    scene.room.kind = RoomKind::kClutter;
    scene.motion.frames = 1;
    std::vector<TriangleMesh> objects;
    objects.push_back(builtin_object("doll").value());
    const auto scan = VirtualScan::create(std::move(objects), scan_options(scene).value()).value();
    TurntableInfo table;
    table.radius_m = 0.15;
    return Shot{scan.header().sensors[0], scan.read(0).value(), live_cylinder(table, {}).value()};
  }();
  return instance;
}

void points(benchmark::State& state) {
  const Shot& s = shot();
  const auto crop = LiveCrop::create(s.sensor, *s.sensor.T_table_sensor, s.cylinder).value();
  std::size_t kept = 0;
  for (auto _ : state) kept = crop.points(s.frame.depth)->cloud.size();
  state.counters["frames/s"] =
      benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["points"] = double(kept);
}

void image(benchmark::State& state) {
  const Shot& s = shot();
  const auto crop = LiveCrop::create(s.sensor, *s.sensor.T_table_sensor, s.cylinder).value();
  for (auto _ : state) benchmark::DoNotOptimize(crop.image(s.frame.depth));
  state.counters["frames/s"] =
      benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
}

void plainly(benchmark::State& state) {
  const Shot& s = shot();
  const RayTable rays(s.sensor.intrinsics);
  const SensorCrop slow(s.cylinder, *s.sensor.T_table_sensor);
  std::size_t kept = 0;
  for (auto _ : state) kept = crop(points_of(s.frame, s.sensor, rays).value(), slow).cloud.size();
  state.counters["frames/s"] =
      benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["points"] = double(kept);
}

void select(benchmark::State& state) {
  const auto* kernel = crop_kernel::CropKernels::find(static_cast<InstructionSet>(state.range(0)));
  if (kernel == nullptr) return state.SkipWithError("this machine lacks the instructions");
  const std::size_t n = 512 * 424;
  const std::vector<std::uint16_t> raw(n, 9000), first(n, 8000), count(n, 500);
  std::vector<std::uint64_t> bits(n / 64);
  for (auto _ : state) {
    kernel->select(raw.data(), first.data(), count.data(), n, bits.data());
    benchmark::ClobberMemory();
  }
  state.counters["frames/s"] =
      benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
}

void create(benchmark::State& state) {
  const Shot& s = shot();
  for (auto _ : state)
    benchmark::DoNotOptimize(LiveCrop::create(s.sensor, *s.sensor.T_table_sensor, s.cylinder));
}

BENCHMARK(points);
BENCHMARK(image);
BENCHMARK(plainly);
BENCHMARK(select)->Arg(0)->Arg(1)->Arg(2);
BENCHMARK(create)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
