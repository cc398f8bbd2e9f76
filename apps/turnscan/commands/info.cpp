#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/repair.hpp>
#include <turnscan/recording/summary.hpp>

#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/text/mesh_text.hpp>
#include <turnscan/workflow/text/shown_text.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

class InfoCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positional("RECORDING|MESH", path_,
                    "Recording, mesh or point cloud, or a data set that turnscan import reads");
    line.flag("--repair", repair_,
              "Finish an interrupted recording: keep every whole frame, mark it complete and "
              "report what was lost");
    line.flag("--json", json_, "Print JSON, SI units in the names");
    line.repeatable("--import", "NAME=VALUE", import_, kImportOptionsHelp);
    line.option("--unit", "UNIT", unit_,
                "Unit of a mesh or cloud file that does not say it: um, mm, cm, m, in");
  }

  FileRoles files() const override { return {{path_}, {}}; }

  Result<> run(Session& session) override {
    session.plan({{"look at frames"}});
    const std::filesystem::path path(path_);
    TURNSCAN_TRY(file::check_exists(path, "file or folder"));
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) return about_recording(path, session);
    if (path.filename() == "recording.json") return about_recording(path.parent_path(), session);
    if (repair_)
      return fail(ErrorCode::kInvalidOption,
                  "--repair: {} is not a recording; give the folder of one", path_);
    if (!import_.empty() || is_foreign(path)) return about_recording(path, session);
    if (!unit_.empty()) {
      TURNSCAN_ASSIGN(metres_per_unit_, metres_per(unit_));
    }
    if (one_of(kClouds)) return about_cloud(session);
    auto meshes = read_meshes(path, {metres_per_unit_}, session.context());
    // A PLY file without triangles is a cloud.
    if (!meshes && meshes.error().code == ErrorCode::kTooFewPoints && ending_of(path_) == ".ply")
      return about_cloud(session);
    // What is no mesh may hold data that has to be unpacked or converted: import says how.
    if (!meshes && meshes.error().code == ErrorCode::kUnsupported && !one_of(kMeshes))
      return about_recording(path, session);
    if (!meshes) return tl::unexpected<Error>(meshes.error());
    return about_meshes(*meshes, session);
  }

 private:
  static constexpr std::array<std::string_view, 4> kClouds{".pcd", ".xyz", ".asc", ".pts"};
  static constexpr std::array<std::string_view, 7> kMeshes{".ply", ".stl", ".obj", ".off",
                                                           ".3mf", ".glb", ".gltf"};

  bool one_of(std::span<const std::string_view> endings) const {
    return std::find(endings.begin(), endings.end(), ending_of(path_)) != endings.end();
  }

  static Result<> repair(const std::filesystem::path& folder, Session& session) {
    TURNSCAN_ASSIGN(const RepairReport report, repair_recording(folder, session.context()));
    for (const std::string& text : report.done) session.print("Repair: {}\n", text);
    for (const std::string& name : report.kept)
      session.print("Repair: the file that was replaced is kept as {}\n", name);
    session.print("Repair: {} frames are whole; the recording {}\n", report.frames,
                  report.was_complete ? "was complete already" : "is marked complete now");
    return {};
  }

  Result<> about_recording(const std::filesystem::path& path, Session& session) const {
    const std::filesystem::path folder = path.empty() ? std::filesystem::path(".") : path;
    if (repair_ && json_)
      return fail(ErrorCode::kInvalidOption,
                  "--repair and --json cannot be used together; repair "
                  "first");
    if (repair_) TURNSCAN_TRY(repair(folder, session));
    TURNSCAN_ASSIGN(const Input input, open_input_asking(folder, import_, session.context()));
    TURNSCAN_ASSIGN(const SequenceSummary summary, summarize(input, session.context()));
    session.print("{}", json_ ? summary_json(summary) + "\n" : summary_text(summary));
    return {};
  }

  Result<> about_meshes(const std::vector<TriangleMesh>& meshes, Session& session) const {
    std::vector<MeshReport> reports;
    for (const TriangleMesh& mesh : meshes) {
      TURNSCAN_TRY(session.context().check());
      reports.push_back(check_surface(mesh, session.context()));
      TURNSCAN_TRY(session.context().check());
      if (!json_) print_mesh(mesh, reports.back(), meshes.size(), session);
    }
    if (json_) session.print("{}\n", meshes_json(meshes, reports));
    return {};
  }

  void print_mesh(const TriangleMesh& mesh, const MeshReport& report, std::size_t count,
                  Session& session) const {
    const std::string name = mesh.name.empty() ? "" : fmt::format(" '{}'", shown_line(mesh.name));
    session.print("{}: {}{}\n", path_, count == 1 ? "mesh" : "one of several meshes", name);
    session.print("{} vertices{}, {} triangles in {} {}, {}\n", report.vertices,
                  mesh.colors.empty() ? "" : " with colours", report.triangles, report.components,
                  report.components == 1 ? "piece" : "pieces", size_text(bounds(mesh.vertices)));
    if (has_texture(mesh))
      session.print("A texture of {} x {} pixels\n", mesh.texture->image.width,
                    mesh.texture->image.height);
    session.print("Area {:.2f} cm2", report.area_m2 * 1e4);
    if (report.closed) session.print(", volume {:.2f} cm3", report.volume_m3 * 1e6);
    session.print("\n{}", check_sentences(report));
  }

  Result<> about_cloud(Session& session) const {
    TURNSCAN_ASSIGN(CloudFile file, read_cloud(path_));
    const double scale = metres_per_unit_.value_or(1.0);
    for (Vec3f& p : file.cloud.points) p *= static_cast<float>(scale);
    const Box box = bounds(file.cloud.points);
    const bool colored = !file.cloud.colors.empty(), normals = !file.cloud.normals.empty();
    if (json_) {
      const Vec3d size = box.size();
      const nlohmann::json json{{"kind", "cloud"},
                                {"points", file.cloud.size()},
                                {"grid", {file.grid_width, file.grid_height}},
                                {"size_m", {size.x(), size.y(), size.z()}},
                                {"colored", colored},
                                {"normals", normals}};
      session.print("{}\n", json.dump(2));
      return {};
    }
    session.print("{}: point cloud\n{} points{}{}, {}{}\n", path_, file.cloud.size(),
                  normals ? " with normals" : "", colored ? " with colours" : "", size_text(box),
                  metres_per_unit_ ? "" : " if its unit is the metre");
    if (file.grid_width > 0)
      session.print("A grid of {} x {} cells\n", file.grid_width, file.grid_height);
    return {};
  }

  std::vector<std::string> import_;
  std::string path_, unit_;
  bool json_ = false, repair_ = false;
  std::optional<double> metres_per_unit_;
};

}  // namespace

std::unique_ptr<Command> make_info_command() { return std::make_unique<InfoCommand>(); }

}  // namespace turnscan::cli
