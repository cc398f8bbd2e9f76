// Imports a plain folder of depth images, NAME.png or depth/NAME.png, with whatever stands beside
// them: colour images of the same name in color/ or rgb/, a 3x3 matrix of the camera, a table of
// angles. Snapshots of Intel's RealSense Viewer are of this kind (NAME_Depth.raw and
// NAME_Depth_metadata.csv: https://github.com/IntelRealSense/librealsense, common/), and Stray
// Scanner's folders (depth/, camera_matrix.csv, odometry.csv) are of this kind:
// https://github.com/strayrobots/scanner: millimetres, and the matrix is that of the colour video.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers_capture.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

/// A principal point farther than this share of the image from its middle belongs to an image of
/// another size.
constexpr double kOffMiddle = 0.25;
constexpr double kSameShape = 0.1;
/// The most exact first.
constexpr std::array<const char*, 7> kDepthEndings{"npy", "exr", "tiff", "tif",
                                                   "raw", "pgm", "png"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether a precedes b when stretches of digits are compared as numbers.
bool precedes(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (!is_digit(a[0]) || !is_digit(b[0])) {
      if (a[0] != b[0]) return a[0] < b[0];
      a.remove_prefix(1), b.remove_prefix(1);
      continue;
    }
    const auto number = [](std::string_view& text) {
      text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
      std::size_t end = 0;
      while (end < text.size() && is_digit(text[end])) ++end;
      const std::string_view digits = text.substr(0, end);
      text.remove_prefix(end);
      return digits;
    };
    const std::string_view m = number(a), n = number(b);
    if (m.size() != n.size()) return m.size() < n.size();
    if (m != n) return m < n;
  }
  return a.size() < b.size();
}

/// Of arrays beside their pictures, or depth beside a few other files, the most frequent kind.
void keep_one_kind(std::vector<std::string>& names) {
  const auto count = [&](const char* ending) {
    return std::count_if(names.begin(), names.end(), [&](const std::string& name) {
      return file::lower_extension(name) == ending;
    });
  };
  const auto kind = std::max_element(kDepthEndings.begin(), kDepthEndings.end(),
                                     [&](auto a, auto b) { return count(a) < count(b); });
  std::erase_if(names,
                [&](const std::string& name) { return file::lower_extension(name) != *kind; });
}

struct DepthFolder {
  fs::path images;
  std::vector<std::string> names;  ///< in order
};

/// Those named after depth, where some are.
Result<DepthFolder> depth_images_in(const fs::path& folder) {
  std::error_code error;
  DepthFolder out;
  out.images = fs::is_directory(folder / "depth", error) ? folder / "depth" : folder;
  TURNSCAN_ASSIGN(out.names, names_in(out.images));
  std::erase_if(out.names, [](const std::string& name) { return !is_depth_name(name); });
  const auto of_depth = [](const std::string& name) {
    return name.find("depth") != std::string::npos || name.find("Depth") != std::string::npos ||
           name.find("DEPTH") != std::string::npos;
  };
  if (std::any_of(out.names.begin(), out.names.end(), of_depth))
    std::erase_if(out.names, [&](const std::string& name) { return !of_depth(name); });
  keep_one_kind(out.names);
  std::stable_sort(out.names.begin(), out.names.end(), precedes);
  if (out.names.empty())
    return fail_at(
        out.images.string(), ErrorCode::kTooFewPoints,
        "there are no depth images (PNG, PGM, TIFF, EXR, NPY or RealSense Viewer's .raw)");
  return out;
}

Result<fs::path> color_beside(const fs::path& folder, const std::string& name) {
  const std::string stem = fs::path(name).stem().string();
  for (const char* beside : {"color", "rgb"}) {
    for (const char* ending : {".jpg", ".png", ".jpeg"}) {
      fs::path path = folder / beside / (stem + ending);
      TURNSCAN_ASSIGN(const bool there, file::is_there(path));
      if (there) return path;
    }
  }
  return fs::path();
}

