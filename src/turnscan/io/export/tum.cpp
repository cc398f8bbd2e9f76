// A folder of the TUM RGB-D benchmark (cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats):
// poses are camera to world. Its images have one camera, which cam_K.txt states.

#include <turnscan/io/export/description_writers.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::exporters {

namespace fs = std::filesystem;

Result<> write_tum(const fs::path& folder, const std::vector<PosedImage>& images) {
  const std::vector<CameraIntrinsics> cameras = Cameras(images).list();
  if (cameras.size() > 1)
    return fail(ErrorCode::kUnsupported,
                "a TUM RGB-D folder has one camera, the recording {}; export to another layout",
                cameras.size());
  std::string depth = "# timestamp filename\n", color = depth,
              poses = "# timestamp tx ty tz qx qy qz qw\n";
  for (const PosedImage& image : images) {
    const std::string time = fmt::format("{:.6f}", image.time_s);
    const Eigen::Quaterniond q(image.T_world_camera.linear());
    const Vec3d t = image.T_world_camera.translation();
    depth += fmt::format("{} {}\n", time, image.depth);
    if (!image.image.empty()) color += fmt::format("{} {}\n", time, image.image);
    poses += fmt::format("{} {} {} {} {} {} {} {}\n", time, t.x(), t.y(), t.z(), q.x(), q.y(),
                         q.z(), q.w());
  }
  const CameraIntrinsics& c = cameras.front();
  TURNSCAN_TRY(write_file_atomically(
      folder / "cam_K.txt", fmt::format("{} 0 {}\n0 {} {}\n0 0 1\n", c.fx, c.cx, c.fy, c.cy)));
  TURNSCAN_TRY(write_file_atomically(folder / "groundtruth.txt", poses));
  TURNSCAN_TRY(write_file_atomically(folder / "rgb.txt", color));
  return write_file_atomically(folder / "depth.txt", depth);
}

}  // namespace turnscan::exporters
