// Imports depth images described by one JSON file; docs/reference/importing.md lists its fields.

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <utility>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxViews = 100000;
constexpr std::string_view kDepth = "depth";

/// The lists in the file, each empty or with one entry per view.
struct Views {
  std::size_t count = 0;
  std::vector<double> angles_rad;
  std::vector<double> times_s;
  std::vector<double> passes;
  std::vector<Pose> poses;
  std::vector<std::string> depth_files, color_files;
};

Result<fs::path> find_json(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(path));
  fs::path found;
  for (const std::string& name : names) {
    if (!name.ends_with(".json")) continue;
    if (!found.empty())
      return fail_at(path.string(), ErrorCode::kInvalidOption,
                     "the folder has several .json files; name one of them");
    found = path / name;
  }
  if (found.empty())
    return fail_at(path.string(), ErrorCode::kNotFound, "the folder has no .json file");
  return found;
}

Result<std::vector<double>> numbers_if_any(const text::JsonObject& root, const char* key) {
  return root.has(key) ? root.numbers(key) : std::vector<double>();
}

Result<std::vector<std::string>> texts_if_any(const text::JsonObject& root, const char* key) {
  return root.has(key) ? root.texts(key) : std::vector<std::string>();
}

Result<std::vector<double>> parse_angles(const text::JsonObject& root, SequenceHeader& header) {
  if (root.has("angle_rad_closed")) {
    if (root.has("angle_rad"))
      add_note(header, "of the two lists of angles, angle_rad_closed was taken");
    return root.numbers("angle_rad_closed");
  }
  if (root.has("angle_rad")) return root.numbers("angle_rad");
  TURNSCAN_ASSIGN(std::vector<double> angles, numbers_if_any(root, "angle_deg"));
  for (double& angle : angles) angle *= std::numbers::pi / 180.0;
  return angles;
}

Result<std::vector<Pose>> parse_poses(const text::JsonObject& root, const ImportOptions& options) {
  std::vector<Pose> poses;
  if (!root.has("poses")) return poses;
  TURNSCAN_ASSIGN(poses, root.poses("poses"));
  for (Pose& pose : poses) {
    TURNSCAN_ASSIGN(pose, placed_pose(pose, options));
  }
  return poses;
}

/// All non-empty lists must have the same length.
Result<> agree_on_count(Views& views) {
  const auto agree = [&](const char* name, std::size_t size) -> Result<> {
    if (size == 0 || size == views.count) return {};
    if (views.count != 0)
      return fail(ErrorCode::kFormat, "{} has {} entries, but another list has {}", name, size,
                  views.count);
    views.count = size;
    return {};
  };
  TURNSCAN_TRY(agree("the list of angles", views.angles_rad.size()));
  TURNSCAN_TRY(agree("times_s", views.times_s.size()));
  TURNSCAN_TRY(agree("passes", views.passes.size()));
  TURNSCAN_TRY(agree("poses", views.poses.size()));
  TURNSCAN_TRY(agree("depth_files", views.depth_files.size()));
  TURNSCAN_TRY(agree("color_files", views.color_files.size()));
  if (views.count > kMaxViews)
    return fail(ErrorCode::kResourceLimit, "there are more than {} views", kMaxViews);
  return {};
}

/// Sorts "depth_7.png", "depth-0007.png", "depth7.png" by their numbers.
Result<std::vector<std::string>> numbered_depth_images(const fs::path& folder) {
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(folder));
  std::map<std::uint64_t, std::string> numbered;
  for (const std::string& name : names) {
    if (!name.starts_with(kDepth) || !name.ends_with(".png")) continue;
    std::string_view digits(name);
    digits.remove_prefix(kDepth.size());
    digits.remove_suffix(4);
    if (digits.starts_with('_') || digits.starts_with('-')) digits.remove_prefix(1);
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(digits.begin(), digits.end(), number);
    if (error != std::errc() || end != digits.end()) continue;
    if (const auto [place, added] = numbered.emplace(number, name); !added)
      return fail(ErrorCode::kFormat,
                  "the images {} and {} have the same number; list the files in the field "
                  "depth_files",
                  place->second, name);
  }
  std::vector<std::string> out;
  for (auto& [number, name] : numbered) out.push_back(std::move(name));
  return out;
}

/// Without any list, the views are the numbered depth images in the folder.
Result<> list_images_if_none_are(Views& views, const fs::path& folder, SequenceHeader& header) {
  if (views.count != 0) return {};
  TURNSCAN_ASSIGN(views.depth_files, numbered_depth_images(folder));
  views.count = views.depth_files.size();
  if (views.count == 0)
    return fail(ErrorCode::kFormat,
                "it lists no views (angle_deg, times_s, poses or depth_files), and beside it is no "
                "depth_N.png; name the images depth_0.png, depth_1.png and so on, or list them in "
                "the field depth_files");
  add_note(header, fmt::format("the {} images depth_N.png were taken in the order of their numbers",
                               views.count));
  return {};
}

