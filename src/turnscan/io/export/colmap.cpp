// COLMAP's text model (colmap.github.io, "Output Format"): poses are world to camera, the centre of
// the top left pixel is at 0.5, 0.5.

#include <turnscan/io/export/description_writers.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::exporters {

namespace fs = std::filesystem;

namespace {

std::string colmap_camera(const CameraIntrinsics& c, std::size_t id) {
  const auto& d = c.distortion;
  std::string out =
      fmt::format("{} {} {} {} {} {} {} {}", id, c.distorted() ? "FULL_OPENCV" : "PINHOLE", c.width,
                  c.height, c.fx, c.fy, c.cx + 0.5, c.cy + 0.5);
  if (c.distorted())
    out += fmt::format(" {} {} {} {} {} {} {} {}", d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]);
  return out + '\n';
}

std::string colmap_points(const TriangleMesh* mesh) {
  std::string out = "# POINT3D_ID X Y Z R G B ERROR TRACK[]\n";
  if (mesh == nullptr) return out;
  constexpr Rgb kGrey{128, 128, 128};
  for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
    const Vec3f& p = mesh->vertices[i];
    const Rgb c = mesh->colors.empty() ? kGrey : mesh->colors[i];
    out += fmt::format("{} {} {} {} {} {} {} 0\n", i + 1, p.x(), p.y(), p.z(), c.r, c.g, c.b);
  }
  return out;
}

}  // namespace

Result<> write_colmap(const fs::path& folder, const std::vector<PosedImage>& images,
                      const TriangleMesh* mesh, bool depth_only) {
  const fs::path model = folder / (depth_only ? "sparse_depth" : "sparse") / "0";
  TURNSCAN_TRY(make_folder(model));
  const Cameras cameras(images);
  std::string listed = "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n";
  for (const CameraIntrinsics& camera : cameras.list())
    listed += colmap_camera(camera, cameras.number_of(camera) + 1);
  std::string poses =
      "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as X Y POINT3D_ID\n";
  for (const PosedImage& image : images) {
    const Pose T_camera_world = image.T_world_camera.inverse();
    const Eigen::Quaterniond q(T_camera_world.linear());
    const Vec3d t = T_camera_world.translation();
    const std::string& file = image.image.empty() ? image.depth : image.image;
    poses += fmt::format("{} {} {} {} {} {} {} {} {} {}\n\n", image.id + 1, q.w(), q.x(), q.y(),
                         q.z(), t.x(), t.y(), t.z(), cameras.number_of(image.camera) + 1,
                         fs::path(file).filename().string());
  }
  TURNSCAN_TRY(write_file_atomically(model / "points3D.txt", colmap_points(mesh)));
  TURNSCAN_TRY(write_file_atomically(model / "images.txt", poses));
  return write_file_atomically(model / "cameras.txt", listed);
}

}  // namespace turnscan::exporters
