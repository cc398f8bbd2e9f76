#include <turnscan/workflow/passes/pass_pose.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <vector>

namespace turnscan {

namespace {

constexpr std::size_t kMaxBytes = 65536;  // of a file with 16 numbers

std::vector<std::string> split_at(const std::string& text, const char* separators) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

Result<Pose> pose_of_numbers(const std::vector<std::string>& words) {
  std::array<double, 6> value{};
  for (std::size_t i = 0; i < value.size(); ++i) {
    TURNSCAN_ASSIGN(value[i],
                    parse_quantity(words[i], i < 3 ? Quantity::kAngle : Quantity::kLength));
  }
  Pose pose = Pose::Identity();
  pose.linear() =
      (Eigen::AngleAxisd(value[2], Vec3d::UnitZ()) * Eigen::AngleAxisd(value[1], Vec3d::UnitY()) *
       Eigen::AngleAxisd(value[0], Vec3d::UnitX()))
          .toRotationMatrix();
  pose.translation() = Vec3d(value[3], value[4], value[5]);
  return pose;
}

Result<Pose> read_matrix(const std::string& path) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxBytes));
  const std::vector<std::string> words = split_at(text, " \t\r\n,;[]");
  if (words.size() != 16)
    return fail_at(path, ErrorCode::kFormat, "a matrix has 16 numbers, here are {}", words.size());
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i) {
    const auto number = parse_number(words[std::size_t(i)]);
    if (!number)
      return fail_at(path, ErrorCode::kFormat, "'{}' is not a number", words[std::size_t(i)]);
    matrix(i / 4, i % 4) = *number;
  }
  auto pose = pose_from(matrix);
  if (!pose) return fail_at(path, pose.error().code, "{}", pose.error().message);
  return pose;
}

}  // namespace

Result<PassPose> parse_pass_pose(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto number = parse_number(text.substr(0, equals));
  if (equals == std::string::npos || !number || !(*number >= 0.0) || *number > 1e9 ||
      *number != std::floor(*number))
    return fail(ErrorCode::kInvalidOption,
                "--pass-pose {}: write PASS=FILE or PASS=RX,RY,RZ,TX,TY,TZ, e.g. "
                "1=180deg,0deg,30deg,0mm,200mm,0mm",
                text);
  PassPose out;
  out.pass = std::uint32_t(*number);
  const std::string place = text.substr(equals + 1);
  const std::vector<std::string> words = split_at(place, ",");
  auto pose = words.size() == 6 ? pose_of_numbers(words) : read_matrix(place);
  if (!pose && pose.error().path.empty())
    return fail(ErrorCode::kInvalidOption, "--pass-pose {}: {}", text, pose.error().message);
  TURNSCAN_ASSIGN(out.T_first_table, pose);
  return out;
}

}  // namespace turnscan
