// texture_bench [MESH] [--only CASE] [--frames N] [--size PIXELS] [--depth-noise SIGMA] [--pictures
// FOLDER]
//
// Scans a painted object with a virtual depth camera and its colour camera (1920 x 1080, noise of 2
// levels), reconstructs it with vertex colours and with a texture, and draws it anew as the colour
// camera sees it from 20 directions in which no frame was taken. PSNR and SSIM over the object,
// against the same pictures of the painted object itself, where both show it: once as it is, once
// with an exposure that drifts by 20 %, once with a colour camera whose recorded place is wrong by
// 0.5 deg and 5 mm.

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/scanner/scanner_file.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/turntable/rotation.hpp>

#include "bench/texture/image_likeness.hpp"
#include "bench/texture/painted.hpp"

using namespace turnscan;

namespace {

struct Settings {
  std::string mesh = "builtin:doll", pictures, only, noise = "gaussian:1mm";
  int frames = 60;
  int size = 0;
};

constexpr int kHeldOut = 20;

VirtualScanOptions scan_of(const Settings& settings, const ScannerModel& scanner, double aim_m) {
  VirtualScanOptions o;
  VirtualScanner one{scanner, {}};
  one.placement.aim_height_m = aim_m;
  one.placement.distance_m = 0.6;
  o.scanners = {one};
  o.motion.frames = settings.frames;
  o.motion.turns = 1.0;
  o.measure.noise = settings.noise;
  o.record.color = true;
  o.color_camera.width = 1920;
  o.color_camera.height = 1080;
  o.color_camera.fov_y_rad = 42.0 / 57.29578;
  o.color_camera.noise = 2.0;
  return o;
}

/// Pictures of an object in the directions that are kept back, as the true colour camera sees them.
Result<std::vector<ColorImage>> held_out(const std::vector<TriangleMesh>& objects,
                                         VirtualScanOptions o, double first_angle_turns) {
  o.motion.frames = kHeldOut;
  o.measure.noise = "none";
  o.platter.visible = false;
  o.color_camera.noise = o.color_camera.drift = o.color_camera.white_drift = 0.0;
  o.color_camera.vignetting = o.color_camera.gloss = o.color_camera.lamp = 0.0;
  std::vector<TriangleMesh> turned = objects;
  for (TriangleMesh& mesh : turned) {
    const Pose T = rotation_about_y(first_angle_turns * 6.283185307179586);
    for (Vec3f& p : mesh.vertices) p = (T * p.cast<double>()).cast<float>();
    mesh.normals.clear();
  }
  TURNSCAN_ASSIGN(const VirtualScan scan, VirtualScan::create(std::move(turned), o));
  std::vector<ColorImage> out(kHeldOut);
  parallel_for(out.size(), 1, [&](std::size_t i) { out[i] = scan.read(i)->color; });
  return out;
}

std::vector<std::uint8_t> object_mask(const ColorImage& image) {
  std::vector<std::uint8_t> out(image.pixels.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = image.pixels[i] == Rgb{28, 30, 34} ? 0 : 1;
  return out;
}

ColorImage cropped(const ColorImage& image, const std::vector<std::uint8_t>& mask) {
  int x0 = image.width, y0 = image.height, x1 = 0, y1 = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (mask[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] != 0)
        x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  ColorImage out(x1 - x0 + 1, y1 - y0 + 1);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) out.at(x, y) = image.at(x0 + x, y0 + y);
  return out;
}

Result<> compare(const Settings& settings, const std::string& name, const TriangleMesh& mesh,
                 const VirtualScanOptions& o, double first, const std::vector<ColorImage>& truth) {
  TURNSCAN_ASSIGN(const auto pictures, held_out({mesh}, o, first));
  bench::Likeness all;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    auto mask = object_mask(truth[i]);
    const auto own = object_mask(pictures[i]);
    for (std::size_t k = 0; k < mask.size(); ++k) mask[k] &= own[k];
    all.add(bench::likeness(truth[i], pictures[i], mask));
    if (settings.pictures.empty() || i % 7 != 0) continue;
    const std::string file = fmt::format("{}/{}-{}.png", settings.pictures, name, i);
    TURNSCAN_TRY(write_color_png(file, cropped(pictures[i], mask)));
    TURNSCAN_TRY(write_color_png(fmt::format("{}/truth-{}.png", settings.pictures, i),
                                 cropped(truth[i], mask)));
  }
  fmt::print("  {:32} PSNR {:5.2f} dB   SSIM {:.3f}\n", name, all.psnr_db(), all.ssim());
  std::fflush(stdout);
  return {};
}

