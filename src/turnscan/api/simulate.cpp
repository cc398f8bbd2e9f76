#include <turnscan/api/named_options.hpp>
#include <turnscan/api/simulate.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/workflow/simulation/seen_by.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {

struct SimulatedScan::Impl {
  Simulation simulation;
};

namespace {

OptionTable table_of(SceneDescription& scene) {
  OptionTable all;
  for (SceneTable& table : describe(scene)) all.append(std::move(table.options));
  all.text("unit", scene.unit, "Unit of the object's file if that does not say it: mm, m, ...");
  return all;
}

const std::vector<api::RepeatableOption>& repeatable_options() {
  static const std::vector<api::RepeatableOption> kOptions{
      {"scene", "TOML file with the whole scene, which the other options change"},
      {"scanner",
       "A preset or a file of a scanner, and after commas the options of its own placement"},
      {"next-pass", "How the object lies in another pass, e.g. tip=90deg,yaw=30deg"}};
  return kOptions;
}

Result<SceneDescription> scene_from(const std::string& object, Options options) {
  SceneDescription scene;
  for (const std::string& file : api::take(options, "scene")) TURNSCAN_TRY(read_scene(file, scene));
  if (!object.empty()) scene.object = object;
  const std::vector<std::string> scanners = api::take(options, "scanner");
  if (!scanners.empty()) scene.scanners.clear();
  for (const std::string& text : scanners) {
    TURNSCAN_ASSIGN(ScannerEntry entry, parse_scanner_entry(text));
    scene.scanners.push_back(std::move(entry));
  }
  for (const std::string& text : api::take(options, "next-pass")) {
    TURNSCAN_ASSIGN(PassEntry entry, parse_pass_entry(text));
    scene.next_passes.push_back(std::move(entry));
  }
  TURNSCAN_TRY(api::set_fields(table_of(scene), options));
  return scene;
}

}  // namespace

SimulatedScan::SimulatedScan(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

const FrameSequence& SimulatedScan::frames() const { return impl_->simulation.scan; }

std::size_t SimulatedScan::passes() const { return impl_->simulation.placed.size(); }

const TriangleMesh& SimulatedScan::truth(std::size_t pass) const {
  return impl_->simulation.placed.at(pass).mesh;
}

Result<> SimulatedScan::record(const std::filesystem::path& folder,
                               const RunContext& context) const {
  return record_simulation(impl_->simulation, folder.string(), false, {}, context);
}

Result<Evaluation> SimulatedScan::evaluate(const TriangleMesh& mesh, const Options& options,
                                           const RunContext& context) const {
  EvaluateOptions chosen;
  TURNSCAN_TRY(api::set_fields(describe(chosen), options));
  if (passes() == 0)
    return fail(ErrorCode::kTooFewPoints, "nothing stands on the turntable to compare with");
  TURNSCAN_ASSIGN(const Scene scene, Scene::create(std::span(&truth(), 1)));
  return turnscan::evaluate(mesh, truth(), chosen,
                            seen_by(scene, impl_->simulation.scan.pass(0), context), context);
}

Result<SimulatedScan> simulate(const std::string& object, const Options& options,
                               const RunContext& context) {
  TURNSCAN_ASSIGN(const SceneDescription scene, scene_from(object, options));
  TURNSCAN_ASSIGN(Simulation simulation, prepare_simulation(scene, context));
  return SimulatedScan(
      std::make_shared<SimulatedScan::Impl>(SimulatedScan::Impl{std::move(simulation)}));
}

std::vector<OptionDescription> simulate_options() {
  SceneDescription scene;
  return api::describe_fields(table_of(scene), repeatable_options());
}

}  // namespace turnscan