Result<> put_angles(const fs::path& path, const ImportOptions& options, const fs::path& folder,
                    std::vector<ForeignFrame>& frames, const RunContext& context) {
  TURNSCAN_ASSIGN(const std::vector<text::AngleRow> rows, read_angle_table(path));
  std::map<std::string, const text::AngleRow*> of_name;
  for (const text::AngleRow& row : rows) of_name[fs::path(row.file).filename().string()] = &row;
  for (ForeignFrame& frame : frames) {
    TURNSCAN_TRY(context.check());
    const auto row = of_name.find(frame.data.filename().string());
    if (row == of_name.end())
      return fail_at(path.string(), ErrorCode::kMissingData, "the table does not name {}",
                     frame.data.lexically_relative(folder).string());
    const text::AngleRow& known = *row->second;
    if (known.angle_rad)
      frame.info.angle_rad = options.clockwise ? -*known.angle_rad : *known.angle_rad;
    if (known.time_s) frame.info.time_s = *known.time_s;
    if (known.T_world_scan) {
      TURNSCAN_ASSIGN(frame.info.T_table_sensor, placed_pose(*known.T_world_scan, options));
    }
    frame.info.pass = known.pass;
  }
  return {};
}

/// The camera, with the size of its images, in the table beside a snapshot of RealSense Viewer:
/// lines of a name and a value.
Result<CameraIntrinsics> snapshot_camera(const fs::path& snapshot) {
  const fs::path table = snapshot.parent_path() / (snapshot.stem().string() + "_metadata.csv");
  TURNSCAN_ASSIGN(const bool there, file::is_there(table));
  if (!there)
    return fail_at(snapshot.string(), ErrorCode::kMissingData,
                   "bare numbers do not say the size of their image: beside it must lie {}, as "
                   "RealSense Viewer writes it",
                   table.filename().string());
  TURNSCAN_ASSIGN(const std::string text, read_file(table, kMaxTextBytes));
  CameraIntrinsics out;
  double width = 0.0, height = 0.0;
  const std::map<std::string_view, double*> wanted{
      {"Resolution x", &width}, {"Resolution y", &height}, {"Fx", &out.fx},
      {"Fy", &out.fy},          {"PPx", &out.cx},          {"PPy", &out.cy}};
  text::LineReader lines(text);
  while (const auto line = lines.next_content()) {
    const std::size_t comma = line->text.find(',');
    const auto field = wanted.find(text::trimmed(line->text.substr(0, comma)));
    if (comma == line->text.npos || field == wanted.end()) continue;
    const auto value = parse_number(text::trimmed(line->text.substr(comma + 1)));
    if (!value) return at_path(table, value.error());
    *field->second = *value;
  }
  if (!(width >= 1.0 && height >= 1.0 && width <= 65535.0 && height <= 65535.0))
    return fail_at(table.string(), ErrorCode::kFormat,
                   "it does not say the size of the image (Resolution x, Resolution y)");
  out.width = int(width);
  out.height = int(height);
  return out;
}

Result<CameraIntrinsics> required_intrinsics(const fs::path& folder) {
  TURNSCAN_ASSIGN(const std::optional<CameraIntrinsics> beside, intrinsics_beside(folder));
  if (beside) return *beside;
  return fail_at(folder.string(), ErrorCode::kMissingData,
                 "the depth images do not say the intrinsics of their camera; state them: "
                 "--intrinsics fx,fy,cx,cy");
}

/// Intrinsics of a larger or smaller image of the same view are scaled to the depth image.
/// Their size is stated, or told by the principal point.
void fit_to_image(const DepthImage& image, CameraIntrinsics& camera, SequenceHeader& header) {
  const bool stated = camera.width > 0;
  const double width = stated ? camera.width : 2.0 * camera.cx;
  const double height = stated ? camera.height : 2.0 * camera.cy;
  const double across = width / image.width, along = height / image.height;
  if (std::abs(across - 1.0) < (stated ? 1e-9 : 2.0 * kOffMiddle) || !(width > 0.0) ||
      std::abs(across / along - 1.0) > kSameShape)
    return;
  add_note(header, fmt::format("the intrinsics are those of images of {}{:.0f} x {:.0f} pixels: "
                               "they were scaled to depth's {} x {}",
                               stated ? "" : "about ", width, height, image.width, image.height));
  for (double* value : {&camera.fx, &camera.cx}) *value /= across;
  for (double* value : {&camera.fy, &camera.cy}) *value /= along;
}

