// texture_bench [MESH] [--only CASE,...] [--frames N] [--size PIXELS] [--depth-noise SIGMA]
// [--width PIXELS] [--held-out N] [--white] [--true-shape] [--pictures FOLDER]
//
// Scans a painted object with a virtual depth camera and its colour camera (1920 x 1080, noise of 2
// levels), reconstructs it with vertex colours and with a texture, and draws it anew as the colour
// camera sees it from 20 directions in which no frame was taken. PSNR and SSIM over the object,
// against the same pictures of the painted object itself, where both show it, and what kinds of
// places the squared error comes from. Cases: as-it-is; drift (exposure wanders by 20 %); misplaced
// (the colour camera's recorded place is wrong by 0.5 deg and 5 mm); late (colours come when the
// object has turned 0.1 to 0.9 deg further); gloss (a lamp is mirrored);
// lamp, albedo (six tenths of the light from one side, without and with --albedo). builtin:doll and
// meshes are 0.2 m tall; objects with a texture of their own keep it and their size, and of
// builtin:labelled-cylinder the text is read. --white: paints the object evenly, and prints how far
// its colours are from even. --true-shape: textures the object itself, not what was reconstructed.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <map>
#include <turnscan/core/median.hpp>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/turntable/rotation.hpp>

#include "bench/texture/image_likeness.hpp"
#include "bench/texture/label_reading.hpp"
#include "bench/texture/painted.hpp"
#include "bench/texture/pixel_kinds.hpp"

using namespace turnscan;

namespace {

struct Settings {
  std::string mesh = "builtin:doll", pictures, only, noise = "gaussian:1mm";
  int frames = 60;
  int size = 0, width = 1920, held_out = 20;
  bool white = false, true_shape = false;
};

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
  o.color_camera.width = settings.width;
  o.color_camera.fov_y_rad = 42.0 / 57.29578;
  o.color_camera.noise = 2.0;
  return o;
}

/// A scan in the directions that are kept back, as the true colour camera sees the objects.
Result<VirtualScan> held_out_scan(const std::vector<TriangleMesh>& objects, VirtualScanOptions o,
                                  int pictures, const Pose& T_turned_object) {
  o.motion.frames = pictures;
  o.measure.noise = "none";
  o.platter.visible = false;
  o.color_camera.noise = o.color_camera.drift = o.color_camera.white_drift = 0.0;
  o.color_camera.vignetting = o.color_camera.gloss = o.color_camera.lamp = 0.0;
  std::vector<TriangleMesh> turned = objects;
  for (TriangleMesh& mesh : turned) {
    for (Vec3f& p : mesh.vertices) p = (T_turned_object * p.cast<double>()).cast<float>();
    mesh.normals.clear();
  }
  return VirtualScan::create(std::move(turned), o);
}

std::vector<ColorImage> pictures_of(const VirtualScan& scan) {
  std::vector<ColorImage> out(scan.frames().size());
  parallel_for(out.size(), 1, [&](std::size_t i) { out[i] = scan.read(i)->color; });
  return out;
}

/// What is to be compared with.
struct Truth {
  VirtualScanOptions options;
  Pose T_turned_object;
  std::vector<ColorImage> pictures;
  std::vector<Pose> T_object_camera;
  std::vector<Image<bench::PixelKind>> kinds;
};

Result<Truth> truth_of(const Settings& settings, const TriangleMesh& object,
                       const VirtualScanOptions& base) {
  Truth truth{base, rotation_about_y(0.37 / settings.frames * 6.283185307179586), {}, {}, {}};
  TURNSCAN_ASSIGN(const VirtualScan frames_scan, VirtualScan::create({object}, base));
  std::vector<Vec3d> eyes;
  for (const Pose& T : bench::color_cameras(frames_scan, base.color_camera))
    eyes.push_back(truth.T_turned_object * T.translation());
  TURNSCAN_ASSIGN(const VirtualScan scan,
                  held_out_scan({object}, base, settings.held_out, truth.T_turned_object));
  truth.pictures = pictures_of(scan);
  for (const Pose& T : bench::color_cameras(scan, base.color_camera)) {
    truth.kinds.push_back(bench::pixel_kinds(scan, base.color_camera, T, eyes));
    truth.T_object_camera.push_back(truth.T_turned_object.inverse() * T);
  }
  return truth;
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

/// The squared error of the pixels of each kind.
class ErrorShares {
 public:
  void add(const ColorImage& a, const ColorImage& b, const std::vector<std::uint8_t>& mask,
           const Image<bench::PixelKind>& kinds) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] == 0) continue;
      const auto kind = std::size_t(kinds.pixels[i]);
      const Rgb p = a.pixels[i], q = b.pixels[i];
      for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b}) squared_[kind] += double(d * d);
      pixels_[kind] += 1.0;
    }
  }
  void print() const {
    double squared = 0.0, pixels = 0.0;
    for (std::size_t k = 1; k < squared_.size(); ++k) squared += squared_[k], pixels += pixels_[k];
    fmt::print("    error");
    const char* const names[] = {"", "rims", "unseen", "flat", "well seen"};
    for (std::size_t k = 1; k < squared_.size(); ++k)
      fmt::print("   {} {:.0f} % (of {:.1f} % of the pixels, {:.1f} dB)", names[k],
                 100.0 * squared_[k] / squared, 100.0 * pixels_[k] / pixels,
                 10.0 * std::log10(3.0 * 255.0 * 255.0 * pixels_[k] / std::max(1.0, squared_[k])));
    fmt::print("\n");
  }

 private:
  std::array<double, bench::kPixelKinds> squared_{}, pixels_{};
};

