#pragma once
// The complete description of a simulated recording in the form that users write: on the command
// line, or in one TOML file.

#include <filesystem>
#include <string>
#include <string_view>
#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// A scanner as it is and where it stands.
struct ScannerSetup {
  ScannerParameters parameters;
  ScannerPlacement placement;
};

/// The options of its place, and all keys of a scanner's file.
OptionTable describe(ScannerSetup& setup);

/// A preset or file, and values of its own for any of describe(ScannerSetup&):
/// "kinect-v2,azimuth=90deg,far=2m".
struct ScannerEntry {
  std::string model;
  std::vector<std::pair<std::string, std::string>> options;  ///< names, values
};

/// With the common place where the entry has none of its own. Fails as find_scanner, and with
/// kInvalidOption.
Result<ScannerSetup> scanner_setup(const ScannerEntry& entry, const ScannerPlacement& common);

/// Fails with kInvalidOption. Whether the scanner exists is checked later.
Result<ScannerEntry> parse_scanner_entry(std::string_view text);

/// Placement of the object in a further pass: names of ObjectPlacement's options and values, for
/// those that differ from the first. Its height does not change.
using PassEntry = std::vector<std::pair<std::string, std::string>>;

/// "tip=90deg,yaw=30deg". Fails with kInvalidOption.
Result<PassEntry> parse_pass_entry(std::string_view text);

struct SceneDescription {
  SceneDescription();

  std::string object;  ///< file or builtin:NAME; builtin:empty for the table alone
  std::string unit;    ///< of the object's file if that does not specify it
  ObjectPlacement object_placement;
  std::vector<PassEntry> next_passes;
  std::vector<ScannerEntry> scanners;  ///< empty: kinect-v2
  ScannerPlacement placement;          ///< of every scanner, except for its own options
  MotionOptions motion;
  PlatterOptions platter;  ///< 12 mm thick by default
  TablePlacement table;
  RoomOptions room;
  ObjectMove object_move;
  HandOptions hand;
  MeasureOptions measure;
  RecordOptions record;
  ColorCameraOptions color_camera;
};

struct SceneTable {
  std::string name;   ///< of the table in the file
  std::string title;  ///< for display
  OptionTable options;
};

/// All options but object, unit and scanners, by table. They refer to the description.
std::vector<SceneTable> describe(SceneDescription& scene);

/// Adds the contents of a file: the tables of describe(), in [object] also `file` and `unit`, and
/// [[scanner]] with `model` and any of describe(ScannerSetup&), [[pass]] with any of [object]
/// for each pass after the first. Paths are relative to the file's folder. Fails with kNotFound or
/// kInvalidOption, naming file and line.
Result<> read_scene(const std::filesystem::path& file, SceneDescription& scene);

/// The same from the text of such a file. `file` is its name in errors, and the base of its paths.
Result<> parse_scene(std::string_view text, const std::filesystem::path& file,
                     SceneDescription& scene);

/// The description as a file that read_scene can read; lengths and angles to 6 digits.
std::string scene_toml(const SceneDescription& scene);

/// Placement of the object in each pass, including the first. Fails with kInvalidOption.
Result<std::vector<ObjectPlacement>> pass_placements(const SceneDescription& scene);

/// Looks up the scanners. Fails with kNotFound or kInvalidOption.
Result<VirtualScanOptions> scan_options(const SceneDescription& scene);

}  // namespace turnscan
