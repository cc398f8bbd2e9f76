#include "tests/reconstruction/outliers/depth_frames.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <turnscan/core/random.hpp>
#include <turnscan/core/units.hpp>

#include "tests/support/shared_data.hpp"

namespace turnscan::testing {

CameraIntrinsics kinect_v2() {
  CameraIntrinsics camera;
  camera.width = 512, camera.height = 424;
  camera.fx = camera.fy = 365.5, camera.cx = 255.0, camera.cy = 207.0;
  return camera;
}

CameraIntrinsics distorted_kinect_v2() {
  CameraIntrinsics camera = kinect_v2();
  camera.distortion = {0.09, -0.27, 0.0005, -0.0003, 0.09};
  return camera;
}

FramePoints render(const CameraIntrinsics& camera, const DepthAt& depth, double depth_unit_m) {
  const RayTable rays(camera);
  SensorInfo sensor;
  sensor.intrinsics = camera;
  sensor.depth_unit_m = depth_unit_m;
  Frame frame;
  frame.depth = DepthImage(camera.width, camera.height);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const std::size_t i = std::size_t(row) * camera.width + column;
      const double z = depth(column, row, rays.x()[i], rays.y()[i]) / depth_unit_m;
      frame.depth.pixels[i] = static_cast<std::uint16_t>(std::clamp(std::round(z), 0.0, 65534.0));
    }
  }
  return *points_of(frame, sensor, rays);
}

namespace {

struct Ellipsoid {
  Vec3d center, radius;
};
const std::vector<Ellipsoid>& doll() {
  static const std::vector<Ellipsoid> parts = {{{0.0, 0.05, 0.9}, {0.072, 0.105, 0.05}},
                                               {{0.0, -0.09, 0.89}, {0.055, 0.06, 0.05}},
                                               {{-0.1, 0.0, 0.88}, {0.045, 0.014, 0.014}},
                                               {{0.1, 0.02, 0.92}, {0.045, 0.014, 0.014}}};
  return parts;
}

/// Depth of the nearest part along (x, y, 1), or 0.
double doll_depth(double x, double y) {
  double nearest = 0.0;
  for (const Ellipsoid& part : doll()) {
    const Vec3d d = Vec3d(x, y, 1.0).cwiseQuotient(part.radius);
    const Vec3d c = part.center.cwiseQuotient(part.radius);
    const double a = d.squaredNorm(), b = d.dot(c), root = b * b - a * (c.squaredNorm() - 1.0);
    if (root < 0.0) continue;
    const double z = (b - std::sqrt(root)) / a;
    if (nearest == 0.0 || z < nearest) nearest = z;
  }
  return nearest;
}

double room_depth(double x, double y) {
  const double wall = 2.2 + 0.5 * x, floor = y > 0.0 ? 0.6 / y : 1e9;
  const double side = x > 0.0 ? 1.1 / x : 1e9;
  return std::min({wall, floor, side});
}

DepthAt with_defects(const CameraIntrinsics& camera, const Defects& defects, bool room) {
  const double step = 1.0 / camera.fx;
  return [defects, room, step](int column, int row, double x, double y) {
    const std::uint64_t key = hash_key(defects.seed, std::uint64_t(column), std::uint64_t(row));
    if (uniform01(key) < defects.holes) return 0.0;
    double z = doll_depth(x, y);
    const bool edge = z > 0.0 && !(doll_depth(x - step, y) > 0.0 && doll_depth(x + step, y) > 0.0 &&
                                   doll_depth(x, y - step) > 0.0 && doll_depth(x, y + step) > 0.0);
    if (edge && uniform01(mix64(key ^ 1)) < defects.flying)
      z += defects.flying_m * uniform01(mix64(key ^ 2));
    if (z == 0.0 && room) z = room_depth(x, y);
    if (z == 0.0) return 0.0;
    return z + defects.noise_m * standard_normal(mix64(key ^ 3));
  };
}

}  // namespace

FramePoints object_frame(const CameraIntrinsics& camera, const Defects& defects) {
  return render(camera, with_defects(camera, defects, false));
}

FramePoints room_frame(const CameraIntrinsics& camera, const Defects& defects) {
  return render(camera, with_defects(camera, defects, true));
}