void note_depth_files(const DepthFile& first, const DepthFileOptions& files,
                      SequenceHeader& header) {
  if (first.floats)
    add_note(header, fmt::format("depth was rounded to steps of 0.1 mm from numbers in {}{}",
                                 format_quantity(files.float_unit_m, Quantity::kLength),
                                 files.float_unit_m == 1.0 ? ", as is usual" : ""));
  if (first.eight_bits)
    add_note(header,
             "the depth images have 8 bits: they are coarse at best, and may be pictures of depth "
             "rather than depth");
}

}  // namespace

bool is_depth_name(std::string_view name) {
  return std::any_of(kDepthEndings.begin(), kDepthEndings.end(),
                     [&](const char* ending) { return file::lower_extension(name) == ending; });
}

OpenResult open_depth_folder(const fs::path& folder, const ImportOptions& options,
                             const RunContext& context) {
  TURNSCAN_ASSIGN(const DepthFolder depth, depth_images_in(folder));
  SequenceHeader header;
  header.source = fmt::format("depth images of {}", display_name(folder));
  SensorInfo sensor;
  DepthFileOptions files{1.0, true};
  if (file::lower_extension(depth.names.front()) == "raw") {
    TURNSCAN_ASSIGN(sensor.intrinsics, snapshot_camera(depth.images / depth.names.front()));
    files.bare_rows = std::uint32_t(sensor.intrinsics.height);
    files.bare_columns = std::uint32_t(sensor.intrinsics.width);
  }
  if (!options.intrinsics.empty() || !(sensor.intrinsics.fx > 0.0)) {
    TURNSCAN_ASSIGN(sensor.intrinsics, options.intrinsics.empty() ? required_intrinsics(folder)
                                                                  : stated_intrinsics(options));
  }
  TURNSCAN_ASSIGN(const bool stray, file::is_there(folder / "odometry.csv"));
  TURNSCAN_ASSIGN(const DepthFile first,
                  read_depth_file(depth.images / depth.names.front(), files));
  files.float_unit_m = options.depth_unit_m.value_or(1.0);
  TURNSCAN_ASSIGN(sensor.depth_unit_m,
                  depth_scale(options, stray          ? std::optional(1e-3)
                                       : first.floats ? std::optional(kFloatDepthStep_m)
                                                      : std::nullopt));
  if (first.floats) sensor.depth_unit_m = kFloatDepthStep_m;
  note_depth_files(first, files, header);
  TURNSCAN_ASSIGN(const bool poses, file::is_there(folder / "pose"));
  if (poses && options.angles.empty())
    add_note(header,
             "the folder's pose/ is not read; a table of them is (--angles, with the columns file, "
             "tx, ty, tz, qx, qy, qz, qw)");
  std::vector<ForeignFrame> frames;
  for (const std::string& name : depth.names) {
    TURNSCAN_TRY(context.check());
    ForeignFrame& frame = frames.emplace_back();
    frame.info.index = std::uint32_t(frames.size() - 1);
    if (options.fps) frame.info.time_s = double(frame.info.index) / *options.fps;
    frame.data = depth.images / name;
    frame.info.file = frame.data.lexically_relative(folder).string();
    TURNSCAN_ASSIGN(frame.color, color_beside(folder, name));
  }
  if (!options.angles.empty())
    TURNSCAN_TRY(put_angles(options.angles, options, folder, frames, context));
  fit_to_image(first.image, sensor.intrinsics, header);
  sensor.intrinsics.width = first.image.width;
  sensor.intrinsics.height = first.image.height;
  header.sensors.push_back(sensor);
  drop_without_pose(frames, header);
  if (!options.fps && options.angles.empty())
    add_note(
        header,
        "the images say neither times nor angles: state --fps or --angles where they are known");
  TURNSCAN_TRY(look_at_first_images(header, frames));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<ForeignSequence>(std::move(header), frames, Eigen::Matrix3d::Identity(),
                                           files);
}

}  // namespace turnscan::importers
