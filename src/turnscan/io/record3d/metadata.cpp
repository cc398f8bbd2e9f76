#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/io/record3d/metadata.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::record3d {

namespace {

constexpr int kMaxSide = 16384;
// A whole picture of a phone's camera, 4032 x 3024; its videos and depth images have fewer.
constexpr std::int64_t kMaxPixels = 4032 * 3024;

Result<> check_pixels(int width, int height) {
  if (std::int64_t(width) * height <= kMaxPixels) return {};
  return fail(ErrorCode::kResourceLimit,
              "the images have {} x {} pixels, and a phone's have at most 4032 x 3024; the file is "
              "damaged",
              width, height);
}

/// A list of lists of `width` numbers each; empty if there is none.
Result<std::vector<std::vector<double>>> rows_of(const text::JsonObject& root, const char* key,
                                                 std::size_t width) {
  std::vector<std::vector<double>> rows;
  const text::Json* list = root.find(key);
  if (list == nullptr) return rows;
  if (!list->is_array()) return fail(ErrorCode::kFormat, "{} is not a list", key);
  const auto good = [&](const text::Json& row) {
    return row.is_array() && row.size() == width &&
           std::all_of(row.begin(), row.end(), [](const text::Json& v) {
             return v.is_number() && std::isfinite(v.get<double>());
           });
  };
  for (const text::Json& row : *list) {
    if (!good(row))
      return fail(ErrorCode::kFormat, "{}[{}] is not a list of {} numbers", key, rows.size(),
                  width);
    rows.push_back(row.get<std::vector<double>>());
  }
  return rows;
}

/// The focus varies, and with it the camera: takes the median of all, and their variation.
Result<> take_cameras_of_frames(const text::JsonObject& root, Metadata& out) {
  TURNSCAN_ASSIGN(const auto rows, rows_of(root, "perFrameIntrinsicCoeffs", 4));
  if (rows.empty()) return {};
  std::array<double*, 4> fields{&out.camera.fx, &out.camera.fy, &out.camera.cx, &out.camera.cy};
  for (std::size_t c = 0; c < fields.size(); ++c) {
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row[c]);
    std::sort(values.begin(), values.end());
    *fields[c] = values[values.size() / 2];
    if (c == 0) out.focal_change = (values.back() - values.front()) / std::abs(*fields[c]);
  }
  return {};
}

/// K is stored column by column.
Result<> parse_camera(const text::JsonObject& root, Metadata& out) {
  CameraIntrinsics& camera = out.camera;
  TURNSCAN_ASSIGN(camera.width, root.integer("w", 1, kMaxSide));
  TURNSCAN_ASSIGN(camera.height, root.integer("h", 1, kMaxSide));
  TURNSCAN_TRY(check_pixels(camera.width, camera.height));
  TURNSCAN_ASSIGN(const std::vector<double> k, root.numbers("K"));
  if (k.size() != 9) return fail(ErrorCode::kFormat, "K has {} numbers, not 9", k.size());
  camera.fx = k[0];
  camera.fy = k[4];
  camera.cx = k[6];
  camera.cy = k[7];
  TURNSCAN_TRY(take_cameras_of_frames(root, out));
  return camera.check();
}

/// qx qy qz qw x y z. A pose of zeros means that there was no tracking.
Result<std::vector<std::optional<Pose>>> parse_poses(const text::JsonObject& root) {
  TURNSCAN_ASSIGN(const auto rows, rows_of(root, "poses", 7));
  std::vector<std::optional<Pose>> poses;
  for (const auto& v : rows) {
    const auto pose = pose_from(Vec3d(v[4], v[5], v[6]), v[0], v[1], v[2], v[3]);
    poses.push_back(pose ? std::optional(*pose) : std::nullopt);
  }
  return poses;
}

}  // namespace

Result<Metadata> parse_metadata(std::string_view json, const file::ReadBudget& budget) {
  TURNSCAN_ASSIGN(const text::Json value, text::parse_json(json, budget));
  TURNSCAN_ASSIGN(const text::JsonObject root, text::JsonObject::from(value));
  Metadata out;
  TURNSCAN_TRY(parse_camera(root, out));
  if (root.has("dw") || root.has("dh")) {
    TURNSCAN_ASSIGN(out.depth_width, root.integer("dw", 1, kMaxSide));
    TURNSCAN_ASSIGN(out.depth_height, root.integer("dh", 1, kMaxSide));
    TURNSCAN_TRY(check_pixels(out.depth_width, out.depth_height));
  }
  TURNSCAN_ASSIGN(out.fps, root.number_or("fps", 0.0));
  if (root.has("frameTimestamps")) {
    TURNSCAN_ASSIGN(out.times_s, root.numbers("frameTimestamps"));
  }
  TURNSCAN_ASSIGN(out.poses, parse_poses(root));
  return out;
}

}  // namespace turnscan::record3d
