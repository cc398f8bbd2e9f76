// Frames into a volume and a mesh out of it: turnscan's stream beside Open3D's ScalableTSDFVolume,
// on the same depth images with the same poses and voxels, in turns.
//
//   volume_bench RECORDING [--voxel-size MM] [--frames N] [--rounds N] [--out PREFIX]
//                [--only turnscan]
//
// Both get the same decoded depth images, the same truncation of 5 voxels and the same threads.
// Open3D wants images of floats without the platter: making them is a line of its own, as it is
// work that turnscan's line contains. The last lines compare each program's best round.
// OMP_WAIT_POLICY=passive keeps Open3D's idle threads from counting as work.

#include <open3d/geometry/Image.h>
#include <open3d/geometry/RGBDImage.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/pipelines/integration/ScalableTSDFVolume.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <turnscan/core/parallel.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace {

using namespace turnscan;

constexpr double kTruncation = 5.0;  // voxels

struct Clock {
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();
  double processor = processor_seconds();

  static double processor_seconds() {
    struct rusage use {};
    getrusage(RUSAGE_SELF, &use);
    const auto seconds = [](const timeval& t) {
      return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
    };
    return seconds(use.ru_utime) + seconds(use.ru_stime);
  }
  double wall_seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  }
  double used() const { return processor_seconds() - processor; }
};

struct Options {
  std::string recording, out;
  bool only_ours = false;
  double voxel_m = 0.001;
  std::size_t frames = 0;
  int rounds = 3;
};

/// Of a step, in seconds.
struct Spent {
  double wall = 1e30, used = 1e30;
  void best(const Spent& other) {
    wall = std::min(wall, other.wall);
    used = std::min(used, other.used);
  }
};

Spent print(const char* name, const char* step, const Clock& clock, std::size_t frames) {
  const double wall = clock.wall_seconds(), used = clock.used();
  std::printf("%-8s %-10s %7.3f s wall, %7.3f s of processors", name, step, wall, used);
  if (frames > 0)
    std::printf(", %6.1f frames/s wall, %6.1f per processor second", double(frames) / wall,
                double(frames) / used);
  std::printf("\n");
  std::fflush(stdout);
  return {wall, used};
}

struct Input {
  SequenceHeader header;
  std::vector<Frame> frames;
  std::vector<Pose> poses;
  Cylinder cylinder;
};

/// Everything below the margin over the platter, and beside it, is taken out for Open3D.
std::shared_ptr<open3d::geometry::RGBDImage> image_of(const Frame& frame, const SensorInfo& sensor,
                                                      const RayTable& rays, const Pose& pose,
                                                      const Cylinder& cylinder) {
  auto image = std::make_shared<open3d::geometry::RGBDImage>();
  image->depth_.Prepare(frame.depth.width, frame.depth.height, 1, 4);
  auto* out = reinterpret_cast<float*>(image->depth_.data_.data());
  const SensorCrop crop(cylinder, pose);
  for (std::size_t i = 0; i < frame.depth.pixels.size(); ++i) {
    const std::uint16_t raw = frame.depth.pixels[i];
    const auto z = raw == kNoReturn || raw == kOutsideCrop
                       ? 0.0f
                       : float(raw * sensor.depth_unit_m + sensor.depth_bias_m);
    out[i] = z > 0.0f && crop.keeps(Vec3f(rays.x()[i] * z, rays.y()[i] * z, z)) ? z : 0.0f;
  }
  return image;
}

Result<Input> load(const Options& options) {
  TURNSCAN_ASSIGN(const Recording recording, Recording::open(options.recording));
  Input input;
  input.header = recording.header();
  TURNSCAN_ASSIGN(const FramePoses poses,
                  frame_poses(recording.header(), recording.frames(), std::nullopt));
  input.cylinder.margin_m = 0.003;
  if (input.header.turntable && input.header.turntable->radius_m)
    input.cylinder.radius_m = *input.header.turntable->radius_m;
  const std::size_t n = options.frames == 0 ? recording.frames().size()
                                            : std::min(options.frames, recording.frames().size());
  for (std::size_t i = 0; i < n; ++i) {
    TURNSCAN_ASSIGN(Frame frame, recording.read(i));
    input.poses.push_back(poses.T_table_sensor[i]);
    input.frames.push_back(std::move(frame));
  }
  return input;
}

