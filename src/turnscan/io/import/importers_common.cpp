#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/rotation_between.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/iai_kinect2.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/camera_file.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <utility>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxNames = 1000000;

Result<std::vector<std::string>> three_parts(std::string_view name, std::string_view text) {
  TURNSCAN_ASSIGN(std::vector<std::string> parts, text::csv_fields(text));
  if (parts.size() != 3)
    return fail(ErrorCode::kInvalidOption, "{} = {} does not have the form x,y,z", name, text);
  return parts;
}

CameraIntrinsics camera_of(double fx, double fy, double cx, double cy) {
  CameraIntrinsics camera;
  camera.fx = fx;
  camera.fy = fy;
  camera.cx = cx;
  camera.cy = cy;
  return camera;
}

double metres_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      return 1e-3;
    case LengthUnit::kCentimetre:
      return 1e-2;
    case LengthUnit::kMicrometre:
      return 1e-6;
    case LengthUnit::kInch:
      return 0.0254;
    case LengthUnit::kMetre:
    case LengthUnit::kAuto:
      break;
  }
  return 1.0;
}

}  // namespace

Result<std::vector<std::string>> names_in(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator it(folder, error);
  std::vector<std::string> names;
  for (; !error && it != fs::directory_iterator(); it.increment(error)) {
    if (names.size() == kMaxNames)
      return fail_at(folder.string(), ErrorCode::kResourceLimit,
                     "the folder has more than {} files", kMaxNames);
    names.push_back(it->path().filename().string());
  }
  if (error)
    return fail_at(folder.string(), ErrorCode::kIo, "cannot list the folder: {}", error.message());
  std::sort(names.begin(), names.end());
  return names;
}

std::string display_name(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  return (whole.has_filename() ? whole.filename() : whole.parent_path().filename()).string();
}

Result<fs::path> existing_file(const fs::path& folder, std::string_view name,
                               std::string_view mentioned_by) {
  if (auto good = text::check_inside(name); !good)
    return fail_at(folder.string(), ErrorCode::kFormat, "{}: {}", mentioned_by,
                   good.error().message);
  fs::path path = folder / name;
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (!there)
    return fail_at(path.string(), ErrorCode::kNotFound, "{} names it, but there is no such file",
                   mentioned_by);
  std::error_code error;
  if (fs::is_regular_file(path, error)) return path;
  return fail_at(path.string(), ErrorCode::kFormat, "{} names it, but it is not a regular file",
                 mentioned_by);
}

void add_note(SequenceHeader& header, std::string_view note) {
  header.source += '\n';
  header.source += note;
}

tl::unexpected<Error> at_path(const fs::path& path, Error error) {
  if (error.path.empty()) error.path = path.string();
  return tl::unexpected<Error>(std::move(error));
}

Result<double> point_scale(const ImportOptions& options, std::optional<double> by_format) {
  if (options.point_unit != LengthUnit::kAuto) return metres_of(options.point_unit);
  if (by_format) return *by_format;
  return fail(ErrorCode::kMissingData,
              "import: the files do not say the unit of their coordinates; state it, e.g. "
              "--point-unit mm");
}

Result<std::vector<text::AngleRow>> read_angle_table(const fs::path& path) {
  TURNSCAN_ASSIGN(const std::string bytes, read_file(path, kMaxTextBytes));
  auto rows = text::parse_angle_table(bytes);
  if (!rows) return at_path(path, std::move(rows).error());
  return rows;
}

Result<Eigen::Matrix3d> stated_axes(const ImportOptions& options) {
  Eigen::Matrix3d out = Eigen::Matrix3d::Identity();
  if (options.axes.empty()) return out;
  constexpr std::string_view kLetters = "rldufb";  // x, -x, y, -y, z, -z of the sensor frame
  std::array<bool, 3> used{};
  bool good = options.axes.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    const std::size_t letter = kLetters.find(char(options.axes[i] | 0x20));
    good = letter != std::string_view::npos && !std::exchange(used[letter / 2], true);
    if (good) out.col(int(i)) = (letter % 2 == 0 ? 1.0 : -1.0) * Vec3d::Unit(int(letter / 2));
  }
  if (good) return out;
  return fail(ErrorCode::kInvalidOption,
              "axes = {} does not say where x, y and z point, seen by the scanner: one letter each "
              "of r or l (right, left), u or d (up, down) and f or b (forward, backward), e.g. rdf "
              "(PCL, Open3D, ROS), rub (OpenGL), ruf (Unity, left-handed)",
              options.axes);
}

