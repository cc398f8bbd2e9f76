#include <algorithm>
#include <array>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/file/random_access_file.hpp>
#include <turnscan/io/import/importers.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/matroska/matroska.hpp>
#include <turnscan/io/rosbag/bag_file.hpp>
#include <turnscan/io/sens/sens_file.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

struct Importer {
  ImporterInfo info;
  OpenResult (*open)(const fs::path&, const ImportOptions&, const RunContext&);
  /// Options that apply to the layout, in addition to "format" and the turntable's.
  std::vector<std::string_view> options;
};

const std::vector<Importer>& table() {
  static const std::vector<Importer> importers = {
      {{ImportFormat::kStanfordConf, "stanford-conf",
        "range scans with a Stanford .conf (bmesh and mesh lines)"},
       open_stanford_conf,
       {"point-unit", "sensor-position", "sensor-direction", "world-up"}},
      {{ImportFormat::kCloudFolder, "cloud-folder",
        "PLY, PCD or text scans (.xyz, .asc, .txt, .pts) with a table of angles"},
       open_cloud_folder,
       {"angles", "point-unit", "axes", "sensor-position", "sensor-direction", "pose-direction",
        "world-up", "clockwise"}},
      {{ImportFormat::kTumRgbd, "tum", "TUM RGB-D folder (depth.txt, rgb.txt, groundtruth.txt)"},
       open_tum,
       {"depth-unit", "intrinsics", "iai-kinect2", "world-up", "clockwise"}},
      {{ImportFormat::kFramePose, "frame-pose",
        "frame-N.depth.png with frame-N.pose.txt and camera-intrinsics.txt"},
       open_frame_pose,
       {"depth-unit", "intrinsics", "iai-kinect2", "pose-direction", "world-up"}},
      {{ImportFormat::kJsonPng, "json-png", "depth_N.png described by a JSON file"},
       open_json_png,
       {"depth-unit", "iai-kinect2", "pose-direction", "world-up", "clockwise"}},
      {{ImportFormat::kMatroska, "matroska", "recording .mkv of an Azure Kinect or a Femto"},
       open_matroska,
       {"depth-unit", "intrinsics", "clockwise"}},
      {{ImportFormat::kOpen3dRgbd, "open3d-rgbd",
        "folder of Open3D's recorders (color/, depth/, intrinsic.json)"},
       open_open3d_rgbd,
       {"depth-unit", "intrinsics", "fps", "clockwise"}},
      {{ImportFormat::kRecord3d, "record3d", "Record3D recording of an iPhone or iPad (.r3d)"},
       open_record3d,
       {"min-confidence", "device-poses", "world-up", "clockwise"}},
      {{ImportFormat::kSens, "sens", "ScanNet or SUN3D recording (.sens)"},
       open_sens,
       {"device-poses", "world-up", "clockwise"}},
      {{ImportFormat::kScannerApp, "3d-scanner-app",
        "3D Scanner App's export (frame_N.json, depth_N.png, conf_N.png)"},
       open_scanner_app,
       {"min-confidence", "device-poses", "world-up", "clockwise"}},
      {{ImportFormat::kRtabmap, "rtabmap", "RTAB-Map's export (NAME_depth, NAME_rgb, NAME_calib)"},
       open_rtabmap,
       {"depth-unit", "device-poses", "world-up", "clockwise"}},
      {{ImportFormat::kRosbag, "rosbag",
        "bag of ROS 1 or 2, of a RealSense or with images of depth (.bag, .mcap, .db3, folder)"},
       open_rosbag,
       {"depth-unit", "intrinsics", "topic", "clockwise"}},
      {{ImportFormat::kKlg, "klg", "recording of Logger2 for ElasticFusion (.klg)"},
       open_klg,
       {"depth-unit", "intrinsics", "clockwise"}},
      {{ImportFormat::kNerfstudio, "nerfstudio",
        "nerfstudio's transforms.json with depth (also of Polycam and Record3D)"},
       open_nerfstudio,
       {"depth-unit", "device-poses", "world-up", "fps", "clockwise"}},
      {{ImportFormat::kBop, "bop", "scene of the BOP benchmark (scene_camera.json, depth/)"},
       open_bop,
       {"depth-unit", "world-up"}},
      {{ImportFormat::kDepthFolder, "depth-folder",
        "depth images (PNG, TIFF, EXR, PGM, NPY or snapshots of RealSense Viewer, in the folder or "
        "its "
        "depth/) and the camera's intrinsics"},
       open_depth_folder,
       {"depth-unit", "intrinsics", "fps", "angles", "pose-direction", "world-up", "clockwise"}}};
  return importers;
}