Result<Spent> run_ours(const Input& input, const Options& options, bool write) {
  ReconstructOptions how;
  how.surface.method = SurfaceMethod::kVolumetric;
  how.voxels.size_m = options.voxel_m;
  how.volumetric.truncation_m = kTruncation * options.voxel_m;
  TURNSCAN_ASSIGN(auto stream, ReconstructionStream::create(input.header, how));
  std::vector<FrameInfo> infos;
  for (const Frame& frame : input.frames) infos.push_back(frame.info);
  std::vector<Frame> frames = input.frames;  // handed over one by one
  const Clock clock;
  constexpr std::size_t kCall = 16;
  for (std::size_t i = 0; i < infos.size(); i += kCall) {
    const std::size_t end = std::min(infos.size(), i + kCall);
    TURNSCAN_TRY(stream.add(
        std::vector<FrameInfo>(infos.begin() + std::ptrdiff_t(i),
                               infos.begin() + std::ptrdiff_t(end)),
        [&](std::size_t k) -> Result<Frame> { return std::move(frames[i + k]); }, RunContext()));
  }
  const Spent spent = print("turnscan", "integrate", clock, infos.size());
  if (options.only_ours) return spent;
  const Clock preview_clock;
  TURNSCAN_ASSIGN(const TriangleMesh preview, stream.preview());
  print("turnscan", "preview", preview_clock, 0);
  const Clock finish_clock;
  TURNSCAN_ASSIGN(const Reconstruction result, stream.finish({}, RunContext()));
  print("turnscan", "finish", finish_clock, 0);
  if (write && !options.out.empty())
    TURNSCAN_TRY(write_mesh(options.out + "-turnscan.ply", result.objects.at(0).mesh));
  return spent;
}

struct SpentByOpen3d {
  Spent integrate, both;
};

Result<SpentByOpen3d> run_open3d(const Input& input, const Options& options, bool write) {
  const CameraIntrinsics& c = input.header.sensors.at(0).intrinsics;
  const open3d::camera::PinholeCameraIntrinsic camera(c.width, c.height, c.fx, c.fy, c.cx, c.cy);
  open3d::pipelines::integration::ScalableTSDFVolume volume(
      options.voxel_m, kTruncation * options.voxel_m,
      open3d::pipelines::integration::TSDFVolumeColorType::NoColor);
  const RayTable rays(c);
  const Clock both;
  std::vector<std::shared_ptr<open3d::geometry::RGBDImage>> images(input.frames.size());
  parallel_for(images.size(), 1, [&](std::size_t i) {
    images[i] =
        image_of(input.frames[i], input.header.sensors.at(0), rays, input.poses[i], input.cylinder);
  });
  print("Open3D", "convert", both, images.size());
  const Clock clock;
  for (std::size_t i = 0; i < images.size(); ++i)
    volume.Integrate(*images[i], camera, input.poses[i].inverse().matrix());
  SpentByOpen3d spent;
  spent.integrate = print("Open3D", "integrate", clock, images.size());
  spent.both = {both.wall_seconds(), both.used()};
  const Clock extract_clock;
  const auto mesh = volume.ExtractTriangleMesh();
  print("Open3D", "extract", extract_clock, 0);
  if (!write || options.out.empty()) return spent;
  TriangleMesh out;
  for (const auto& v : mesh->vertices_) out.vertices.push_back(v.cast<float>());
  for (const auto& t : mesh->triangles_)
    out.triangles.push_back({std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2])});
  TURNSCAN_TRY(write_mesh(options.out + "-open3d.ply", out));
  return spent;
}

void compare(const char* what, const Spent& ours, const Spent& theirs) {
  std::printf("%s takes %.2f times turnscan's time, %.2f times its seconds of processors\n", what,
              theirs.wall / ours.wall, theirs.used / ours.used);
}

Result<> run(const Options& options) {
  TURNSCAN_ASSIGN(const Input input, load(options));
  if (input.header.sensors.at(0).intrinsics.distorted())
    std::printf("Open3D ignores the lens's distortion here\n");
  std::printf("%zu frames, voxels of %g mm, %d threads\n", input.frames.size(),
              1e3 * options.voxel_m, thread_count());
  Spent ours;
  SpentByOpen3d theirs;
  for (int round = 0; round < options.rounds; ++round) {
    TURNSCAN_ASSIGN(const Spent own, run_ours(input, options, round == 0));
    ours.best(own);
    if (options.only_ours) continue;
    TURNSCAN_ASSIGN(const SpentByOpen3d other, run_open3d(input, options, round == 0));
    theirs.integrate.best(other.integrate);
    theirs.both.best(other.both);
  }
  if (options.only_ours) return {};
  compare("Open3D's integration", ours, theirs.integrate);
  compare("Open3D with its images made", ours, theirs.both);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const bool value = i + 1 < argc;
    if (value && std::strcmp(argv[i], "--voxel-size") == 0)
      options.voxel_m = 1e-3 * std::atof(argv[++i]);
    else if (value && std::strcmp(argv[i], "--frames") == 0)
      options.frames = std::size_t(std::atol(argv[++i]));
    else if (value && std::strcmp(argv[i], "--rounds") == 0)
      options.rounds = std::atoi(argv[++i]);
    else if (value && std::strcmp(argv[i], "--only") == 0)
      options.only_ours = std::strcmp(argv[++i], "turnscan") == 0;
    else if (value && std::strcmp(argv[i], "--out") == 0)
      options.out = argv[++i];
    else
      options.recording = argv[i];
  }
  if (auto good = run(options); !good) {
    std::fprintf(stderr, "volume_bench: %s\n", good.error().text().c_str());
    return 1;
  }
  return 0;
}
