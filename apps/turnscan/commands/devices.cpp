#include <nlohmann/json.hpp>
#include <turnscan/capture/source/plugins.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/text/text_table.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#ifdef TURNSCAN_WITH_SERVE
#include "remote/remote_rig.hpp"
#endif

namespace turnscan::cli {

namespace {

std::string state_of(const DriverState& driver) {
  if (!driver.error.empty()) return "not usable";
  if (driver.devices.empty()) return "no device connected";
  return fmt::format("{} device{}", driver.devices.size(), driver.devices.size() == 1 ? "" : "s");
}

nlohmann::ordered_json json_of(const DriverState& driver) {
  auto out = nlohmann::ordered_json::object();
  out["name"] = driver.name;
  out["description"] = driver.description;
  out["file"] = driver.file.string();
  if (!driver.error.empty()) out["error"] = driver.error;
  out["devices"] = nlohmann::ordered_json::array();
  for (const FoundDevice& device : driver.devices)
    out["devices"].push_back(
        {{"uri", device.uri}, {"model", device.model}, {"serial", device.serial}});
  out["parameters"] = nlohmann::ordered_json::array();
  for (const DriverState::Parameter& parameter : driver.parameters)
    out["parameters"].push_back(
        {{"name", parameter.name}, {"help", parameter.help}, {"default", parameter.default_value}});
  return out;
}

class DevicesCommand : public Command {
 public:
  void declare(CommandLine& line) override {
#ifdef TURNSCAN_WITH_SERVE
    line.option("--server", "URL", server_,
                "List what the rig scans with that turnscan serve offers, e.g. http://rig:8470. "
                "Its token is read from the environment variable TURNSCAN_TOKEN");
#endif
    line.option("--json", "FILE.json", json_, "Also write the list as JSON");
  }

  FileRoles files() const override { return {{}, {json_}}; }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(check_output_file(json_, ".json"));
    session.context().begin_phase("look for devices", 0);
#ifdef TURNSCAN_WITH_SERVE
    if (!server_.empty()) return run_there(session);
#endif
    const std::vector<DriverState> drivers = list_drivers();
    TURNSCAN_TRY(session.context().check());
    if (!json_.empty()) TURNSCAN_TRY(write_file_atomically(json_, json(drivers).dump(2) + "\n"));
    workflow::TextTable table({0, 1, 2});
    table.add({"URI", "device", "state"});
    table.add({"virtual:OBJECT?sensor=kinect-v2", "a simulated sensor and turntable", "ready"});
    table.add({"replay:RECORDING", "a recording played back", "ready"});
    for (const DriverState& driver : drivers) add(driver, table);
    session.print("{}", table.text());
    for (const DriverState& driver : drivers)
      if (!driver.error.empty()) session.print("{}: {}\n", driver.name, driver.error);
    if (drivers.empty())
      session.print(
          "No drivers are installed in {}; docs/reference/devices.md says how to build them\n",
          fmt::join(folders(), ", "));
    if (!json_.empty()) session.print("Wrote {}\n", json_);
    return {};
  }

 private:
#ifdef TURNSCAN_WITH_SERVE
  Result<> run_there(Session& session) {
    TURNSCAN_ASSIGN(auto rig, remote::RemoteRig::open(server_, session.context()));
    TURNSCAN_ASSIGN(const remote::Json listed, rig.get("devices"));
    workflow::TextTable table({0, 1, 2});
    table.add({"URI", "device", "state"});
    try {
      for (const auto& device : listed.at("devices"))
        table.add({device.at("uri"), device.at("model"),
                   device.at("kind") == "sensor" ? "connected" : "ready"});
    } catch (const remote::Json::exception&) {
      return tl::unexpected<Error>(rig.not_understood());
    }
    if (!json_.empty()) TURNSCAN_TRY(write_file_atomically(json_, listed.dump(2) + "\n"));
    session.print("{}", table.text());
    if (!json_.empty()) session.print("Wrote {}\n", json_);
    return {};
  }

  std::string server_;
#endif
  static std::vector<std::string> folders() {
    std::vector<std::string> names;
    for (const auto& folder : plugin_folders()) names.push_back(folder.string());
    return names;
  }

  static void add(const DriverState& driver, workflow::TextTable& table) {
    table.add({driver.name + ":", driver.description.empty() ? "-" : driver.description,
               state_of(driver)});
    for (const FoundDevice& device : driver.devices)
      table.add({device.uri, device.model, "connected"});
  }

  static nlohmann::ordered_json json(const std::vector<DriverState>& drivers) {
    auto out = nlohmann::ordered_json::object();
    out["virtual"] = {{"objects", builtin_object_names()}, {"sensors", scanner_presets()}};
    out["folders"] = folders();
    out["drivers"] = nlohmann::ordered_json::array();
    for (const DriverState& driver : drivers) out["drivers"].push_back(json_of(driver));
    return out;
  }

  std::string json_;
};

}  // namespace

std::unique_ptr<Command> make_devices_command() { return std::make_unique<DevicesCommand>(); }

}  // namespace turnscan::cli