bool any_ends_with(const std::vector<std::string>& names, std::string_view ending) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return name.ends_with(ending); });
}

/// Of clouds. Text files (.txt) are read where a table names them.
constexpr std::array<const char*, 5> kCloudEndings{".ply", ".pcd", ".xyz", ".asc", ".pts"};

/// kAuto: not recognised.
ImportFormat recognise_folder(const std::vector<std::string>& names, const ImportOptions& options) {
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool clouds = std::any_of(kCloudEndings.begin(), kCloudEndings.end(),
                                  [&](const char* ending) { return any_ends_with(names, ending); });
  const auto any = [&](const auto& fits) { return std::any_of(names.begin(), names.end(), fits); };
  const bool images = has("depth") || any(is_depth_name);
  if (!options.angles.empty())
    return images && !clouds ? ImportFormat::kDepthFolder : ImportFormat::kCloudFolder;
  if (any(rosbag::is_part_name)) return ImportFormat::kRosbag;
  if (has("scene_camera.json")) return ImportFormat::kBop;
  if (has("transforms.json")) return ImportFormat::kNerfstudio;
  if (has("depth.txt")) return ImportFormat::kTumRgbd;
  if (has("depth") && (has("intrinsic.json") || has("camera_intrinsic.json")))
    return ImportFormat::kOpen3dRgbd;
  if (any_ends_with(names, ".conf")) return ImportFormat::kStanfordConf;
  const bool frame_pose = std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.starts_with("frame-") && name.ends_with(".depth.png");
  });
  if (frame_pose) return ImportFormat::kFramePose;
  if (any(is_scanner_app_frame)) return ImportFormat::kScannerApp;
  if (any(is_rtabmap_depth_folder) && (has("calib") || !has("depth")))
    return ImportFormat::kRtabmap;
  if (any_ends_with(names, ".json") && any(is_depth_name)) return ImportFormat::kJsonPng;
  if (clouds) return ImportFormat::kCloudFolder;
  return images ? ImportFormat::kDepthFolder : ImportFormat::kAuto;
}

/// Recognises a file by its first bytes; kAuto: not recognised.
/// Since many files are zip archives (3MF, documents), the name of the first entry is checked.
bool begins_as_record3d(std::string_view begin) {
  constexpr std::size_t kNameAt = 30;  // in a local header
  if (!begin.starts_with("PK\3\4") || begin.size() <= kNameAt) return false;
  const std::string_view name = begin.substr(kNameAt);
  return name.starts_with("metadata") || name.starts_with("rgbd/");
}

ImportFormat recognise_file(const fs::path& path) {
  if (path.extension() == ".mkv" || matroska::is_matroska_file(path))
    return ImportFormat::kMatroska;
  if (path.extension() == ".klg") return ImportFormat::kKlg;
  const auto file = file::RandomAccessFile::open(path);
  if (!file) return ImportFormat::kAuto;
  const auto begin = file->read(0, std::min<std::uint64_t>(file->size(), 64));
  if (!begin) return ImportFormat::kAuto;
  if (path.extension() == ".r3d" || begins_as_record3d(*begin)) return ImportFormat::kRecord3d;
  if (sens::looks_like_sens(*begin)) return ImportFormat::kSens;
  if (rosbag::looks_like_bag(*begin)) return ImportFormat::kRosbag;
  return ImportFormat::kAuto;
}

bool is_mesh_name(const fs::path& path) {
  constexpr std::array<std::string_view, 11> kEndings{"ply",  "obj", "stl", "off", "3mf", "glb",
                                                      "gltf", "pcd", "xyz", "asc", "pts"};
  const std::string ending = file::lower_extension(path);
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

/// What is met and not read, with what to do about it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kNotRead{
    {{"npz", "write depth as 16-bit PNG or NPY, an image a file, to import it"},
     {"pfm", "write depth as 32-bit TIFF or NPY to import it"},
     {"bin", "write depth as 16-bit PNG or NPY to import it"},
     {"jpg", "JPEG cannot hold depth: write it as 16-bit PNG"},
     {"zip", "unpack it, and import the folder"},
     {"e57", "write its scans as PLY, e.g. with CloudCompare, a file each"},
     {"ptx", "write its scans as PLY, e.g. with CloudCompare, a file each"},
     {"las", "write its scans as PLY, e.g. with CloudCompare, a file each"},
     {"stl", "meshes do not say from where they were seen: import the scans as PLY"},
     {"obj", "meshes do not say from where they were seen: import the scans as PLY"},
     {"oni", "write its images as 16-bit PNG"},
     {"mp4", "a video has no depth"},
     // Last, because tables of angles have it, too.
     {"csv", "write depth as 16-bit PNG or NPY to import it"}}};