Result<Views> parse_views(const text::JsonObject& root, const ImportOptions& options,
                          const fs::path& folder, SequenceHeader& header) {
  Views views;
  TURNSCAN_ASSIGN(views.angles_rad, parse_angles(root, header));
  TURNSCAN_ASSIGN(views.times_s, numbers_if_any(root, "times_s"));
  TURNSCAN_ASSIGN(views.passes, numbers_if_any(root, "passes"));
  TURNSCAN_ASSIGN(views.poses, parse_poses(root, options));
  TURNSCAN_ASSIGN(views.depth_files, texts_if_any(root, "depth_files"));
  TURNSCAN_ASSIGN(views.color_files, texts_if_any(root, "color_files"));
  TURNSCAN_TRY(agree_on_count(views));
  TURNSCAN_TRY(list_images_if_none_are(views, folder, header));
  for (const double pass : views.passes) {
    if (!(pass >= 0.0 && pass <= 1e6) || pass != std::floor(pass))
      return fail(ErrorCode::kFormat, "passes holds {}, which is not a whole number", pass);
  }
  return views;
}

Result<SensorInfo> parse_sensor(const text::JsonObject& root, const ImportOptions& options) {
  SensorInfo sensor;
  TURNSCAN_ASSIGN(const text::JsonObject intrinsics, root.object("intrinsics"));
  TURNSCAN_ASSIGN(sensor.intrinsics, text::intrinsics_from_json(intrinsics));
  TURNSCAN_ASSIGN(const std::optional<double> unit, intrinsics.optional_number("depth_unit_m"));
  TURNSCAN_ASSIGN(sensor.depth_unit_m, depth_scale(options, unit));
  if (!(sensor.depth_unit_m > 0.0 && sensor.depth_unit_m <= 1.0))
    return fail(ErrorCode::kFormat, "intrinsics.depth_unit_m = {} is not within 0 to 1",
                sensor.depth_unit_m);
  TURNSCAN_ASSIGN(sensor.depth_bias_m, root.number_or("depth_bias_m", 0.0));
  TURNSCAN_ASSIGN(sensor.model, root.text_or("model", ""));
  if (root.has("color_intrinsics")) {
    TURNSCAN_ASSIGN(const text::JsonObject color, root.object("color_intrinsics"));
    TURNSCAN_ASSIGN(sensor.color_intrinsics, text::intrinsics_from_json(color));
    TURNSCAN_ASSIGN(sensor.T_color_sensor, root.pose("T_color_sensor"));
  }
  return sensor;
}

/// +1 or -1: the sign for which the axis points up, assuming a camera that is held upright (y down)
/// or looks down on the platter; 0 if both are ambiguous.
int up_sign(const Vec3d& axis) {
  constexpr double kTenDegrees = 0.1736;  // sine
  if (std::abs(axis.y()) > kTenDegrees) return axis.y() < 0.0 ? 1 : -1;
  if (std::abs(axis.z()) > kTenDegrees) return axis.z() < 0.0 ? 1 : -1;
  return 0;
}

/// The rotation by angle about the axis is the one by -angle about the opposite axis.
void turn_axis_up(TurntableInfo& table, Views& views, SequenceHeader& header) {
  const int sign = up_sign(table.axis);
  if (sign == 0)
    add_note(header,
             "axis_dir is level in the sensor's view, so it was not checked that it "
             "points up");
  if (sign >= 0) return;
  table.axis = -table.axis;
  for (double& angle : views.angles_rad) angle = -angle;
  if (table.speed_rad_s) table.speed_rad_s = -*table.speed_rad_s;
  add_note(header,
           "axis_dir pointed down (the sensor's y points down); it was turned round and the signs "
           "of the angles with it");
}

/// Sets header.turntable if the file has one; returns whether its centre is on the platter.
Result<bool> parse_turntable(const text::JsonObject& root, Views& views, SequenceHeader& header) {
  if (!root.has("axis_dir") && !root.has("axis_point")) return true;
  TurntableInfo table;
  TURNSCAN_ASSIGN(const Vec3d axis, root.vector("axis_dir"));
  if (!(axis.stableNorm() > 1e-6 && axis.stableNorm() < 1e6))
    return fail(ErrorCode::kFormat, "axis_dir does not give a direction");
  table.axis = axis.normalized();
  TURNSCAN_ASSIGN(table.center_m, root.vector("axis_point"));
  TURNSCAN_ASSIGN(table.radius_m, root.optional_number("radius_m"));
  TURNSCAN_ASSIGN(table.speed_rad_s, root.optional_number("speed_rad_s"));
  turn_axis_up(table, views, header);
  TURNSCAN_ASSIGN(const std::optional<double> height, root.optional_number("platter_height_m"));
  if (height) table.center_m += *height * table.axis;
  header.turntable = table;
  return height.has_value();
}

