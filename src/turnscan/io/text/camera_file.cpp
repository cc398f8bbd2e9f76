#include <turnscan/io/text/camera_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/opencv_yaml.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {

namespace {

// In the files of OpenCV, in messages of ROS 1 and ROS 2, and in others.
constexpr std::array<const char*, 4> kMatrixNames{"camera_matrix", "K", "k", "cam_K"};
constexpr std::array<const char*, 4> kLensNames{"distortion_coefficients", "D", "d", "dist_coeffs"};
constexpr std::array<const char*, 2> kWidthNames{"image_width", "width"};
constexpr std::array<const char*, 2> kHeightNames{"image_height", "height"};

/// The parts of a camera that a file states.
struct CameraParts {
  std::vector<double> matrix, lens;
  double width = 0.0, height = 0.0;
};

Result<CameraIntrinsics> camera_of_parts(const CameraParts& parts) {
  CameraIntrinsics out;
  if (parts.matrix.size() != 9)
    return fail(ErrorCode::kFormat, "the camera's matrix has {} numbers, not 9",
                parts.matrix.size());
  if (parts.lens.size() > out.distortion.size())
    return fail(ErrorCode::kUnsupported,
                "the lens has {} coefficients, and at most 8 are known (k1 k2 p1 p2 k3 k4 k5 k6)",
                parts.lens.size());
  const auto is_size = [](double n) { return n >= 0.0 && n <= 65535.0 && n == std::floor(n); };
  if (!is_size(parts.width) || !is_size(parts.height))
    return fail(ErrorCode::kFormat, "the size of the images is {} x {}", parts.width, parts.height);
  out.fx = parts.matrix[0], out.cx = parts.matrix[2];
  out.fy = parts.matrix[4], out.cy = parts.matrix[5];
  std::copy(parts.lens.begin(), parts.lens.end(), out.distortion.begin());
  out.width = int(parts.width), out.height = int(parts.height);
  return out;
}

Result<CameraParts> parts_of_yaml(std::string_view text) {
  CameraParts out;
  for (const char* name : kMatrixNames) {
    if (!opencv_has(text, name) || !out.matrix.empty()) continue;
    TURNSCAN_ASSIGN(out.matrix, opencv_matrix(text, name, 9, 9));
  }
  for (const char* name : kLensNames) {
    if (!opencv_has(text, name) || !out.lens.empty()) continue;
    TURNSCAN_ASSIGN(out.lens, opencv_matrix(text, name, 0, 14));
  }
  for (std::size_t i = 0; i < kWidthNames.size(); ++i) {
    if (!opencv_has(text, kWidthNames[i]) || !opencv_has(text, kHeightNames[i])) continue;
    TURNSCAN_ASSIGN(out.width, opencv_number(text, kWidthNames[i]));
    TURNSCAN_ASSIGN(out.height, opencv_number(text, kHeightNames[i]));
  }
  return out;
}

/// Numbers of a list, of a list of rows, or of an object with a list "data".
std::vector<double> numbers_below(const Json& value) {
  std::vector<double> out;
  if (value.is_object()) return value.contains("data") ? numbers_below(value["data"]) : out;
  if (!value.is_array()) return out;
  for (const Json& item : value) {
    if (item.is_number()) out.push_back(item.get<double>());
    const std::vector<double> row = item.is_array() ? numbers_below(item) : std::vector<double>();
    out.insert(out.end(), row.begin(), row.end());
  }
  return out;
}

Result<CameraParts> parts_of_json(std::string_view text) {
  TURNSCAN_ASSIGN(const Json json, parse_json(text));
  TURNSCAN_ASSIGN(const JsonObject root, JsonObject::from(json, text));
  CameraParts out;
  const auto first = [&](const auto& names) -> std::vector<double> {
    for (const char* name : names)
      if (root.has(name)) return numbers_below(*root.find(name));
    return {};
  };
  out.matrix = first(kMatrixNames);
  out.lens = first(kLensNames);
  if (root.has("intrinsic_matrix")) {  // column by column
    const std::vector<double> m = first(std::array{"intrinsic_matrix"});
    if (m.size() == 9) out.matrix = {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
  } else if (root.has("fx")) {
    out.matrix.assign(9, 0.0);
    TURNSCAN_ASSIGN(out.matrix[0], root.number("fx"));
    TURNSCAN_ASSIGN(out.matrix[4], root.number("fy"));
    TURNSCAN_ASSIGN(out.matrix[2], root.number("cx"));
    TURNSCAN_ASSIGN(out.matrix[5], root.number("cy"));
  }
  for (std::size_t i = 0; i < kWidthNames.size(); ++i) {
    if (!root.has(kWidthNames[i])) continue;
    TURNSCAN_ASSIGN(out.width, root.number(kWidthNames[i]));
    TURNSCAN_ASSIGN(out.height, root.number(kHeightNames[i]));
  }
  return out;
}

}  // namespace

Result<CameraIntrinsics> parse_camera_file(std::string_view text) {
  if (const auto numbers = parse_numbers(text, 9)) return camera_of_parts({*numbers, {}, 0.0, 0.0});
  if (const auto m = parse_numbers(text, 16))  // homogeneous, as ScanNet writes it
    return camera_of_parts(
        {{(*m)[0], (*m)[1], (*m)[2], (*m)[4], (*m)[5], (*m)[6], 0.0, 0.0, 1.0}, {}, 0.0, 0.0});
  for (const std::string_view lens : {"equidistant", "fisheye"})
    if (text.find(lens) != text.npos)
      return fail(ErrorCode::kUnsupported,
                  "the lens is that of a fisheye, which is not known; rectify the images");
  const bool json = trimmed(text).starts_with('{');
  TURNSCAN_ASSIGN(const CameraParts parts, json ? parts_of_json(text) : parts_of_yaml(text));
  if (parts.matrix.empty())
    return fail(ErrorCode::kFormat,
                "this is neither a 3x3 matrix nor a calibration with camera_matrix, K or fx, fy, "
                "cx, cy");
  return camera_of_parts(parts);
}

}  // namespace turnscan::text
