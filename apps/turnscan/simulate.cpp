#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/atomic_file.hpp>
#include <turnscan/io/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/builtin_objects.hpp>
#include <turnscan/simulator/samples.hpp>
#include <turnscan/simulator/scanner_file.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/simulator/virtual_passes.hpp>

#include "command_line.hpp"
#include "commands.hpp"
#include "coverage_file.hpp"
#include "output_file.hpp"
#include "text_table.hpp"
#include "true_samples.hpp"
#include "truth_files.hpp"

namespace turnscan::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::string_view kBuiltin = "builtin:";
constexpr std::string_view kEmptyTable = "builtin:empty";

struct Timing {
  double prepare_s = 0.0;
  double record_s = 0.0;
};

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Removes a recording that lacks its truth; a folder that was there before stays.
void discard(const fs::path& folder, bool existed) {
  std::error_code ignored;
  if (!existed) {
    fs::remove_all(folder, ignored);
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    fs::remove_all(entry.path(), ignored);
}

class SimulateCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.optional_positional(
        "OBJECT", object_,
        fmt::format("What stands on the turntable: a mesh file, {}{}, or {} for the table alone",
                    kBuiltin, fmt::join(builtin_object_names(), fmt::format(", {}", kBuiltin)),
                    kEmptyTable));
    line.option("-o,--out", "RECORDING", out_,
                "Folder to make for the recording; it must not exist or be empty");
    line.repeatable(
        "--scanner", "SCANNER", scanners_,
        fmt::format("A preset ({}) or a file FILE.toml; may be given several times. What of its "
                    "place is its own follows behind commas: kinect-v2,azimuth=90deg (default: "
                    "kinect-v2)",
                    fmt::join(scanner_presets(), ", ")));
    line.repeatable("--next-pass", "NAME=VALUE,...", next_passes_,
                    "Another pass after the first, in the same recording: how the object lies "
                    "then, by the options of the object, e.g. tip=90deg,yaw=30deg; may be given "
                    "several times");
    line.option("--unit", "UNIT", unit_, "Unit of OBJECT if its file does not say it: mm, m, ...");
    line.option("--coverage", "FILE.ply", coverage_,
                "Write how well the scan covers the object, and why not: a coloured mesh, and "
                "beside it FILE.json. Without --out nothing is recorded");
    line.flag("--samples", samples_,
              "Also write every sample with what there was to see, into RECORDING/truth/samples");
    line.option("--report", "FILE.json", report_,
                "Write what was done as JSON: options, counts, times");
    line.file_option(
        "--scene", "FILE.toml",
        "Read everything from a TOML file: the tables below, [[scanner]], [[pass]] and the "
        "object. The command line goes before the file",
        [this](const std::string& path) { return read_scene(path, scene_); });
    for (SceneTable& table : describe(scene_))
      line.group(table.name, table.title, std::move(table.options));
    line.group("coverage", "Coverage", describe(coverage_options_));
  }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(take_arguments());
    TURNSCAN_TRY(check_outputs());
    const auto begin = Clock::now();
    TURNSCAN_ASSIGN(const VirtualScanOptions options, scan_options(scene_));
    TURNSCAN_ASSIGN(const std::vector<PlacedObject> placed, load_object(session.context()));
    TURNSCAN_ASSIGN(const VirtualPasses scan, make_passes(placed, options));
    Timing timing;
    timing.prepare_s = seconds_since(begin);
    if (!out_.empty()) TURNSCAN_TRY(record(scan, placed, session.context()));
    timing.record_s = seconds_since(begin) - timing.prepare_s;
    std::optional<CoverageMap> map;
    if (!coverage_.empty()) {
      TURNSCAN_ASSIGN(map, cover(scan, placed, options, session.context()));
    }
    if (!report_.empty()) TURNSCAN_TRY(write_file_atomically(report_, report_json(scan, timing)));
    if (!out_.empty()) tell(scan, timing, session);
    if (map) tell(*map, session);
    return {};
  }

 private:
  Result<> take_arguments() {
    if (!object_.empty()) scene_.object = object_;
    if (!unit_.empty()) scene_.unit = unit_;
    if (scene_.object.empty())
      return fail(ErrorCode::kInvalidOption,
                  "OBJECT: missing; give a mesh file, a built-in object or a scene that names one");
    if (!next_passes_.empty()) scene_.next_passes.clear();
    for (const std::string& text : next_passes_) {
      TURNSCAN_ASSIGN(PassEntry pass, parse_pass_entry(text));
      scene_.next_passes.push_back(std::move(pass));
    }
    if (scanners_.empty()) return {};
    scene_.scanners.clear();
    for (const std::string& text : scanners_) {
      TURNSCAN_ASSIGN(ScannerEntry entry, parse_scanner_entry(text));
      scene_.scanners.push_back(std::move(entry));
    }
    return {};
  }

  Result<> check_outputs() const {
    if (out_.empty() && coverage_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--out: missing; give the folder to make, or --coverage FILE.ply");
    if (out_.empty() && samples_)
      return fail(ErrorCode::kInvalidOption, "--samples: they go into a recording; give it --out");
    if (!out_.empty()) TURNSCAN_TRY(check_output_folder(out_));
    TURNSCAN_TRY(check_output_file(report_, ".json"));
    TURNSCAN_TRY(check_output_file(coverage_, ".ply"));
    return coverage_.empty() ? Result<>() : check_output_file(coverage_json_path(), ".json");
  }

  std::string coverage_json_path() const {
    return fs::path(coverage_).replace_extension(".json").string();
  }

  Result<CoverageMap> cover(const VirtualPasses& scan, const std::vector<PlacedObject>& placed,
                            const VirtualScanOptions& options, const RunContext& context) const {
    TURNSCAN_ASSIGN(CoverageMap map,
                    coverage_of(scan, placed, options, coverage_options_, context));
    TURNSCAN_TRY(write_coverage_mesh(coverage_, map, coverage_options_));
    TURNSCAN_TRY(write_file_atomically(coverage_json_path(),
                                       coverage_json(map, coverage_options_).dump(2) + "\n"));
    return map;
  }

  Result<TriangleMesh> load_mesh(const RunContext& context) const {
    if (scene_.object.starts_with(kBuiltin))
      return builtin_object(std::string_view(scene_.object).substr(kBuiltin.size()));
    ReadMeshOptions options;
    if (!scene_.unit.empty()) {
      TURNSCAN_ASSIGN(options.metres_per_unit, metres_per(scene_.unit));
    }
    TURNSCAN_ASSIGN(TriangleMesh mesh, read_mesh(scene_.object, options, context));
    if (mesh.name.empty()) mesh.name = fs::path(scene_.object).stem().string();
    return mesh;
  }

  /// The object as it lies in each pass; none for the empty table.
  Result<std::vector<PlacedObject>> load_object(const RunContext& context) const {
    std::vector<PlacedObject> passes;
    if (scene_.object == kEmptyTable) return passes;
    context.begin_phase("read object", 0);
    TURNSCAN_ASSIGN(const TriangleMesh mesh, load_mesh(context));
    TURNSCAN_ASSIGN(const std::vector<ObjectPlacement> placements, pass_placements(scene_));
    for (const ObjectPlacement& placement : placements) {
      auto placed = place_object(mesh, placement);
      if (!placed) {
        Error error = std::move(placed).error();
        error.path = scene_.object;
        return tl::unexpected<Error>(std::move(error));
      }
      TURNSCAN_TRY(context.check());
      passes.push_back(std::move(*placed));
    }
    return passes;
  }

  /// The scanners keep their places: what the first pass makes them look at is for all.
  static Result<VirtualPasses> make_passes(const std::vector<PlacedObject>& placed,
                                           VirtualScanOptions options) {
    std::vector<VirtualScan> scans;
    for (std::size_t k = 0; k < std::max<std::size_t>(placed.size(), 1); ++k) {
      std::vector<TriangleMesh> meshes;
      if (!placed.empty()) meshes.push_back(placed[k].mesh);
      TURNSCAN_ASSIGN(VirtualScan scan, VirtualScan::create(std::move(meshes), options));
      for (VirtualScanner& scanner : options.scanners)
        if (!scanner.placement.aim_height_m) scanner.placement.aim_height_m = scan.aim_height_m();
      ++options.record.pass;
      options.first_instant +=
          static_cast<std::uint32_t>(scan.frames().size() / options.scanners.size());
      scans.push_back(std::move(scan));
    }
    return VirtualPasses(std::move(scans));
  }

  Result<> record(const VirtualPasses& scan, const std::vector<PlacedObject>& placed,
                  const RunContext& context) const {
    std::error_code error;
    const bool existed = fs::exists(out_, error);
    TURNSCAN_TRY(write_recording(out_, scan, context));
    auto truth = write_truth(out_, scan, scene_, placed);
    if (truth && samples_)
      truth = write_true_samples(fs::path(out_) / "truth" / "samples", scan, context);
    if (!truth) discard(out_, existed);
    return truth;
  }

  nlohmann::ordered_json options_json() const {
    SceneDescription copy = scene_;
    nlohmann::ordered_json out;
    for (const SceneTable& table : describe(copy))
      for (const OptionField& field : table.options.fields())
        out[table.name][field.name] = field.get();
    return out;
  }

  std::string report_json(const VirtualPasses& scan, const Timing& timing) const {
    nlohmann::ordered_json out;
    out["software"] = std::string("turnscan ") + version();
    out["object"] = scene_.object;
    out["frames"] = scan.frames().size();
    out["passes"] = scan.count();
    out["scanners"] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < scan.header().sensors.size(); ++k) {
      nlohmann::ordered_json scanner;
      scanner["model"] = scan.header().sensors[k].model;
      const auto tally = scan.tally(k);
      for (std::size_t m = 0; m < tally.size(); ++m)
        scanner["samples"][m == 0 ? "measured" : std::string(name_of(static_cast<Miss>(m)))] =
            tally[m];
      out["scanners"].push_back(std::move(scanner));
    }
    out["seconds"] = {{"prepare", timing.prepare_s}, {"record", timing.record_s}};
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    out["peak_memory_bytes"] = std::uint64_t(usage.ru_maxrss) * 1024;
    out["options"] = options_json();
    return out.dump(2) + "\n";
  }

  void tell(const VirtualPasses& scan, const Timing& timing, Session& session) const {
    TextTable table({0, 1});
    table.add({"scanner", "of its samples"});
    for (std::size_t k = 0; k < scan.header().sensors.size(); ++k)
      table.add({scan.header().sensors[k].model, shares(scan.tally(k))});
    session.print("{}", table.text());
    session.print("{} frames in {:.1f} s\n", scan.frames().size(),
                  timing.prepare_s + timing.record_s);
    session.print("Wrote {} and the truth in {}\n", out_, (fs::path(out_) / "truth").string());
    if (!report_.empty()) session.print("Wrote {}\n", report_);
  }

  void tell(const CoverageMap& map, Session& session) const {
    session.print("{}", coverage_text(map, coverage_options_));
    session.print("Wrote {} and {}\n", coverage_, coverage_json_path());
  }

  /// "12.3 % measured, 80.0 % nothing, ..."
  template <class Tally>
  static std::string shares(const Tally& tally) {
    std::uint64_t all = 0;
    for (const std::uint64_t count : tally) all += count;
    std::string text;
    for (std::size_t m = 0; m < tally.size(); ++m) {
      if (tally[m] == 0 && m != 0) continue;
      text += fmt::format("{}{:.2f} % {}", text.empty() ? "" : ", ",
                          all > 0 ? 100.0 * double(tally[m]) / double(all) : 0.0,
                          m == 0 ? "measured" : name_of(static_cast<Miss>(m)));
    }
    return text;
  }

  std::string object_, out_, unit_, report_, coverage_;
  bool samples_ = false;
  CoverageMapOptions coverage_options_;
  std::vector<std::string> scanners_, next_passes_;
  SceneDescription scene_;
};

}  // namespace

std::unique_ptr<Command> make_simulate_command() { return std::make_unique<SimulateCommand>(); }

}  // namespace turnscan::cli
