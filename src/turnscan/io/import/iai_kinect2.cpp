#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/iai_kinect2.hpp>
#include <turnscan/io/text/opencv_yaml.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;

Result<double> depth_shift_mm(std::string_view text) {
  constexpr std::string_view kKey = "depthShift:";
  text::LineReader lines(text);
  while (const auto line = lines.next()) {
    const std::string_view content = text::trimmed(line->text);
    if (!content.starts_with(kKey)) continue;
    return parse_number(text::trimmed(content.substr(kKey.size())));
  }
  return fail(ErrorCode::kFormat, "there is no line 'depthShift: ...'");
}

Result<CameraIntrinsics> parse_camera(std::string_view text, int width, int height) {
  TURNSCAN_ASSIGN(const auto k, text::opencv_matrix(text, "cameraMatrix", 9, 9));
  TURNSCAN_ASSIGN(const auto d, text::opencv_matrix(text, "distortionCoefficients", 5, 8));
  CameraIntrinsics camera;
  camera.width = width, camera.height = height;
  camera.fx = k[0], camera.cx = k[2], camera.fy = k[4], camera.cy = k[5];
  std::copy(d.begin(), d.end(), camera.distortion.begin());
  TURNSCAN_TRY(camera.check());
  return camera;
}

/// From the depth to the colour camera, as in OpenCV's stereo calibration.
Result<Pose> parse_stereo_pose(std::string_view text) {
  TURNSCAN_ASSIGN(const auto r, text::opencv_matrix(text, "rotation", 9, 9));
  TURNSCAN_ASSIGN(const auto t, text::opencv_matrix(text, "translation", 3, 3));
  Eigen::Matrix3d R;
  R << r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8];
  if (!((R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-3) ||
      R.determinant() < 0.0)
    return fail(ErrorCode::kFormat, "the matrix rotation is no rotation");
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  pose.translation() = Vec3d(t[0], t[1], t[2]);
  if (!(pose.translation().norm() <= 1.0))
    return fail(ErrorCode::kFormat, "the translation is beyond 1 m");
  return pose;
}

Result<double> parse_shift(std::string_view text) {
  TURNSCAN_ASSIGN(const double shift_mm, depth_shift_mm(text));
  if (!(std::abs(shift_mm) <= 1000.0))
    return fail(ErrorCode::kFormat, "depthShift is {} mm, beyond 1 m", shift_mm);
  return shift_mm * 1e-3;
}

/// Applies `parse` to the file; adds the path to its error. Implausible numbers count as damage.
template <class Parse>
auto parsed(const std::filesystem::path& path, const Parse& parse) -> decltype(parse("")) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxBytes));
  auto value = parse(std::string_view(text));
  if (value) return value;
  const Error& error = value.error();
  const bool variant = error.code == ErrorCode::kUnsupported;
  return fail_at(path.string(), variant ? error.code : ErrorCode::kFormat, "{}", error.message);
}

}  // namespace

}  // namespace turnscan::importers

namespace turnscan {

using namespace importers;

Result<Kinect2Calibration> read_iai_kinect2(const std::filesystem::path& folder) {
  Kinect2Calibration out;
  const auto depth = folder / "calib_depth.yaml", ir = folder / "calib_ir.yaml",
             color = folder / "calib_color.yaml", pose = folder / "calib_pose.yaml";
  TURNSCAN_ASSIGN(const bool depth_there, file::is_there(depth));
  TURNSCAN_ASSIGN(const bool ir_there, file::is_there(ir));
  TURNSCAN_ASSIGN(const bool color_there, file::is_there(color));
  TURNSCAN_ASSIGN(const bool pose_there, file::is_there(pose));
  if (!depth_there && !ir_there)
    return fail_at(folder.string(), ErrorCode::kNotFound,
                   "there is neither calib_depth.yaml nor calib_ir.yaml in the folder");
  const std::string found = "iai_kinect2 calibration " + folder.string();
  if (depth_there) {
    out.depth.emplace();
    TURNSCAN_ASSIGN(out.depth->bias_m, parsed(depth, parse_shift));
    out.depth->found = found;
  }
  if (!ir_there) return out;
  out.camera.emplace();
  out.camera->found = found;
  TURNSCAN_ASSIGN(out.camera->intrinsics,
                  parsed(ir, [](std::string_view text) { return parse_camera(text, 512, 424); }));
  if (!color_there || !pose_there) return out;
  TURNSCAN_ASSIGN(out.camera->color_intrinsics, parsed(color, [](std::string_view text) {
                    return parse_camera(text, 1920, 1080);
                  }));
  TURNSCAN_ASSIGN(out.camera->T_color_sensor, parsed(pose, parse_stereo_pose));
  return out;
}

}  // namespace turnscan