/// Description of an unrecognised path for the error.
Result<std::string> what_is_there(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    const std::string ending = path.extension().string();
    for (const auto& [kind, advice] : kNotRead)
      if (file::lower_extension(path) == kind) return fmt::format("a {} file ({})", ending, advice);
    return ending.empty() ? "a file without an ending" : fmt::format("a {} file", ending);
  }
  TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(path));
  if (names.empty()) return std::string("an empty folder");
  for (const auto& [kind, advice] : kNotRead)
    if (file::lower_extension(names.front()) == kind || file::lower_extension(names.back()) == kind)
      return fmt::format("a folder of .{} files ({})", kind, advice);
  return fmt::format("a folder of {} entries such as {}", names.size(), names.front());
}

Result<ImportFormat> recognise(const fs::path& path, const ImportOptions& options) {
  std::error_code error;
  ImportFormat format = ImportFormat::kAuto;
  if (fs::is_directory(path, error)) {
    TURNSCAN_ASSIGN(const std::vector<std::string> names, names_in(path));
    if (std::find(names.begin(), names.end(), "recording.json") != names.end())
      return fail_at(path.string(), ErrorCode::kUnsupported,
                     "this is a turnscan recording already; it needs no import");
    format = recognise_folder(names, options);
  } else if (path.extension() == ".conf") {
    format = ImportFormat::kStanfordConf;
  } else if (path.extension() == ".json") {
    format = path.filename().string().starts_with("transforms") ? ImportFormat::kNerfstudio
                                                                : ImportFormat::kJsonPng;
  } else {
    format = recognise_file(path);
  }
  if (format != ImportFormat::kAuto) return format;
  if (is_mesh_name(path))
    return fail_at(path.string(), ErrorCode::kUnsupported,
                   "this is a mesh or a point cloud already, not a recording; use it with "
                   "'turnscan info', 'turnscan evaluate' or 'turnscan render'");
  TURNSCAN_ASSIGN(const std::string found, what_is_there(path));
  return fail_at(path.string(), ErrorCode::kUnsupported,
                 "{}, which is neither a recording nor a mesh, nor a layout that can be imported; "
                 "'turnscan import --list' shows the layouts",
                 found);
}

std::vector<std::string_view> stated_options(const ImportOptions& o) {
  std::vector<std::string_view> stated;
  const auto note = [&](bool is_stated, std::string_view name) {
    if (is_stated) stated.push_back(name);
  };
  note(!o.topic.empty(), "topic");
  note(!o.angles.empty(), "angles");
  note(o.depth_unit_m.has_value(), "depth-unit");
  note(o.point_unit != LengthUnit::kAuto, "point-unit");
  note(!o.axes.empty(), "axes");
  note(!o.intrinsics.empty(), "intrinsics");
  note(!o.iai_kinect2.empty(), "iai-kinect2");
  note(!o.sensor_position.empty(), "sensor-position");
  note(!o.sensor_direction.empty(), "sensor-direction");
  note(o.pose_direction != PoseDirection::kAuto, "pose-direction");
  note(o.device_poses != DevicePoses::kAuto, "device-poses");
  note(o.min_confidence != Confidence::kAuto, "min-confidence");
  note(!o.world_up.empty(), "world-up");
  note(o.clockwise, "clockwise");
  note(o.fps.has_value(), "fps");
  return stated;
}

/// An option that would be silently ignored is an error.
Result<> check_meaning(const Importer& importer, const ImportOptions& options) {
  for (const std::string_view name : stated_options(options)) {
    const auto& used = importer.options;
    if (std::find(used.begin(), used.end(), name) == used.end())
      return fail(ErrorCode::kInvalidOption,
                  "{} has no meaning for the layout {} ({}); leave it out, or state another "
                  "format",
                  name, importer.info.name, importer.info.help);
  }
  return {};
}

}  // namespace

}  // namespace turnscan::importers

