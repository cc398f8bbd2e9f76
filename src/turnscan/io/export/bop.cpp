// A scene of the BOP benchmark (github.com/thodan/bop_toolkit, docs/bop_datasets_format.md): poses
// are world to camera and model to camera, in millimetres.

#include <nlohmann/json.hpp>
#include <turnscan/io/export/description_writers.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::exporters {

namespace fs = std::filesystem;
using text::OrderedJson;

namespace {

constexpr double kMillimetres = 1000.0;  // per metre

void put_bop_pose(const Pose& T_camera_world, const char* name, OrderedJson& out) {
  OrderedJson rotation = OrderedJson::array(), translation = OrderedJson::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rotation.push_back(T_camera_world.linear()(row, column));
    translation.push_back(kMillimetres * T_camera_world.translation()[row]);
  }
  out[fmt::format("cam_R_{}", name)] = std::move(rotation);
  out[fmt::format("cam_t_{}", name)] = std::move(translation);
}

}  // namespace

Result<> write_bop(const fs::path& folder, const std::vector<PosedImage>& images,
                   const TriangleMesh* mesh) {
  OrderedJson cameras = OrderedJson::object(), truth = OrderedJson::object();
  for (const PosedImage& image : images) {
    const std::string key = std::to_string(image.id);
    const CameraIntrinsics& c = image.camera;
    OrderedJson camera = OrderedJson::object(), object = OrderedJson::object();
    camera["cam_K"] = {c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0};
    camera["depth_scale"] = kMillimetres * image.depth_unit_m;
    put_bop_pose(image.T_world_camera.inverse(), "w2c", camera);
    cameras[key] = std::move(camera);
    put_bop_pose(image.T_world_camera.inverse(), "m2c", object);
    object["obj_id"] = 1;
    truth[key] = OrderedJson::array({std::move(object)});
  }
  const fs::path scene = folder / "test" / "000001";
  TURNSCAN_TRY(make_folder(scene));
  if (mesh != nullptr) {
    TURNSCAN_TRY(make_folder(folder / "models"));
    TriangleMesh model = *mesh;
    for (Vec3f& p : model.vertices) p *= float(kMillimetres);
    TURNSCAN_TRY(write_mesh(folder / "models" / "obj_000001.ply", model));
    TURNSCAN_TRY(write_file_atomically(scene / "scene_gt.json", text::json_text(truth)));
  }
  return write_file_atomically(scene / "scene_camera.json", text::json_text(cameras));
}

}  // namespace turnscan::exporters