Result<> run_case(const Settings& settings, const std::string& name, TriangleMesh object,
                  const VirtualScanOptions& o, const std::vector<ColorImage>& truth, double first) {
  if (!settings.only.empty() && settings.only != name) return {};
  const auto start = std::chrono::steady_clock::now();
  TURNSCAN_ASSIGN(const VirtualScan scan, VirtualScan::create({std::move(object)}, o));
  std::vector<Frame> frames(scan.frames().size());
  parallel_for(frames.size(), 1, [&](std::size_t i) { frames[i] = *scan.read(i); });
  const MemoryFrames recording(scan.header(), std::move(frames));
  const double scanned = seconds_since(start);
  ReconstructOptions options;
  options.color = true;
  TURNSCAN_ASSIGN(const Reconstruction plain, reconstruct(recording, options, {}, RunContext()));
  TriangleMesh mesh = plain.objects[0].mesh;
  TURNSCAN_TRY(compare(settings, name + "-vertices", mesh, o, first, truth));
  TURNSCAN_ASSIGN(const FramePoses poses,
                  frame_poses(recording.header(), recording.frames(), std::nullopt));
  const auto views = texture::color_views(recording, poses.T_table_sensor, {}, std::nullopt);
  TextureOptions texture;
  texture.texture = true;
  if (settings.size > 0) texture.size_px = settings.size;
  const auto begun = std::chrono::steady_clock::now();
  TURNSCAN_ASSIGN(const TextureReport report,
                  texture::texture_mesh(recording, views, texture, mesh, RunContext()));
  const double textured = seconds_since(begun);
  TURNSCAN_TRY(compare(settings, name + "-texture", mesh, o, first, truth));
  fmt::print(
      "    {} triangles, {} charts, stretch {:.2f}, {} px of {:.3f} mm, filled {:.1f} %, one "
      "view {:.1f} %, views {}, off by {:.2f} px; simulated {:.1f} s, textured {:.1f} s\n",
      mesh.triangles.size(), report.charts, report.stretch, report.size_px, report.texel_m * 1e3,
      report.filled_share * 100, report.one_view_share * 100, report.views, report.disagreement_px,
      scanned, textured);
  for (const auto& camera : report.cameras)
    fmt::print("    camera of sensor {}: {} by {:.2f} px, {:.2f} mm, {:.3f} deg\n", camera.sensor,
               camera.refined ? "moved" : "left", camera.misplaced_px, camera.moved_m * 1e3,
               camera.turned_rad * 57.29578);
  if (!settings.pictures.empty())
    TURNSCAN_TRY(write_color_png(fmt::format("{}/{}-atlas.png", settings.pictures, name),
                                 mesh.texture->image));
  return {};
}

Result<> run(const Settings& settings) {
  TURNSCAN_ASSIGN(const ScannerModel scanner, find_scanner("kinect-v2"));
  TriangleMesh object;
  if (settings.mesh.starts_with("builtin:")) {
    TURNSCAN_ASSIGN(object, builtin_object(settings.mesh.substr(8)));
  } else {
    TURNSCAN_ASSIGN(object, read_mesh(settings.mesh));
  }
  ObjectPlacement placement;
  placement.height_m = 0.2;
  TURNSCAN_ASSIGN(PlacedObject placed, place_object(std::move(object), placement));
  TURNSCAN_TRY(bench::paint(placed.mesh, 4096));
  const Box box = bounds(placed.mesh.vertices);
  const VirtualScanOptions base = scan_of(settings, scanner, box.center().y());
  const double first = 0.37 / settings.frames;
  TURNSCAN_ASSIGN(const auto truth, held_out({placed.mesh}, base, first));
  fmt::print("{}, {} frames\n", settings.mesh, settings.frames);
  TURNSCAN_TRY(run_case(settings, "as-it-is", placed.mesh, base, truth, first));
  VirtualScanOptions drift = base;
  drift.color_camera.drift = 0.2;
  TURNSCAN_TRY(run_case(settings, "drift", placed.mesh, drift, truth, first));
  VirtualScanOptions wrong = base;
  wrong.color_camera.given_turn_rad = 0.5 / 57.29578;
  wrong.color_camera.given_shift_m = 0.005;
  return run_case(settings, "misplaced", placed.mesh, wrong, truth, first);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    const bool more = i + 1 < argc;
    if (a == "--frames" && more)
      settings.frames = std::atoi(argv[++i]);
    else if (a == "--only" && more)
      settings.only = argv[++i];
    else if (a == "--size" && more)
      settings.size = std::atoi(argv[++i]);
    else if (a == "--depth-noise" && more)
      settings.noise = argv[++i];
    else if (a == "--pictures" && more)
      settings.pictures = argv[++i];
    else
      settings.mesh = a;
  }
  const auto done = run(settings);
  if (done) return 0;
  fmt::print(stderr, "{}\n", done.error().text());
  return 1;
}
