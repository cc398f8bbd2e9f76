#include <turnscan/workflow/simulation/truth_files.hpp>

#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/calibration_file.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kKnown = "known to the simulator";

Json matrix_json(const Pose& T) {
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r) {
    Json row = Json::array();
    for (int c = 0; c < 4; ++c) row.push_back(T.matrix()(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string poses_csv(const VirtualPasses& scan) {
  std::string text = "index,time_s,sensor,pass,angle_deg,tx,ty,tz,qx,qy,qz,qw\n";
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    const FrameInfo& frame = scan.frames()[i];
    const auto [pass, there] = scan.place_of(i);
    const Pose T = scan.pass(pass).T_table_sensor(there);
    const Vec3d t = T.translation();
    const Eigen::Quaterniond q(T.linear());
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", frame.index, frame.time_s,
                    frame.sensor, frame.pass, scan.pass(pass).angle_rad(there) * kDegreesPerRadian,
                    t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

Calibration calibration_of(const VirtualPasses& scan) {
  Calibration calibration;
  calibration.method = CalibrationMethod::kMotion;
  calibration.table = scan.pass(0).turntable();
  calibration.axis_sigma_rad = calibration.center_sigma_m = calibration.height_sigma_m =
      calibration.radius_sigma_m = calibration.speed_sigma_rad_s = 0.0;
  calibration.axis_found = calibration.center_found = calibration.height_found =
      calibration.radius_found = calibration.angles_found = kKnown;
  if (calibration.table.speed_rad_s) calibration.speed_found = "mean over the recording";
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    const auto [pass, there] = scan.place_of(i);
    calibration.angles_rad.push_back(scan.pass(pass).angle_rad(there));
    calibration.angle_sigma_rad.push_back(0.0);
  }
  return calibration;
}

Json object_json(const VirtualScan& scan, const PlacedObject& placed) {
  return {{"scale", placed.scale},
          {"T_table_object", matrix_json(scan.T_table_given() * placed.T_table_object)}};
}

std::string truth_json(const VirtualPasses& scan, const std::vector<PlacedObject>& placed) {
  auto out = Json::object();
  out["format"] = "turnscan truth";
  out["software"] = std::string("turnscan ") + version();
  if (!placed.empty()) out["object"] = object_json(scan.pass(0), placed[0]);
  if (placed.size() > 1) out["next_passes"] = Json::array();
  for (std::size_t k = 1; k < placed.size(); ++k)
    out["next_passes"].push_back(object_json(scan.pass(k), placed[k]));
  out["sensors"] = Json::array();
  for (std::size_t k = 0; k < scan.header().sensors.size(); ++k) {
    auto sensor = Json::object();
    sensor["model"] = scan.header().sensors[k].model;
    // The frames of the first instant are ordered by sensor.
    sensor["T_table_sensor"] = matrix_json(scan.pass(0).T_table_sensor(k));
    out["sensors"].push_back(std::move(sensor));
  }
  return out.dump(2) + "\n";
}

Result<> write_files(const fs::path& folder, const VirtualPasses& scan,
                     const SceneDescription& scene, const std::vector<PlacedObject>& placed) {
  TURNSCAN_TRY(write_file_atomically(folder / "poses.csv", poses_csv(scan)));
  TURNSCAN_TRY(write_calibration(folder / "calibration.json", calibration_of(scan)));
  TURNSCAN_TRY(write_file_atomically(folder / "truth.json", truth_json(scan, placed)));
  TURNSCAN_TRY(write_file_atomically(folder / "scene.toml", scene_toml(scene)));
  for (std::size_t k = 0; k < placed.size(); ++k)
    TURNSCAN_TRY(write_meshes(
        folder / (k == 0 ? std::string("object.ply") : fmt::format("object-pass{}.ply", k)),
        scan.pass(k).objects()));
  return {};
}

}  // namespace

Result<> write_truth(const fs::path& folder, const VirtualPasses& scan,
                     const SceneDescription& scene, const std::vector<PlacedObject>& placed) {
  TURNSCAN_ASSIGN(const file::Folder recording, file::Folder::open(folder));
  TURNSCAN_ASSIGN(const file::Folder truth, recording.make_subfolder("truth"));
  auto written = write_files(truth.anchor(), scan, scene, placed);
  if (written) return {};
  (void)recording.remove("truth");
  Error error = std::move(written).error();
  if (!error.path.empty()) error.path = (truth.path() / fs::path(error.path).filename()).string();
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace turnscan
