#include <cmath>
#include <turnscan/core/units.hpp>
#include <turnscan/io/atomic_file.hpp>
#include <turnscan/io/iai_kinect2.hpp>
#include <turnscan/io/text_fields.hpp>

namespace turnscan {

namespace {

constexpr std::uint64_t kMaxBytes = 1 << 20;

Result<double> depth_shift_mm(std::string_view text) {
  constexpr std::string_view kKey = "depthShift:";
  LineReader lines(text);
  while (const auto line = lines.next()) {
    const std::string_view content = trimmed(line->text);
    if (!content.starts_with(kKey)) continue;
    return parse_number(trimmed(content.substr(kKey.size())));
  }
  return fail(ErrorCode::kFormat, "there is no line 'depthShift: ...'");
}

/// The numbers between the brackets after "data:" of a matrix.
Result<std::vector<double>> matrix(std::string_view text, std::string_view name,
                                   std::size_t count) {
  const auto start = text.find(name);
  const auto open = start == text.npos ? text.npos : text.find('[', start);
  const auto close = open == text.npos ? text.npos : text.find(']', open);
  if (close == text.npos) return fail(ErrorCode::kFormat, "there is no matrix {}", name);
  std::string numbers(text.substr(open + 1, close - open - 1));
  for (char& c : numbers) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  // OpenCV writes whole numbers with a point and nothing behind it.
  std::string clean;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    clean += numbers[i];
    const char next = i + 1 < numbers.size() ? numbers[i + 1] : ' ';
    if (numbers[i] == '.' && (next < '0' || next > '9')) clean += '0';
  }
  return parse_numbers(clean, count);
}

Result<CameraIntrinsics> parse_camera(std::string_view text) {
  TURNSCAN_ASSIGN(const auto k, matrix(text, "cameraMatrix", 9));
  TURNSCAN_ASSIGN(const auto d, matrix(text, "distortionCoefficients", 5));
  CameraIntrinsics camera;
  camera.width = 512, camera.height = 424;
  camera.fx = k[0], camera.cx = k[2], camera.fy = k[4], camera.cy = k[5];
  for (std::size_t i = 0; i < 5; ++i) camera.distortion[i] = d[i];
  TURNSCAN_TRY(camera.check());
  return camera;
}

}  // namespace

Result<Kinect2Calibration> read_iai_kinect2(const std::filesystem::path& folder) {
  Kinect2Calibration out;
  const auto depth_path = folder / "calib_depth.yaml", ir_path = folder / "calib_ir.yaml";
  TURNSCAN_ASSIGN(const std::string depth, read_file(depth_path, kMaxBytes));
  const auto shift = depth_shift_mm(depth);
  if (!shift) return fail_at(depth_path.string(), ErrorCode::kFormat, "{}", shift.error().message);
  if (!(std::abs(*shift) <= 1000.0))
    return fail_at(depth_path.string(), ErrorCode::kFormat, "depthShift is {} mm, beyond 1 m",
                   *shift);
  out.depth_shift_m = *shift * 1e-3;
  std::error_code error;
  if (!std::filesystem::exists(ir_path, error)) return out;
  TURNSCAN_ASSIGN(const std::string ir, read_file(ir_path, kMaxBytes));
  const auto camera = parse_camera(ir);
  if (!camera) return fail_at(ir_path.string(), ErrorCode::kFormat, "{}", camera.error().message);
  out.intrinsics = *camera;
  return out;
}

}  // namespace turnscan
