#pragma once
// Data sets of other programs as frame sequences. docs/reference/importing.md describes the
// layouts. Units and depth scales come from the format's definition or from the options; if neither
// gives them, the import fails with a message that asks for them.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

enum class ImportFormat {
  kAuto,
  kStanfordConf,
  kCloudFolder,
  kTumRgbd,
  kFramePose,
  kJsonPng,
  kMatroska,
  kOpen3dRgbd,
  kRecord3d,
  kSens,
  kScannerApp,
  kRtabmap,
  kRosbag,
  kKlg,
  kNerfstudio,
  kBop,
  kDepthFolder
};
enum class LengthUnit { kAuto, kMetre, kMillimetre, kCentimetre, kMicrometre, kInch };
enum class PoseDirection { kAuto, kCameraToWorld, kWorldToCamera };
/// Use of poses that the device tracked itself. kAuto: used if it moved.
enum class DevicePoses { kAuto, kUse, kIgnore };
/// Minimum confidence of a return, as rated by the device. kAuto: medium.
enum class Confidence { kAuto, kLow, kMedium, kHigh };

struct ImportOptions {
  ImportFormat format = ImportFormat::kAuto;
  std::string topic;                          ///< of a bag's depth images
  std::string angles;                         ///< file with a cloud folder's angles or times
  std::optional<double> depth_unit_m;         ///< per step of the depth images
  LengthUnit point_unit = LengthUnit::kAuto;  ///< of scans
  std::string axes;                           ///< of scans, such as "rdf"; empty: found
  std::string intrinsics;        ///< "fx,fy,cx,cy" or a file, see text::parse_camera_file()
  std::string iai_kinect2;       ///< folder of a calibration, see iai_kinect2.hpp
  std::string sensor_position;   ///< of scans: "x,y,z" with units
  std::string sensor_direction;  ///< of scans: "x,y,z" from the surface to the sensor
  PoseDirection pose_direction = PoseDirection::kAuto;
  DevicePoses device_poses = DevicePoses::kAuto;
  Confidence min_confidence = Confidence::kAuto;  ///< returns with less confidence are dropped
  std::string world_up;                           ///< "x,y,z" in the world of the poses; empty: +Y
  bool clockwise = false;        ///< angles and speed are clockwise seen from above
  std::optional<double> fps;     ///< frames per second, for layouts without times
  std::string turntable_axis;    ///< "x,y,z", up, frame of sensor 0
  std::string turntable_center;  ///< "x,y,z" with units, frame of sensor 0
  std::optional<double> turntable_radius_m;
  /// Height of the platter above the given point on the axis.
  std::optional<double> platter_height_m;
  std::optional<double> speed_rad_s;

  Result<> check() const;
};

/// Names, ranges and help of the fields; keeps a reference to options.
OptionTable describe(ImportOptions& options);

/// A layout that can be imported.
struct ImporterInfo {
  ImportFormat format;
  std::string_view name;  ///< as in the option "format"
  std::string_view help;
};
const std::vector<ImporterInfo>& importer_list();

/// Opens a data set. path is a file (.conf, .json, .mkv, .bag, .r3d, .sens) or a folder. Files are
/// read when frames are read; read() may be called from several threads. Assumptions are listed in
/// header().source, one line each after the first. Depth images: 65535 of a foreign image becomes
/// kNoReturn. Fails with kNotFound (no such path, or a referenced file is missing), kUnsupported
/// (the layout is not recognised), kInvalidOption (an option is invalid or does not apply to the
/// layout), kMissingData (a unit, intrinsics or the like must be given), kFormat, kResourceLimit
/// and kCancelled.
Result<std::unique_ptr<FrameSequence>> open_foreign(const std::filesystem::path& path,
                                                    const ImportOptions& options,
                                                    const RunContext& context = RunContext());

/// Whether path is a file or folder of a layout that open_foreign() recognises without options.
bool is_foreign(const std::filesystem::path& path);

/// One or more data sets as the passes of one object, numbered consecutively from 0. Poses of
/// frames, if any, are valid within their pass. Fails as open_foreign() does, and with
/// kInvalidOption if their sensors or turntables differ.
Result<std::unique_ptr<FrameSequence>> open_foreign_passes(
    const std::vector<std::filesystem::path>& paths, const ImportOptions& options,
    const RunContext& context = RunContext());

}  // namespace turnscan
