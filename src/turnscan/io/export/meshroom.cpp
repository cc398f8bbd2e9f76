// AliceVision's .sfm, which Meshroom opens, in version 1.2.1 of that file
// (github.com/alicevision/AliceVision: src/aliceVision/sfmDataIO/jsonIO.cpp and its CHANGELOG.md):
// the principal point is measured from the image's middle, the rotation is that from world to
// camera, column by column, and the centre is the camera's.

#include <nlohmann/json.hpp>
#include <turnscan/io/export/description_writers.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::exporters {

namespace fs = std::filesystem;
using text::OrderedJson;

namespace {

OrderedJson sfm_camera(std::size_t id, const CameraIntrinsics& c) {
  const auto focal = OrderedJson::array({c.fx, c.fy});
  return {{"intrinsicId", id},
          {"width", c.width},
          {"height", c.height},
          {"serialNumber", fmt::format("turnscan-{}", id)},
          {"type", "pinhole"},
          {"initializationMode", "calibrated"},
          {"pxInitialFocalLength", focal},
          {"pxFocalLength", focal},
          {"principalPoint",
           OrderedJson::array({c.cx + 0.5 - 0.5 * c.width, c.cy + 0.5 - 0.5 * c.height})},
          {"distortionParams", OrderedJson::array()},
          {"locked", 1}};
}

OrderedJson sfm_pose(std::size_t id, const Pose& T_world_camera) {
  OrderedJson rotation = OrderedJson::array(), center = OrderedJson::array();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) rotation.push_back(T_world_camera.linear()(i, k));
  for (int i = 0; i < 3; ++i) center.push_back(T_world_camera.translation()[i]);
  const OrderedJson transform{{"rotation", std::move(rotation)}, {"center", std::move(center)}};
  return {{"poseId", id}, {"pose", {{"transform", transform}, {"locked", 1}}}};
}

}  // namespace

Result<> write_meshroom(const fs::path& folder, const std::vector<PosedImage>& images) {
  const Cameras cameras(images);
  OrderedJson root{{"version", OrderedJson::array({1, 2, 1})}};
  OrderedJson views = OrderedJson::array(), intrinsics = views, poses = views;
  for (std::size_t i = 0; i < cameras.list().size(); ++i)
    intrinsics.push_back(sfm_camera(i + 1, cameras.list()[i]));
  for (std::size_t i = 0; i < images.size(); ++i) {
    const PosedImage& image = images[i];
    if (image.image.empty()) continue;
    std::error_code error;
    const fs::path path = fs::absolute(folder / image.image, error);
    views.push_back({{"viewId", i + 1},
                     {"poseId", i + 1},
                     {"frameId", image.id},
                     {"intrinsicId", cameras.number_of(image.camera) + 1},
                     {"path", path.string()},
                     {"width", image.camera.width},
                     {"height", image.camera.height}});
    poses.push_back(sfm_pose(i + 1, image.T_world_camera));
  }
  if (views.empty())
    return fail(ErrorCode::kUnsupported,
                "the recording has no colour, and Meshroom needs it; export to another layout");
  root["views"] = std::move(views);
  root["intrinsics"] = std::move(intrinsics);
  root["poses"] = std::move(poses);
  return write_file_atomically(folder / "cameras.sfm", text::json_text(root));
}

}  // namespace turnscan::exporters