/// How far the luminances of an evenly painted object are from their median, linear light.
class Evenness {
 public:
  void add(const ColorImage& image, const std::vector<std::uint8_t>& mask,
           const Image<bench::PixelKind>& kinds) {
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (mask[i] != 0 && kinds.pixels[i] >= bench::PixelKind::kFlat)
        light_.push_back(std::pow(double(image.pixels[i].g) / 255.0, 2.2));
  }
  void print() {
    const double middle = median(light_);
    double squared = 0.0;
    for (double& value : light_) value = std::abs(value / middle - 1.0), squared += value * value;
    std::sort(light_.begin(), light_.end());
    fmt::print("    shading left: rms {:.1f} %, 95th percentile {:.1f} %\n",
               100.0 * std::sqrt(squared / double(light_.size())),
               100.0 * light_[light_.size() * 95 / 100]);
  }

 private:
  std::vector<double> light_;
};

Result<> compare(const Settings& settings, const std::string& name, const TriangleMesh& mesh,
                 const Truth& truth) {
  TURNSCAN_ASSIGN(const VirtualScan scan,
                  held_out_scan({mesh}, truth.options, settings.held_out, truth.T_turned_object));
  const auto pictures = pictures_of(scan);
  bench::Likeness all;
  ErrorShares shares;
  Evenness evenness;
  std::map<double, bench::Reading> text;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    auto mask = object_mask(truth.pictures[i]);
    const auto own = object_mask(pictures[i]);
    for (std::size_t k = 0; k < mask.size(); ++k) mask[k] &= own[k];
    all.add(bench::likeness(truth.pictures[i], pictures[i], mask));
    shares.add(truth.pictures[i], pictures[i], mask, truth.kinds[i]);
    if (settings.white) evenness.add(pictures[i], mask, truth.kinds[i]);
    if (settings.mesh == "builtin:labelled-cylinder")
      for (const auto& [height, reading] :
           bench::read_label(pictures[i], intrinsics_of(truth.options.color_camera),
                             truth.T_object_camera[i].inverse()))
        text[height].right += reading.right, text[height].all += reading.all;
    if (settings.pictures.empty() || i % 7 != 0) continue;
    const std::string file = fmt::format("{}/{}-{}.png", settings.pictures, name, i);
    TURNSCAN_TRY(write_color_png(file, cropped(pictures[i], mask)));
    TURNSCAN_TRY(write_color_png(fmt::format("{}/truth-{}.png", settings.pictures, i),
                                 cropped(truth.pictures[i], mask)));
  }
  fmt::print("  {:32} PSNR {:5.2f} dB   SSIM {:.3f}\n", name, all.psnr_db(), all.ssim());
  shares.print();
  if (settings.white) evenness.print();
  for (const auto& [height, reading] : text)
    fmt::print("    text of {:4.1f} mm: {} of {} characters read\n", height * 1e3, reading.right,
               reading.all);
  std::fflush(stdout);
  return {};
}

