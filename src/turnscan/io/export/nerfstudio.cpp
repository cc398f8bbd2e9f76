// nerfstudio's transforms.json (docs.nerf.studio, "Data conventions"): poses are camera to world
// with the axes of OpenGL (x right, y up, z backward), the world has +z up, and the centre of the
// top left pixel is at 0.5, 0.5.

#include <nlohmann/json.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/export/description_writers.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::exporters {

namespace fs = std::filesystem;
using text::OrderedJson;

namespace {

/// From y up to z up.
Pose z_up() {
  Pose out = Pose::Identity();
  out.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return out;
}

void put_nerfstudio_camera(const CameraIntrinsics& c, OrderedJson& out) {
  out["fl_x"] = c.fx;
  out["fl_y"] = c.fy;
  out["cx"] = c.cx + 0.5;
  out["cy"] = c.cy + 0.5;
  out["w"] = c.width;
  out["h"] = c.height;
  if (!c.distorted()) return;
  constexpr std::array<const char*, 5> kNames{"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t i = 0; i < kNames.size(); ++i) out[kNames[i]] = c.distortion[i];
}

OrderedJson nerfstudio_frame(const PosedImage& image) {
  OrderedJson out = OrderedJson::object();
  // A program that wants colour finds a file there, too.
  out["file_path"] = image.image.empty() ? image.depth : image.image;
  if (!image.depth.empty()) out["depth_file_path"] = image.depth;
  if (!image.mask.empty()) out["mask_path"] = image.mask;
  Pose T_world_gl = z_up() * image.T_world_camera;
  T_world_gl.linear().rightCols<2>() *= -1.0;
  out["transform_matrix"] = text::json_of(T_world_gl);
  return out;
}

}  // namespace

Result<> write_nerfstudio(const fs::path& folder, const std::vector<PosedImage>& images,
                          const TriangleMesh* mesh, bool depth_only) {
  OrderedJson root = OrderedJson::object();
  root["camera_model"] = "OPENCV";
  const bool one_camera = Cameras(images).list().size() == 1;
  if (one_camera) put_nerfstudio_camera(images.front().camera, root);
  for (const PosedImage& image : images)
    if (!image.depth.empty()) root["depth_unit_scale_factor"] = image.depth_unit_m;
  if (mesh != nullptr) {
    PointCloud cloud;
    for (const Vec3f& p : mesh->vertices)
      cloud.points.push_back((z_up() * p.cast<double>()).cast<float>());
    cloud.colors = mesh->colors;
    TURNSCAN_TRY(write_cloud(folder / "sparse_pc.ply", cloud));
    root["ply_file_path"] = "sparse_pc.ply";
  }
  OrderedJson frames = OrderedJson::array();
  for (const PosedImage& image : images) {
    OrderedJson frame = nerfstudio_frame(image);
    if (!one_camera) put_nerfstudio_camera(image.camera, frame);
    frames.push_back(std::move(frame));
  }
  root["frames"] = std::move(frames);
  return write_file_atomically(folder / (depth_only ? "transforms_depth.json" : "transforms.json"),
                               text::json_text(root));
}

}  // namespace turnscan::exporters