namespace turnscan {

using namespace importers;
namespace fs = std::filesystem;

Result<> ImportOptions::check() const {
  ImportOptions copy = *this;
  return describe(copy).check();
}

OptionTable describe(ImportOptions& o) {
  OptionTable table;
  table.choice("format", o.format,
               {"auto", "stanford-conf", "cloud-folder", "tum", "frame-pose", "json-png",
                "matroska", "open3d-rgbd", "record3d", "sens", "3d-scanner-app", "rtabmap",
                "rosbag", "klg", "nerfstudio", "bop", "depth-folder"},
               "Layout of the data set; auto recognises it by its files");
  table.text("topic", o.topic, "Topic of a ROS bag's depth images, where several hold depth");
  table.text(
      "angles", o.angles,
      "Table of a folder of scans or images, with the columns file,angle_deg or file,time_s, or "
      "of poses: file,tx,ty,tz,qx,qy,qz,qw");
  table.number("depth-unit", o.depth_unit_m, Quantity::kLength, {1e-7, 1.0},
               "Length of one step of the depth images; auto takes it from the data set");
  table.choice("point-unit", o.point_unit, {"auto", "m", "mm", "cm", "um", "in"},
               "Unit of the coordinates of scans; auto takes it from the layout's definition");
  table.text(
      "axes", o.axes,
      "Where x, y and z of scans point, seen by the scanner, e.g. rdf (right, down, forward: "
      "PCL, Open3D, ROS), rub (OpenGL), ruf (Unity); found where they are right-handed");
  table.text(
      "intrinsics", o.intrinsics,
      "Camera as fx,fy,cx,cy in pixels, or a file with its 3x3 matrix or a calibration of OpenCV "
      "or ROS (YAML, JSON)");
  table.text("iai-kinect2", o.iai_kinect2,
             "Folder with a Kinect v2's calibration in the layout of iai_kinect2: cameras and "
             "depth offset are taken from there");
  table.text("sensor-position", o.sensor_position,
             "Position of the scanner in the frame of its scans: x,y,z with units");
  table.text("sensor-direction", o.sensor_direction,
             "Direction x,y,z from the surface to a scanner with parallel rays");
  table.choice("pose-direction", o.pose_direction, {"auto", "camera-to-world", "world-to-camera"},
               "Direction in which the poses map points; auto is camera-to-world");
  table.choice("device-poses", o.device_poses, {"auto", "use", "ignore"},
               "Poses that a phone or hand-held sensor tracked itself; auto ignores them if it "
               "stood still and uses them if it moved");
  table.choice(
      "min-confidence", o.min_confidence, {"auto", "low", "medium", "high"},
      "Lowest confidence, as the device rates it, of returns that are kept; auto is medium");
  table.text("world-up", o.world_up,
             "Direction x,y,z that is up in the world of the poses; without it, +y");
  table.flag("clockwise", o.clockwise,
             "Angles and speed count clockwise seen from above (else counter-clockwise)");
  table.number("fps", o.fps, Quantity::kNone, {1e-3, 1e6},
               "Frames a second, for folders of images that do not say their times");
  table.text("turntable-axis", o.turntable_axis,
             "Direction x,y,z of the rotation axis, upwards, in the frame of sensor 0");
  table.text("turntable-center", o.turntable_center,
             "Centre of the platter's surface, x,y,z with units, in the frame of sensor 0");
  table.number("turntable-radius", o.turntable_radius_m, Quantity::kLength, {1e-3, 100.0},
               "Radius of the cylinder above the platter that is kept");
  table.number("platter-height", o.platter_height_m, Quantity::kLength, {-100.0, 100.0},
               "Height of the platter's surface above the given point of the axis, up positive");
  table.number("speed", o.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
               "Speed of the turntable, counter-clockwise seen from above is positive");
  return table;
}

const std::vector<ImporterInfo>& importer_list() {
  static const std::vector<ImporterInfo> infos = [] {
    std::vector<ImporterInfo> out;
    for (const Importer& importer : table()) out.push_back(importer.info);
    return out;
  }();
  return infos;
}

bool is_foreign(const fs::path& path) { return bool(recognise(path, {})); }

Result<std::unique_ptr<FrameSequence>> open_foreign(const fs::path& path,
                                                    const ImportOptions& options,
                                                    const RunContext& context) {
  TURNSCAN_TRY(options.check());
  TURNSCAN_TRY(file::check_exists(path, "file or folder"));
  ImportFormat format = options.format;
  if (format == ImportFormat::kAuto) {
    TURNSCAN_ASSIGN(format, recognise(path, options));
  }
  const auto importer = std::find_if(table().begin(), table().end(),
                                     [&](const Importer& i) { return i.info.format == format; });
  TURNSCAN_TRY(check_meaning(*importer, options));
  return importer->open(path, options, context);
}

}  // namespace turnscan
