// What noise costs beside tracing: milliseconds a frame and nanoseconds a pixel of the rectangle
// that sees anything, on one thread, for each preset and kind of noise; and the kernels alone.

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/noise/kinect_v2.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/scene/rig.hpp>

namespace {

using namespace turnscan;

/// Seconds of one call, the best of three rounds.
double seconds(int calls, const std::function<void(int)>& call) {
  double best = 1e9;
  for (int round = 0; round < 3; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) call(i);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    best = std::min(best, took.count() / calls);
  }
  return best;
}

void print(const std::string& what, double per_frame, std::size_t pixels) {
  fmt::print("{:<36} {:8.3f} ms/frame {:8.1f} ns/pixel\n", what, 1e3 * per_frame,
             1e9 * per_frame / double(std::max<std::size_t>(pixels, 1)));
}

void bench_scanner(const std::string& preset, const Scene& scene) {
  constexpr int kFrames = 10;
  const auto model = find_scanner(preset);
  if (!model) {
    fmt::print("{}\n", model.error().text());
    return;
  }
  ScannerPlacement placement;
  placement.distance_m = std::clamp(0.9, model->near_m + 0.15, model->far_m - 0.15);
  const Pose T = scanner_pose(placement, 0.09, 0.0, Vec3d::UnitY());
  const auto tracer = SampleTracer::create(*model);
  if (!tracer) return;
  SampleGrid exact;
  const auto bodies = [&](int i) { return Body{&scene, rotation_about_y(0.1 * i)}; };
  const double trace = seconds(kFrames, [&](int i) {
    const Body body = bodies(i);
    tracer->trace({&body, 1}, T, exact);
  });
  fmt::print("\n{}: {} pixels of {} x {}\n", preset, exact.size(), exact.width, exact.height);
  print("exact samples", trace, exact.size());
  for (const char* kind : {"none", "gaussian:1.5mm", "model", "physics"}) {
    const auto noise = SensorNoise::create(*model, *parse_noise_options(kind), 1, 0);
    if (!noise) continue;
    MeasuredGrid out;
    const Body body = bodies(kFrames - 1);
    const double took = seconds(kFrames, [&](int i) {
      noise->apply({*tracer, {&body, 1}, T}, exact, std::uint32_t(i), out);
    });
    print(std::string("noise ") + kind, took, exact.size());
  }
}

void bench_kernel(const char* name, InstructionSet set) {
  const noise::NoiseKernel* kernel = noise::NoiseKernels::find(set);
  if (kernel == nullptr) return;
  constexpr int kCalls = 20;
  const kinect_v2::Layout layout{256, 160};
  const auto pixels = std::size_t(layout.width) * std::size_t(layout.height);
  const std::vector<float> half(std::size_t(layout.width), 0.8f), amplitude(half.size(), 600.0f);
  std::vector<float> normals(half.size());
  kinect_v2::Light light;
  light.reset(layout);
  kinect_v2::Raw raw;
  kinect_v2::Workspace work;
  kinect_v2::Decoded decoded;
  const kinect_v2::Rays rays{kinect_v2::Plane(layout.size(), 1.0f),
                             kinect_v2::Plane(layout.size(), 0.0f), 0.0f};
  const noise::Key key{1, 2, 3, 4};
  fmt::print("\nkernels, {}\n", name);
  print("one normal",
        seconds(kCalls,
                [&](int) {
                  for (int y = 0; y < layout.height; ++y)
                    kernel->normals(key, std::uint32_t(y) * 512u, 1, layout.width, normals.data());
                }),
        pixels);
  print("phasors",
        seconds(kCalls,
                [&](int) {
                  for (int y = 0; y < layout.height; ++y)
                    kernel->phasors(layout.width, half.data(), amplitude.data(), light.row(y));
                }),
        pixels);
  print("nine correlations",
        seconds(kCalls,
                [&](int) { kinect_v2::expose(light, NoiseModel(), key, 0, 512, raw, *kernel); }),
        pixels);
  print("decoding",
        seconds(kCalls,
                [&](int) {
                  kinect_v2::decode(raw, rays, {0.5f, 4.5f}, work, decoded, *kernel);
                }),
        pixels);
}

}  // namespace

int main() {
  const auto doll = builtin_object("doll");
  if (!doll) return 1;
  const auto scene = Scene::create({&*doll, 1}, 0.15);
  if (!scene) return 1;
  for (const std::string& preset : scanner_presets()) bench_scanner(preset, *scene);
  bench_kernel("portable", InstructionSet::kPortable);
  bench_kernel("AVX2", InstructionSet::kAvx2);
  bench_kernel("AVX-512", InstructionSet::kAvx512);
  return 0;
}
