// The picture of docs/reference/noise.md: what a Kinect v2 measures of the doll, minus what it
// ought to.

#include <fmt/core.h>

#include <algorithm>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/scene/rig.hpp>

namespace {

using namespace turnscan;

constexpr int kZoom = 3;
constexpr float kWhite_m = 0.008f;  // grey is 0, white this much too far, black too near

Rgb shade(const SampleGrid& exact, const MeasuredGrid& measured, std::size_t i) {
  constexpr Rgb kNone{24, 26, 32}, kFlying{255, 170, 0}, kHalo{200, 60, 200}, kLost{220, 50, 50},
      kShadow{40, 80, 190};
  if (!(measured.z[i] > 0.0f)) {
    if (exact.miss[i] == Miss::kEmitterBlocked) return kShadow;
    return exact.counts(i) ? kLost : kNone;
  }
  if (!exact.counts(i)) return kHalo;
  const float off = (measured.z[i] - exact.z[i]) / kWhite_m;
  if (std::abs(off) > 1.0f) return kFlying;
  const auto grey = static_cast<std::uint8_t>(127.5f + 127.0f * off);
  return {grey, grey, grey};
}

void paint(const SampleGrid& exact, const MeasuredGrid& measured, int left, ColorImage& out) {
  const PixelRect& r = exact.rect;
  for (int y = 0; y < kZoom * r.height(); ++y)
    for (int x = 0; x < kZoom * r.width(); ++x)
      out.at(left + x, y) =
          shade(exact, measured, exact.index(r.left + x / kZoom, r.top + y / kZoom));
}

Result<> draw(const char* file) {
  TURNSCAN_ASSIGN(const TriangleMesh doll, builtin_object("doll"));
  TURNSCAN_ASSIGN(const Scene scene, Scene::create({&doll, 1}, 0.15));
  TURNSCAN_ASSIGN(const ScannerModel model, find_scanner("kinect-v2"));
  TURNSCAN_ASSIGN(const SampleTracer tracer, SampleTracer::create(model));
  const Pose T = scanner_pose(ScannerPlacement(), 0.09, 0.0, Vec3d::UnitY());
  const Body body{&scene, rotation_about_y(0.3)};
  SampleGrid exact;
  tracer.trace({&body, 1}, T, exact);
  const int width = kZoom * exact.rect.width();
  ColorImage image(3 * width, kZoom * exact.rect.height());
  int left = 0;
  for (const char* kind : {"gaussian:1.5mm", "model", "physics"}) {
    TURNSCAN_ASSIGN(const NoiseOptions options, parse_noise_options(kind));
    TURNSCAN_ASSIGN(const SensorNoise noise, SensorNoise::create(model, options, 1, 0));
    MeasuredGrid measured;
    noise.apply({tracer, {&body, 1}, T}, exact, 0, measured);
    paint(exact, measured, left, image);
    left += width;
  }
  return write_color_png(file, image);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: noise_pictures FILE.png\n");
    return 2;
  }
  if (const auto done = draw(argv[1]); !done) {
    fmt::print(stderr, "noise_pictures: {}\n", done.error().text());
    return 1;
  }
  return 0;
}