Result<> run_case(const Settings& settings, const std::string& name, const TriangleMesh& object,
                  const VirtualScanOptions& o, const Truth& truth, bool albedo = false) {
  if (!settings.only.empty() &&
      ("," + settings.only + ",").find("," + name + ",") == std::string::npos)
    return {};
  const auto start = std::chrono::steady_clock::now();
  TURNSCAN_ASSIGN(const VirtualScan scan, VirtualScan::create({object}, o));
  std::vector<Frame> frames(scan.frames().size());
  parallel_for(frames.size(), 1, [&](std::size_t i) { frames[i] = *scan.read(i); });
  const MemoryFrames recording(scan.header(), std::move(frames));
  const double scanned = seconds_since(start);
  ReconstructOptions options;
  options.color = true;
  TURNSCAN_ASSIGN(const Reconstruction plain, reconstruct(recording, options, {}, RunContext()));
  TriangleMesh mesh = plain.objects[0].mesh;
  if (settings.true_shape)
    mesh = object, mesh.texture.reset();
  else
    TURNSCAN_TRY(compare(settings, name + "-vertices", mesh, truth));
  TURNSCAN_ASSIGN(const FramePoses poses,
                  frame_poses(recording.header(), recording.frames(), std::nullopt));
  const auto views = texture::color_views(recording, poses.T_table_sensor, {}, std::nullopt);
  TextureOptions texture;
  texture.texture = true;
  texture.albedo = albedo;
  if (settings.size > 0) texture.size_px = settings.size;
  const std::clock_t begun = std::clock();  // of all threads
  TURNSCAN_ASSIGN(const TextureReport report,
                  texture::texture_mesh(recording, views, texture, mesh, RunContext()));
  const double textured = double(std::clock() - begun) / CLOCKS_PER_SEC;
  TURNSCAN_TRY(compare(settings, name + "-texture", mesh, truth));
  fmt::print(
      "    {} triangles, {} charts, stretch {:.2f}, {} px of {:.3f} mm, filled {:.1f} %, one "
      "view {:.1f} %, views {}, off by {:.2f} px; simulated {:.1f} s, textured {:.1f} s of "
      "processor\n",
      mesh.triangles.size(), report.charts, report.stretch, report.size_px, report.texel_m * 1e3,
      report.filled_share * 100, report.one_view_share * 100, report.views, report.disagreement_px,
      scanned, textured);
  double turned = 0.0;
  for (const double t : report.turned_rad) turned += t * t / double(report.views);
  if (turned > 0.0)
    fmt::print("    views turned by {:.3f} deg rms\n", std::sqrt(turned) * 57.29578);
  for (const auto& camera : report.cameras)
    fmt::print(
        "    camera of sensor {}: {} by {:.2f} px (deviation {:.2f}), {:.2f} mm, {:.3f} deg\n",
        camera.sensor, camera.refined ? "moved" : "left", camera.misplaced_px, camera.deviation_px,
        camera.moved_m * 1e3, camera.turned_rad * 57.29578);
  if (!settings.pictures.empty())
    TURNSCAN_TRY(write_color_png(fmt::format("{}/{}-atlas.png", settings.pictures, name),
                                 mesh.texture->image));
  return {};
}

/// Stands on the platter, with a texture.
Result<TriangleMesh> object_of(const Settings& settings) {
  TriangleMesh object;
  if (settings.mesh.starts_with("builtin:")) {
    TURNSCAN_ASSIGN(object, builtin_object(settings.mesh.substr(8)));
  } else {
    TURNSCAN_ASSIGN(object, read_mesh(settings.mesh));
  }
  ObjectPlacement placement;
  if (!has_texture(object)) placement.height_m = 0.2;
  TURNSCAN_ASSIGN(PlacedObject placed, place_object(std::move(object), placement));
  if (settings.white) {
    placed.mesh.texture.reset();
    placed.mesh.colors.assign(placed.mesh.vertices.size(), Rgb{190, 190, 190});
  } else if (!has_texture(placed.mesh)) {
    TURNSCAN_TRY(bench::paint(placed.mesh, 4096));
  }
  return std::move(placed.mesh);
}

Result<> run(const Settings& settings) {
  TURNSCAN_ASSIGN(const ScannerModel scanner, find_scanner("kinect-v2"));
  TURNSCAN_ASSIGN(const TriangleMesh object, object_of(settings));
  const VirtualScanOptions base = scan_of(settings, scanner, bounds(object.vertices).center().y());
  TURNSCAN_ASSIGN(const Truth truth, truth_of(settings, object, base));
  fmt::print("{}, {} frames\n", settings.mesh, settings.frames);
  TURNSCAN_TRY(run_case(settings, "as-it-is", object, base, truth));
  VirtualScanOptions drift = base;
  drift.color_camera.drift = 0.2;
  TURNSCAN_TRY(run_case(settings, "drift", object, drift, truth));
  VirtualScanOptions wrong = base;
  wrong.color_camera.given_turn_rad = 0.5 / 57.29578;
  wrong.color_camera.given_shift_m = 0.005;
  TURNSCAN_TRY(run_case(settings, "misplaced", object, wrong, truth));
  VirtualScanOptions late = base;
  const double s_per_deg = settings.frames / base.motion.fps / 360.0;
  late.color_camera.delay_s = 0.5 * s_per_deg;  // 20 ms at 25 deg/s
  late.color_camera.jitter_s = 0.4 * s_per_deg;
  TURNSCAN_TRY(run_case(settings, "late", object, late, truth));
  VirtualScanOptions glossy = base;
  glossy.color_camera.gloss = 0.6;
  TURNSCAN_TRY(run_case(settings, "gloss", object, glossy, truth));
  VirtualScanOptions lamp = base;
  lamp.color_camera.lamp = 0.6;
  lamp.color_camera.lamp_azimuth_rad = 60.0 / 57.29578;
  lamp.color_camera.lamp_elevation_rad = 30.0 / 57.29578;
  TURNSCAN_TRY(run_case(settings, "lamp", object, lamp, truth));
  return run_case(settings, "albedo", object, lamp, truth, true);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    const bool more = i + 1 < argc;
    if (a == "--frames" && more)
      settings.frames = std::atoi(argv[++i]);
    else if (a == "--true-shape")
      settings.true_shape = true;
    else if (a == "--white")
      settings.white = true;
    else if (a == "--only" && more)
      settings.only = argv[++i];
    else if (a == "--width" && more)
      settings.width = std::atoi(argv[++i]);
    else if (a == "--held-out" && more)
      settings.held_out = std::atoi(argv[++i]);
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
