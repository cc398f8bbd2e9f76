#include <turnscan/workflow/batch/batch_task.hpp>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/workflow/input.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

/// Options that are not in an option table: they name files, or may be repeated.
struct PlainOptions {
  std::set<std::string> texts, files, flags;
};

const PlainOptions& plain_options(const std::string& command) {
  static const PlainOptions reconstruct{{"calibration", "pass-pose", "import"},
                                        {"turntable", "config"},
                                        {"allow-open", "refine-pass-poses"}};
  static const PlainOptions simulate{{"scanner", "next-pass", "unit"}, {"scene"}, {"samples"}};
  return command == "simulate" ? simulate : reconstruct;
}

/// Calls use(table) with the tables of a command's options.
template <class Use>
auto with_table(const std::string& command, const Use& use) {
  ReconstructOptions reconstruct;
  WriteMeshOptions mesh_file;
  SceneDescription scene;
  CoverageMapOptions coverage;
  OptionTable all;
  if (command == "simulate") {
    for (SceneTable& table : describe(scene)) all.append(std::move(table.options));
    all.append(describe(coverage));
  } else {
    all.append(describe(reconstruct)).append(describe(mesh_file));
  }
  return use(all);
}

Result<bool> flag_value(const std::string& name, const std::string& value) {
  if (value == "true" || value == "on" || value == "yes" || value == "1") return true;
  if (value == "false" || value == "off" || value == "no" || value == "0") return false;
  return fail(ErrorCode::kInvalidOption, "{}: '{}' is neither true nor false", name, value);
}

Result<> check_option(const OptionTable& table, const PlainOptions& plain, const std::string& name,
                      const std::string& value) {
  if (plain.flags.contains(name)) {
    TURNSCAN_TRY(flag_value(name, value));
    return {};
  }
  if (name == "import" && plain.texts.contains(name)) {
    TURNSCAN_TRY(parse_import_options({value}));
    return {};
  }
  if (plain.texts.contains(name) || plain.files.contains(name)) return {};
  return table.set(name, value);
}

/// Position of the path inside the value of an option that has one.
std::pair<std::size_t, std::size_t> path_in(const std::string& option, const std::string& value) {
  if (option == "scanner") return {0, std::min(value.find(','), value.size())};
  if (option == "pass-pose") {
    const auto equals = value.find('=');
    return {equals == std::string::npos ? value.size() : equals + 1, value.size()};
  }
  const bool file = option == "turntable" || option == "config" || option == "scene";
  return {0, file ? value.size() : 0};
}

}  // namespace

Result<> check_task(const BatchTask& task) {
  const auto wrong = [&](const std::string& why) {
    return fail(ErrorCode::kInvalidOption, "task {}: {}", task.name, why);
  };
  if (task.command != "reconstruct" && task.command != "simulate")
    return wrong(
        fmt::format("a batch has no command '{}'; use reconstruct or simulate", task.command));
  if (task.inputs.empty()) return wrong("it has no input; name a recording or an object");
  if (task.command == "simulate" && task.inputs.size() > 1)
    return wrong("several objects; give each a task of its own");
  return with_table(task.command, [&](const OptionTable& table) -> Result<> {
    for (const auto& [name, value] : task.options)
      if (auto fine = check_option(table, plain_options(task.command), name, value); !fine)
        return wrong(fine.error().message);
    return {};
  });
}

std::vector<std::string> arguments_of(const BatchTask& task, int threads) {
  const bool simulate = task.command == "simulate";
  std::vector<std::string> words{task.command};
  words.emplace_back(simulate ? "--out=recording" : "--out=mesh.ply");
  words.emplace_back("--report=report.json");
  words.emplace_back(fmt::format("--threads={}", threads));
  words.emplace_back("--quiet");
  const PlainOptions& plain = plain_options(task.command);
  with_table(task.command, [&](const OptionTable& table) {
    for (const auto& [name, value] : task.options) {
      const OptionField* field = table.find(name);
      if (plain.flags.contains(name)) {
        if (flag_value(name, value).value_or(false)) words.push_back("--" + name);
      } else if (field != nullptr && field->is_flag) {
        (void)field->set(value);
        words.push_back((field->get() == "true" ? "--" : "--no-") + name);
      } else {
        words.push_back(fmt::format("--{}={}", name, value));
      }
    }
    return 0;
  });
  words.emplace_back("--");  // whatever an input begins with, it is none of the options
  words.insert(words.end(), task.inputs.begin(), task.inputs.end());
  return words;
}

std::vector<std::string> files_of(const BatchTask& task) {
  std::vector<std::string> files = task.inputs;
  for (const auto& [name, value] : task.options) {
    const auto [begin, end] = path_in(name, value);
    const std::string path = value.substr(begin, end - begin);
    std::error_code error;
    if (!path.empty() && fs::exists(path, error)) files.push_back(path);
  }
  return files;
}

std::string with_absolute_path(const std::string& option, const std::string& value,
                               const std::string& folder) {
  const auto [begin, end] = path_in(option, value);
  const std::string path = value.substr(begin, end - begin);
  std::error_code error;
  if (path.empty() || !fs::exists(fs::path(folder) / path, error)) return value;
  const fs::path full = fs::weakly_canonical(fs::path(folder) / path, error);
  return value.substr(0, begin) + (error ? path : full.string()) + value.substr(end);
}

std::string task_json(const BatchTask& task) {
  text::OrderedJson json = text::OrderedJson::object();
  json["schema"] = 1;
  json["name"] = task.name;
  json["command"] = task.command;
  json["inputs"] = task.inputs;
  json["options"] = text::OrderedJson::array();
  for (const auto& [name, value] : task.options)
    json["options"].push_back(text::OrderedJson::array({name, value}));
  json["frames"] = task.frames;
  json["peak_bytes"] = task.peak_bytes;
  return text::json_text(json);
}

Result<BatchTask> task_of(const std::string& json) {
  TURNSCAN_ASSIGN(const text::Json value, text::parse_json(json));
  TURNSCAN_ASSIGN(const text::JsonObject object, text::JsonObject::from(value, json));
  BatchTask task;
  TURNSCAN_ASSIGN(task.name, object.text_or("name", ""));
  TURNSCAN_ASSIGN(task.command, object.text_or("command", ""));
  TURNSCAN_ASSIGN(task.inputs, object.texts("inputs"));
  TURNSCAN_ASSIGN(const double frames, object.number_or("frames", 0.0));
  TURNSCAN_ASSIGN(const double peak_bytes, object.number_or("peak_bytes", 0.0));
  task.frames = static_cast<std::uint64_t>(std::clamp(frames, 0.0, 1e12));
  task.peak_bytes = static_cast<std::uint64_t>(std::clamp(peak_bytes, 0.0, 1e15));
  const text::Json* options = object.find("options");
  for (const text::Json& pair : options != nullptr ? *options : text::Json::array()) {
    if (!pair.is_array() || pair.size() != 2 || !pair[0].is_string() || !pair[1].is_string())
      return fail(ErrorCode::kFormat, "options: each is a name and a value");
    task.options.emplace_back(pair[0].get<std::string>(), pair[1].get<std::string>());
  }
  return task;
}

}  // namespace turnscan
