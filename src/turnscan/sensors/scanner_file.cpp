#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <turnscan/io/text/toml_options.hpp>
#include <turnscan/sensors/scanner_file.hpp>

namespace turnscan {

namespace fs = std::filesystem;

namespace {

constexpr int kFoldersUp = 4;

bool is_data(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "scanners", error);
}

Result<> read_parameters(const fs::path& file, const toml::table& table,
                         ScannerParameters& parameters) {
  TURNSCAN_TRY(scene::set_from_toml(file, table, describe(parameters), {"noise"}));
  const toml::node* noise = table.get("noise");
  if (noise == nullptr) return {};
  if (!noise->is_table())
    return scene::fail_in_toml(file, *noise, "noise is a table of the sensor's errors: [noise]");
  return scene::set_from_toml(file, *noise->as_table(), describe(parameters.noise), {});
}

Result<std::vector<std::string>> presets_in(const fs::path& data) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator file(data / "scanners", error), end; !error && file != end;
       file.increment(error))
    if (file->path().extension() == ".toml") names.push_back(file->path().stem().string());
  if (error)
    return fail_at((data / "scanners").string(), ErrorCode::kIo,
                   "the scanners' folder cannot be listed ({}); check permissions",
                   error.message());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Result<fs::path> data_folder() {
  if (const char* set = std::getenv("TURNSCAN_DATA"); set != nullptr && *set != '\0') {
    if (is_data(set)) return fs::path(set);
    return fail_at(set, ErrorCode::kNotFound,
                   "TURNSCAN_DATA does not name turnscan's data folder; unset it or correct it");
  }
  std::error_code error;
  fs::path above = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (int i = 0; i < kFoldersUp && !above.empty(); ++i, above = above.parent_path())
    if (is_data(above / "share" / "turnscan")) return above / "share" / "turnscan";
  if (is_data(TURNSCAN_INSTALLED_DATA)) return fs::path(TURNSCAN_INSTALLED_DATA);
  return fail(ErrorCode::kNotFound,
              "turnscan's data folder share/turnscan is neither beside the program nor at {}; set "
              "TURNSCAN_DATA to it",
              TURNSCAN_INSTALLED_DATA);
}

std::vector<std::string> scanner_presets() {
  const auto folder = data_folder();
  return folder ? presets_in(*folder).value_or(std::vector<std::string>())
                : std::vector<std::string>();
}

namespace {

Result<ScannerParameters> parameters_in(const fs::path& file) {
  TURNSCAN_ASSIGN(const toml::table table, scene::read_toml(file));
  ScannerParameters parameters;
  parameters.name = file.stem().string();
  TURNSCAN_TRY(read_parameters(file, table, parameters));
  return parameters;
}

Result<fs::path> scanner_path(std::string_view name_or_file) {
  if (name_or_file.ends_with(".toml") || name_or_file.find('/') != std::string_view::npos)
    return fs::path(name_or_file);
  TURNSCAN_ASSIGN(const fs::path folder, data_folder());
  TURNSCAN_ASSIGN(const std::vector<std::string> names, presets_in(folder));
  if (std::find(names.begin(), names.end(), name_or_file) == names.end())
    return fail(ErrorCode::kNotFound,
                "scanner: there is no '{}'; use one of {}, or the path of a .toml file",
                name_or_file, fmt::join(names, ", "));
  return folder / "scanners" / (std::string(name_or_file) + ".toml");
}

}  // namespace

Result<ScannerModel> read_scanner(const fs::path& file) {
  TURNSCAN_ASSIGN(const ScannerParameters parameters, parameters_in(file));
  auto model = scanner_model(parameters);
  if (!model) return fail_at(file.string(), ErrorCode::kInvalidOption, "{}", model.error().message);
  return model;
}

Result<ScannerModel> find_scanner(std::string_view name_or_file) {
  TURNSCAN_ASSIGN(const fs::path file, scanner_path(name_or_file));
  return read_scanner(file);
}

Result<ScannerParameters> find_scanner_parameters(std::string_view name_or_file) {
  TURNSCAN_ASSIGN(const fs::path file, scanner_path(name_or_file));
  return parameters_in(file);
}

OptionTable describe_all(ScannerParameters& parameters) {
  OptionTable table = describe(parameters);
  table.append(describe(parameters.noise));
  return table;
}

Result<std::string> scanner_toml(std::string_view name_or_file,
                                 const std::vector<std::pair<std::string, std::string>>& changed) {
  TURNSCAN_ASSIGN(const fs::path file, scanner_path(name_or_file));
  TURNSCAN_ASSIGN(toml::table table, scene::read_toml(file));
  ScannerParameters parameters;
  TURNSCAN_TRY(read_parameters(file, table, parameters));
  const OptionTable options = describe_all(parameters), own = describe(parameters);
  for (const auto& [key, value] : changed) {
    TURNSCAN_TRY(options.set(key, value));
    if (own.find(key) == nullptr) {
      table.emplace<toml::table>("noise");
      table["noise"].as_table()->insert_or_assign(key, value);
    } else {
      table.insert_or_assign(key, value);
    }
  }
  TURNSCAN_TRY(scanner_model(parameters));
  std::ostringstream text;
  text << toml::toml_formatter{table, toml::format_flags::none} << '\n';
  return text.str();
}

}  // namespace turnscan
