#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {

namespace {

nlohmann::ordered_json options_json(SceneDescription scene) {
  auto out = nlohmann::ordered_json::object();
  for (const SceneTable& table : describe(scene)) {
    nlohmann::ordered_json& options = out[table.name];
    if (options.is_null()) options = nlohmann::ordered_json::object();
    for (const OptionField& field : table.options.fields()) options[field.name] = field.get();
  }
  return out;
}

nlohmann::ordered_json scanner_json(const VirtualPasses& scan, std::size_t k) {
  auto scanner = nlohmann::ordered_json::object();
  scanner["model"] = scan.header().sensors[k].model;
  auto samples = nlohmann::ordered_json::object();
  const auto tally = scan.tally(k);
  for (std::size_t m = 0; m < tally.size(); ++m)
    samples[m == 0 ? "measured" : std::string(name_of(static_cast<Miss>(m)))] = tally[m];
  scanner["samples"] = std::move(samples);
  return scanner;
}

}  // namespace

std::string simulation_json(const Simulation& simulation) {
  const VirtualPasses& scan = simulation.scan;
  auto out = nlohmann::ordered_json::object();
  out["software"] = std::string("turnscan ") + version();
  out["object"] = simulation.scene.object;
  out["frames"] = scan.frames().size();
  out["passes"] = scan.count();
  out["scanners"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < scan.header().sensors.size(); ++k)
    out["scanners"].push_back(scanner_json(scan, k));
  out["seconds"] = {{"prepare", simulation.prepare_s}, {"record", simulation.record_s}};
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  out["peak_memory_bytes"] = std::uint64_t(usage.ru_maxrss) * 1024;
  out["options"] = options_json(simulation.scene);
  return out.dump(2) + "\n";
}

}  // namespace turnscan