FramePoints shuffled(const FramePoints& frame, std::uint64_t seed) {
  std::vector<std::size_t> order(frame.cell.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [seed](std::size_t a, std::size_t b) { return hash_key(seed, a) < hash_key(seed, b); });
  FramePoints out = frame;
  for (std::size_t i = 0; i < order.size(); ++i) {
    out.cell[i] = frame.cell[order[i]];
    out.cloud.points[i] = frame.cloud.points[order[i]];
  }
  return out;
}

std::optional<std::string> data_folder() {
  const std::string folder = testing::shared_data("").string();
  if (!std::filesystem::is_directory(folder)) return std::nullopt;
  return folder;
}

namespace {

/// 16-bit grey PNG of our own data sets; empty when it cannot be read.
DepthImage read_depth(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, path.c_str())) return {};
  image.format = PNG_FORMAT_LINEAR_Y;
  DepthImage depth(static_cast<int>(image.width), static_cast<int>(image.height));
  if (!png_image_finish_read(&image, nullptr, depth.pixels.data(), 0, nullptr)) return {};
  return depth;
}

void add_depth(const std::string& path, const std::string& name, const CameraIntrinsics& camera,
               std::vector<NamedFrame>& frames) {
  Frame frame;
  frame.depth = read_depth(path);
  if (frame.depth.empty()) return;
  SensorInfo sensor;
  sensor.intrinsics = camera;
  sensor.depth_unit_m = 1e-3;
  frames.push_back({name, *points_of(frame, sensor, RayTable(camera))});
}

CameraIntrinsics pinhole(int width, int height, double f, double cx, double cy) {
  CameraIntrinsics camera;
  camera.width = width, camera.height = height;
  camera.fx = camera.fy = f, camera.cx = cx, camera.cy = cy;
  return camera;
}

}  // namespace

std::vector<NamedFrame> real_depth_frames(int stride) {
  std::vector<NamedFrame> frames;
  const std::optional<std::string> folder = data_folder();
  if (!folder) return frames;
  for (int i = 150; i < 200; i += stride) {
    const std::string name = fmt::format("kinect1_room/frame-{:06}.depth.png", i);
    add_depth(*folder + "/" + name, name, pinhole(640, 480, 585.0, 320.0, 240.0), frames);
  }
  for (int i = 0; i < 8; ++i) {
    const std::string name = fmt::format("d435_bear/depth_{}.png", i);
    add_depth(*folder + "/" + name, name, pinhole(640, 480, 617.0, 319.57, 233.06), frames);
  }
  add_depth(*folder + "/kinect2/arsandbox_depth_mm.png", "kinect2/arsandbox_depth_mm.png",
            distorted_kinect_v2(), frames);
  return frames;
}

namespace {

/// Words and numbers of a text file, in any locale.
class Words {
 public:
  explicit Words(const std::string& path) : file_(path) {}
  bool next() { return bool(file_ >> word_); }
  const std::string& word() const { return word_; }
  double number() { return next() ? parse_number(word_).value() : 0.0; }

 private:
  std::ifstream file_;
  std::string word_;
};

/// ASCII PLY with range_grid, as the Stanford scans are.
bool read_range_scan(const std::string& path, FramePoints& out) {
  Words words(path);
  std::vector<Vec3f> points;
  while (words.next() && words.word() != "end_header") {
    if (words.word() == "num_cols") out.width = int(words.number());
    if (words.word() == "num_rows") out.height = int(words.number());
    if (words.word() == "vertex") points.resize(std::size_t(words.number()));
  }
  for (Vec3f& p : points)
    for (int axis = 0; axis < 3; ++axis) p[axis] = float(words.number());
  for (int cell = 0; cell < out.width * out.height; ++cell) {
    if (words.number() == 0.0) continue;
    out.cell.push_back(cell);
    out.cloud.points.push_back(points.at(std::size_t(words.number())));
  }
  return !points.empty();
}

}  // namespace

std::vector<NamedFrame> real_range_scans() {
  std::vector<NamedFrame> scans;
  const std::optional<std::string> folder = data_folder();
  if (!folder) return scans;
  for (const char* name : {"bun000", "bun045", "bun090", "bun180", "bun270", "bun315", "chin",
                           "ear_back", "top2", "top3"}) {
    NamedFrame scan{fmt::format("stanford_bunny/{}.ply", name), {}};
    if (!read_range_scan(*folder + "/" + scan.name, scan.points)) continue;
    scan.points.viewpoint = {Vec3d::UnitZ(), true};
    scans.push_back(std::move(scan));
  }
  return scans;
}

}  // namespace turnscan::testing