Result<double> depth_scale(const ImportOptions& options, std::optional<double> by_format) {
  if (options.depth_unit_m) return *options.depth_unit_m;
  if (by_format) return *by_format;
  return fail(ErrorCode::kMissingData,
              "import: the files do not say the unit of their depth images; state the length of "
              "one step, e.g. --depth-unit 1mm");
}

Result<std::optional<CameraIntrinsics>> iai_kinect2_intrinsics(const ImportOptions& options) {
  std::optional<CameraIntrinsics> camera;
  if (options.iai_kinect2.empty()) return camera;
  TURNSCAN_ASSIGN(const Kinect2Calibration kinect, read_iai_kinect2(options.iai_kinect2));
  if (kinect.camera) camera = kinect.camera->intrinsics;
  return camera;
}

Result<CameraIntrinsics> intrinsics_from_file(const fs::path& path) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  auto camera = text::parse_camera_file(text);
  if (!camera) return at_path(path, std::move(camera).error());
  return camera;
}

Result<std::optional<CameraIntrinsics>> intrinsics_beside(const fs::path& folder) {
  for (const char* name : {"camera_matrix.csv", "cam_K.txt", "camera-intrinsics.txt",
                           "intrinsics.txt", "intrinsic/intrinsic_depth.txt"}) {
    TURNSCAN_ASSIGN(const bool there, file::is_there(folder / name));
    if (there) return intrinsics_from_file(folder / name);
  }
  return std::optional<CameraIntrinsics>();
}

Result<CameraIntrinsics> stated_intrinsics(const ImportOptions& options) {
  if (const auto v = text::parse_numbers(options.intrinsics, 4); v)
    return camera_of((*v)[0], (*v)[1], (*v)[2], (*v)[3]);
  const auto there = file::is_there(options.intrinsics);
  if (!there || *there) return intrinsics_from_file(options.intrinsics);
  return fail(ErrorCode::kInvalidOption,
              "intrinsics = {} is neither fx,fy,cx,cy in pixels nor a file with a camera's matrix",
              options.intrinsics);
}

Result<std::optional<Viewpoint>> stated_viewpoint(const ImportOptions& options) {
  if (!options.sensor_position.empty() && !options.sensor_direction.empty())
    return fail(ErrorCode::kInvalidOption,
                "sensor-position and sensor-direction exclude each other; give one of them");
  Viewpoint viewpoint;
  if (!options.sensor_position.empty()) {
    TURNSCAN_ASSIGN(viewpoint.value, parse_position("sensor-position", options.sensor_position));
    return std::optional<Viewpoint>(viewpoint);
  }
  if (options.sensor_direction.empty()) return std::optional<Viewpoint>();
  TURNSCAN_ASSIGN(viewpoint.value, parse_direction("sensor-direction", options.sensor_direction));
  viewpoint.parallel = true;
  return std::optional<Viewpoint>(viewpoint);
}

Result<Vec3d> parse_direction(std::string_view name, std::string_view text) {
  TURNSCAN_ASSIGN(const std::vector<std::string> parts, three_parts(name, text));
  Vec3d v;
  for (int i = 0; i < 3; ++i) {
    const auto value = parse_number(parts[static_cast<std::size_t>(i)]);
    if (!value) return fail(ErrorCode::kInvalidOption, "{}: {}", name, value.error().message);
    v[i] = *value;
  }
  if (!(v.stableNorm() > 1e-6 && v.stableNorm() < 1e6))
    return fail(ErrorCode::kInvalidOption, "{} = {} does not give a direction", name, text);
  return v.normalized();
}

Result<Vec3d> parse_position(std::string_view name, std::string_view text) {
  TURNSCAN_ASSIGN(const std::vector<std::string> parts, three_parts(name, text));
  Vec3d v;
  for (int i = 0; i < 3; ++i) {
    const auto value = parse_quantity(parts[static_cast<std::size_t>(i)], Quantity::kLength);
    if (!value) return fail(ErrorCode::kInvalidOption, "{}: {}", name, value.error().message);
    v[i] = *value;
  }
  return v;
}

Result<Pose> placed_pose(const Pose& pose, const ImportOptions& options) {
  const Pose T_world_sensor =
      options.pose_direction == PoseDirection::kWorldToCamera ? pose.inverse() : pose;
  if (options.world_up.empty()) return T_world_sensor;
  TURNSCAN_ASSIGN(const Vec3d up, parse_direction("world-up", options.world_up));
  return Pose(rotation_between(up, Vec3d::UnitY())) * T_world_sensor;
}

}  // namespace turnscan::importers