/// "color_007.png" for "depth_007.png" or "depth_007.npy"; for other names by the view's position.
std::string color_beside(const std::string& depth, std::size_t view) {
  if (depth.starts_with(kDepth))
    return fs::path("color" + depth.substr(kDepth.size())).replace_extension(".png").string();
  return fmt::format("color_{}.png", view);
}

/// Of the images depth_N, by that of the first.
Result<std::string> ending_of_images(const fs::path& folder) {
  for (const char* ending : {"npy", "pgm"}) {
    TURNSCAN_ASSIGN(const bool there, file::is_there(folder / fmt::format("depth_0.{}", ending)));
    if (there) return std::string(ending);
  }
  return std::string("png");
}

/// The stated unit is that of numbers in the first file, too.
Result<DepthFileOptions> float_files(const std::vector<ForeignFrame>& frames, SensorInfo& sensor) {
  DepthFileOptions out;
  if (frames.empty() || frames.front().data.extension() != ".npy") return out;
  TURNSCAN_ASSIGN(const DepthFile first, read_depth_file(frames.front().data));
  if (first.floats) out.float_unit_m = std::exchange(sensor.depth_unit_m, kFloatDepthStep_m);
  return out;
}

Result<std::vector<ForeignFrame>> list_frames(const Views& views, const fs::path& folder,
                                              const RunContext& context) {
  TURNSCAN_ASSIGN(const std::string ending, ending_of_images(folder));
  std::vector<ForeignFrame> frames;
  for (std::size_t i = 0; i < views.count; ++i) {
    TURNSCAN_TRY(context.check());
    ForeignFrame frame;
    frame.info.index = static_cast<std::uint32_t>(i);
    frame.info.file =
        views.depth_files.empty() ? fmt::format("depth_{}.{}", i, ending) : views.depth_files[i];
    TURNSCAN_ASSIGN(frame.data, existing_file(folder, frame.info.file, "the JSON file"));
    if (!views.color_files.empty()) {
      TURNSCAN_ASSIGN(frame.color, existing_file(folder, views.color_files[i], "the JSON file"));
    } else {
      const fs::path color = folder / color_beside(frame.info.file, i);
      TURNSCAN_ASSIGN(const bool there, file::is_there(color));
      if (there) frame.color = color;
    }
    if (!views.angles_rad.empty()) frame.info.angle_rad = views.angles_rad[i];
    if (!views.times_s.empty()) frame.info.time_s = views.times_s[i];
    if (!views.passes.empty()) frame.info.pass = static_cast<std::uint32_t>(views.passes[i]);
    if (!views.poses.empty()) frame.info.T_table_sensor = views.poses[i];
    frames.push_back(std::move(frame));
  }
  return frames;
}

struct Description {
  SequenceHeader header;
  Views views;
  bool on_platter = true;
};

Result<Description> parse_description(const fs::path& path, const ImportOptions& options,
                                      const RunContext& context) {
  TURNSCAN_ASSIGN(const std::string text, read_file(path, kMaxTextBytes));
  TURNSCAN_ASSIGN(const text::Json json, text::parse_json(text, context));
  TURNSCAN_ASSIGN(const text::JsonObject root, text::JsonObject::from(json, text));
  Description out;
  out.header.source = fmt::format("depth images of {}", display_name(path));
  TURNSCAN_ASSIGN(const SensorInfo sensor, parse_sensor(root, options));
  out.header.sensors.push_back(sensor);
  TURNSCAN_ASSIGN(out.views, parse_views(root, options, path.parent_path(), out.header));
  TURNSCAN_ASSIGN(out.on_platter, parse_turntable(root, out.views, out.header));
  return out;
}

}  // namespace

OpenResult open_json_png(const fs::path& path, const ImportOptions& options,
                         const RunContext& context) {
  TURNSCAN_ASSIGN(const fs::path file, find_json(path));
  auto description = parse_description(file, options, context);
  if (!description) return at_path(file, std::move(description).error());
  SequenceHeader header = std::move(description->header);
  TURNSCAN_ASSIGN(std::vector<ForeignFrame> frames,
                  list_frames(description->views, file.parent_path(), context));
  TURNSCAN_TRY(apply_iai_kinect2(options, frames, header));
  TURNSCAN_ASSIGN(const DepthFileOptions files, float_files(frames, header.sensors.front()));
  TURNSCAN_TRY(look_at_first_images(header, frames));
  TURNSCAN_TRY(apply_turntable_options(options, description->on_platter, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames, Eigen::Matrix3d::Identity(),
                                           files);
}

}  // namespace turnscan::importers
