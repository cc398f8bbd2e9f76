#include <dlfcn.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <turnscan/capture/source/plugin_source.hpp>
#include <turnscan/capture/source/plugins.hpp>
#include <turnscan/core/process/program_folders.hpp>

namespace turnscan::source {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "turnscan-", kSuffix = ".so";
constexpr std::int32_t kMaxDevices = 64;

/// Debian packages of the libraries that drivers need.
const std::map<std::string, std::string>& packages() {
  static const std::map<std::string, std::string> names{{"openni2", "libopenni2-0"},
                                                        {"freenect", "libfreenect0.5"}};
  return names;
}

std::string name_of(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.size() <= kPrefix.size() + kSuffix.size() || !name.starts_with(kPrefix) ||
      !name.ends_with(kSuffix))
    return {};
  return name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size());
}

struct PluginFiles {
  /// By name of the driver; the first folder that has one counts.
  std::map<std::string, fs::path> by_name;
  std::string problem;  ///< a folder that cannot be listed
};

PluginFiles plugin_files() {
  PluginFiles files;
  for (const fs::path& folder : plugin_folders()) {
    std::error_code error;
    for (fs::directory_iterator file(folder, error), end; !error && file != end;
         file.increment(error))
      if (const std::string name = name_of(file->path()); !name.empty())
        files.by_name.emplace(name, file->path());
    if (error && error != std::errc::no_such_file_or_directory && files.problem.empty())
      files.problem =
          fmt::format("the folder {} cannot be listed ({})", folder.string(), error.message());
  }
  return files;
}

/// Turns the dynamic loader's message into advice.
std::string load_failure(const std::string& scheme, std::string why) {
  constexpr std::string_view kMissing =
      ": cannot open shared object file: No such file or directory";
  if (const std::size_t at = why.find(kMissing); at != std::string::npos) {
    const auto package = packages().find(scheme);
    return fmt::format("its library {} is not installed; {}", why.substr(0, at),
                       package != packages().end()
                           ? "install Debian's package " + package->second
                           : std::string("docs/reference/devices.md says where it comes from"));
  }
  std::replace(why.begin(), why.end(), ';', ',');
  return fmt::format("it cannot be loaded ({}); build it against the libraries of this machine",
                     why);
}

Result<const turnscan_plugin*> load_file(const std::string& scheme, const fs::path& file) {
  const auto failed = [&](const std::string& why) {
    return fail(ErrorCode::kLibrary, "driver {} ({}): {}", scheme, file.string(), why);
  };
  TURNSCAN_ASSIGN(const fs::path whole, process::trusted(file));
  // Never unloaded: drivers leave threads and exit handlers behind.
  void* library = dlopen(whole.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) return failed(load_failure(scheme, dlerror()));
  const auto entry =
      reinterpret_cast<turnscan_plugin_entry_function>(dlsym(library, "turnscan_plugin_entry"));
  if (entry == nullptr)
    return failed("it has no function turnscan_plugin_entry; it is no plug-in of turnscan");
  const turnscan_plugin* plugin = entry();
  if (plugin == nullptr) return failed("it offers nothing; build it again");
  if (plugin->version != TURNSCAN_PLUGIN_VERSION)
    return failed(fmt::format(
        "it was made for version {} of the interface, and this turnscan has version {}; build it "
        "again",
        plugin->version, TURNSCAN_PLUGIN_VERSION));
  if (plugin->name != scheme)
    return failed(fmt::format("it calls itself {}; the file's name must be turnscan-{}.so",
                              plugin->name, plugin->name));
  return plugin;
}

std::vector<FoundDevice> found_devices(const turnscan_plugin& plugin, std::string& problem) {
  std::vector<turnscan_device_entry> entries(kMaxDevices);
  turnscan_error error{};
  const std::int32_t count = plugin.list(entries.data(), kMaxDevices, &error);
  if (count < 0) {
    problem = plugin_failure(plugin, count, error).value().message;
    return {};
  }
  std::vector<FoundDevice> devices;
  for (std::int32_t i = 0; i < std::min(count, kMaxDevices); ++i) {
    turnscan_device_entry& entry = entries[static_cast<std::size_t>(i)];
    entry.address[sizeof entry.address - 1] = entry.model[sizeof entry.model - 1] =
        entry.serial[sizeof entry.serial - 1] = '\0';
    devices.push_back(
        {format_source_uri({plugin.name, entry.address, {}}), entry.model, entry.serial});
  }
  return devices;
}

}  // namespace

Result<const turnscan_plugin*> load_plugin(const std::string& scheme) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  TURNSCAN_TRY(process::folders_of_variable("TURNSCAN_PLUGINS"));
  const auto files = plugin_files();
  const auto file = files.by_name.find(scheme);
  if (file != files.by_name.end()) return load_file(scheme, file->second);
  if (!files.problem.empty())
    return fail(ErrorCode::kIo, "device '{}:': {}; check permissions", scheme, files.problem);
  std::string known = "virtual:, replay:";
  for (const auto& [name, path] : files.by_name) known += ", " + name + ":";
  return fail(ErrorCode::kNotFound,
              "device '{}:': there is no driver of that name; use one of {} "
              "(docs/reference/devices.md says "
              "how others are added)",
              scheme, known);
}

}  // namespace turnscan::source

namespace turnscan {

using namespace source;
namespace fs = std::filesystem;

std::vector<fs::path> plugin_folders() {
  const auto given = process::folders_of_variable("TURNSCAN_PLUGINS");
  if (!given) return {};  // load_plugin() reports the reason
  if (!given->empty()) return *given;
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::path& folder : process::own_folders("lib/turnscan/plugins"))
    if (fs::is_directory(folder, error)) folders.push_back(std::move(folder));
  if (folders.empty()) folders.emplace_back(TURNSCAN_INSTALLED_PLUGINS);
  return folders;
}

std::vector<DriverState> list_drivers() {
  std::vector<DriverState> drivers;
  for (const auto& [name, file] : plugin_files().by_name) {
    DriverState state;
    state.name = name;
    state.file = file;
    if (const auto plugin = load_plugin(name); !plugin) {
      state.error = plugin.error().message;
    } else {
      state.description = (*plugin)->description;
      for (std::int32_t i = 0; i < (*plugin)->parameter_count; ++i) {
        const turnscan_parameter_info& p = (*plugin)->parameters[i];
        state.parameters.push_back({p.name, p.help, p.default_value});
      }
      state.devices = found_devices(**plugin, state.error);
    }
    drivers.push_back(std::move(state));
  }
  return drivers;
}

}  // namespace turnscan
