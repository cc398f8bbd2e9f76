#include <algorithm>
#include <turnscan/io/text/toml_options.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/simulator/scene_file.hpp>

namespace turnscan {

namespace fs = std::filesystem;

namespace {

constexpr const char* kDefaultScanner = "kinect-v2";
constexpr double kPlatterThickness_m = 0.012;

bool is_path(std::string_view text) {
  return text.ends_with(".toml") || text.find('/') != std::string_view::npos;
}

std::string beside(const fs::path& file, const std::string& path) {
  if (path.empty() || fs::path(path).is_absolute()) return path;
  return (file.parent_path() / path).string();
}

Result<std::string> text_at(const fs::path& file, const toml::table& table, const char* key) {
  const toml::node* node = table.get(key);
  if (node == nullptr) return std::string();
  if (!node->is_string())
    return scene::fail_in_toml(file, *node, fmt::format("{}: the value is not text", key));
  return node->as_string()->get();
}

Result<> read_object(const fs::path& file, const toml::table& table, SceneDescription& scene) {
  TURNSCAN_ASSIGN(const std::string object, text_at(file, table, "file"));
  if (!object.empty())
    scene.object = object.starts_with("builtin:") ? object : beside(file, object);
  TURNSCAN_ASSIGN(const std::string unit, text_at(file, table, "unit"));
  if (!unit.empty()) scene.unit = unit;
  return scene::set_from_toml(file, table, describe(scene.object_placement), {"file", "unit"});
}

Result<ScannerEntry> read_scanner_entry(const fs::path& file, const toml::table& table) {
  ScannerEntry entry;
  TURNSCAN_ASSIGN(entry.model, text_at(file, table, "model"));
  if (entry.model.empty())
    return scene::fail_in_toml(file, table, "a [[scanner]] needs its model: a preset or a file");
  if (is_path(entry.model)) entry.model = beside(file, entry.model);
  // Checked here, where the line is known; used once everything is read.
  ScannerSetup trial;
  TURNSCAN_TRY(scene::set_from_toml(file, table, describe(trial), {"model"}));
  for (const auto& [key, node] : table) {
    if (key.str() == "model") continue;
    TURNSCAN_ASSIGN(std::string value, scene::toml_text(file, key.str(), node));
    entry.options.emplace_back(std::string(key.str()), std::move(value));
  }
  return entry;
}

Result<> read_scanners(const fs::path& file, const toml::node& node, SceneDescription& scene) {
  const toml::array* list = node.as_array();
  if (list == nullptr || !list->is_homogeneous(toml::node_type::table))
    return scene::fail_in_toml(file, node, "scanners are tables: [[scanner]], once for each");
  scene.scanners.clear();
  for (const toml::node& item : *list) {
    TURNSCAN_ASSIGN(ScannerEntry entry, read_scanner_entry(file, *item.as_table()));
    scene.scanners.push_back(std::move(entry));
  }
  return {};
}

Result<> read_passes(const fs::path& file, const toml::node& node, SceneDescription& scene) {
  const toml::array* list = node.as_array();
  if (list == nullptr || !list->is_homogeneous(toml::node_type::table))
    return scene::fail_in_toml(file, node,
                               "passes are tables: [[pass]], once for each after the first");
  scene.next_passes.clear();
  for (const toml::node& item : *list) {
    // Checked here, where the line is known.
    ObjectPlacement trial;
    TURNSCAN_TRY(scene::set_from_toml(file, *item.as_table(), describe(trial), {}));
    PassEntry& pass = scene.next_passes.emplace_back();
    for (const auto& [key, value] : *item.as_table()) {
      TURNSCAN_ASSIGN(std::string text, scene::toml_text(file, key.str(), value));
      pass.emplace_back(std::string(key.str()), std::move(text));
    }
  }
  return {};
}

Result<> read_part(const fs::path& file, const std::string& name, const toml::node& node,
                   SceneDescription& scene) {
  if (name == "scanner") return read_scanners(file, node, scene);
  if (name == "pass") return read_passes(file, node, scene);
  std::vector<SceneTable> tables = describe(scene);
  const auto table = std::find_if(tables.begin(), tables.end(),
                                  [&](const SceneTable& t) { return t.name == name; });
  if (table == tables.end() || !node.is_table()) {
    std::string known = "[[scanner]], [[pass]]";
    for (const SceneTable& t : tables) known += ", [" + t.name + "]";
    return scene::fail_in_toml(file, node,
                               fmt::format("'{}' is none of the tables {}", name, known));
  }
  if (name == "object") return read_object(file, *node.as_table(), scene);
  return scene::set_from_toml(file, *node.as_table(), table->options, {});
}

Result<> read_parts(const fs::path& file, const toml::table& table, SceneDescription& scene) {
  for (const auto& [key, node] : table)
    TURNSCAN_TRY(read_part(file, std::string(key.str()), node, scene));
  return {};
}

std::vector<ScannerEntry> scanners_of(const SceneDescription& scene) {
  if (!scene.scanners.empty()) return scene.scanners;
  return {{kDefaultScanner, {}}};
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {  // TOML does not allow control characters in a string
      out += fmt::format("\\u{:04x}", code);
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

/// Makes the path independent of the file's location.
std::string absolute(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  return error ? path : whole.lexically_normal().string();
}

std::string entry_line(const std::string& key, const std::string& value, bool bare) {
  return fmt::format("{} = {}\n", key, bare ? value : quoted(value));
}

}  // namespace

Result<PassEntry> parse_pass_entry(std::string_view text) {
  PassEntry pass;
  ObjectPlacement trial;
  const OptionTable table = describe(trial);
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = text.substr(begin, end - begin);
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos)
      return fail(ErrorCode::kInvalidOption,
                  "next-pass = {}: '{}' has no value; write NAME=VALUE, e.g. tip=90deg", text,
                  part);
    pass.emplace_back(part.substr(0, equals), part.substr(equals + 1));
    if (auto set = table.set(pass.back().first, pass.back().second); !set)
      return fail(ErrorCode::kInvalidOption, "next-pass = {}: {}", text, set.error().message);
    begin = end + 1;
  }
  return pass;
}

Result<std::vector<ObjectPlacement>> pass_placements(const SceneDescription& scene) {
  std::vector<ObjectPlacement> placements{scene.object_placement};
  for (const PassEntry& pass : scene.next_passes) {
    ObjectPlacement placement = scene.object_placement;
    const OptionTable table = describe(placement);
    for (const auto& [name, value] : pass) TURNSCAN_TRY(table.set(name, value));
    if (placement.height_m != scene.object_placement.height_m)
      return fail(
          ErrorCode::kInvalidOption,
          "a pass: height scales the object, which is the same in all passes; leave it out");
    placements.push_back(placement);
  }
  return placements;
}

SceneDescription::SceneDescription() { platter.thickness_m = kPlatterThickness_m; }

Result<ScannerEntry> parse_scanner_entry(std::string_view text) {
  ScannerEntry entry;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = text.substr(begin, end - begin);
    const std::size_t equals = part.find('=');
    if (begin == 0) {
      entry.model = part;
    } else if (equals == std::string_view::npos) {
      return fail(ErrorCode::kInvalidOption,
                  "scanner = {}: '{}' has no value; write NAME=VALUE, e.g. azimuth=90deg", text,
                  part);
    } else {
      entry.options.emplace_back(part.substr(0, equals), part.substr(equals + 1));
    }
    begin = end + 1;
  }
  if (entry.model.empty())
    return fail(ErrorCode::kInvalidOption,
                "scanner = {} names no scanner; begin with a preset or a file", text);
  ScannerSetup trial;
  const OptionTable table = describe(trial);
  for (const auto& [name, value] : entry.options)
    if (auto set = table.set(name, value); !set)
      return fail(ErrorCode::kInvalidOption, "scanner = {}: {}", text, set.error().message);
  return entry;
}

OptionTable describe(ScannerSetup& setup) {
  OptionTable table = describe(setup.placement);
  table.append(describe_all(setup.parameters));
  return table;
}

Result<ScannerSetup> scanner_setup(const ScannerEntry& entry, const ScannerPlacement& common) {
  ScannerSetup setup;
  TURNSCAN_ASSIGN(setup.parameters, find_scanner_parameters(entry.model));
  setup.placement = common;
  const OptionTable table = describe(setup);
  for (const auto& [name, value] : entry.options) TURNSCAN_TRY(table.set(name, value));
  const auto usable = scanner_model(setup.parameters);
  if (!usable)
    return fail_at(is_path(entry.model) ? entry.model : "", ErrorCode::kInvalidOption, "{}",
                   usable.error().message);
  return setup;
}

std::vector<SceneTable> describe(SceneDescription& scene) {
  std::vector<SceneTable> tables;
  tables.push_back({"object", "Object", describe(scene.object_placement)});
  tables.push_back({"placement", "Place of the scanners", describe(scene.placement)});
  tables.push_back({"motion", "Motion of the turntable", describe(scene.motion)});
  OptionTable table = describe(scene.platter);
  table.append(describe(scene.table));
  tables.push_back({"table", "Turntable", std::move(table)});
  tables.push_back({"room", "Room", describe(scene.room)});
  OptionTable events = describe(scene.object_move);
  events.append(describe(scene.hand));
  tables.push_back({"events", "Events during the recording", std::move(events)});
  tables.push_back({"noise", "Noise", describe(scene.measure)});
  tables.push_back({"recording", "Recording", describe(scene.record)});
  tables.push_back({"colour-camera", "Colour camera", describe(scene.color_camera)});
  return tables;
}

Result<> read_scene(const fs::path& file, SceneDescription& scene) {
  TURNSCAN_ASSIGN(const toml::table table, scene::read_toml(file));
  return read_parts(file, table, scene);
}

Result<> parse_scene(std::string_view text, const fs::path& file, SceneDescription& scene) {
  TURNSCAN_ASSIGN(const toml::table table, scene::parse_toml(text, file));
  return read_parts(file, table, scene);
}

std::string scene_toml(const SceneDescription& scene) {
  SceneDescription copy = scene;
  std::string text;
  for (const SceneTable& table : describe(copy)) {
    text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table.name);
    if (table.name == "object") {
      const bool builtin = scene.object.starts_with("builtin:");
      text += entry_line("file", builtin ? scene.object : absolute(scene.object), false);
      if (!scene.unit.empty()) text += entry_line("unit", scene.unit, false);
    }
    for (const OptionField& field : table.options.fields())
      text += entry_line(field.name, field.get(), field.is_flag);
  }
  for (const ScannerEntry& entry : scanners_of(scene)) {
    text += "\n[[scanner]]\n" +
            entry_line("model", is_path(entry.model) ? absolute(entry.model) : entry.model, false);
    for (const auto& [name, value] : entry.options) text += entry_line(name, value, false);
  }
  for (const PassEntry& pass : scene.next_passes) {
    text += "\n[[pass]]\n";
    for (const auto& [name, value] : pass) text += entry_line(name, value, false);
  }
  return text;
}

Result<VirtualScanOptions> scan_options(const SceneDescription& scene) {
  VirtualScanOptions options;
  for (const ScannerEntry& entry : scanners_of(scene)) {
    TURNSCAN_ASSIGN(const ScannerSetup setup, scanner_setup(entry, scene.placement));
    TURNSCAN_ASSIGN(ScannerModel model, scanner_model(setup.parameters));
    options.scanners.push_back({std::move(model), setup.placement});
  }
  options.motion = scene.motion;
  options.platter = scene.platter;
  options.table = scene.table;
  options.room = scene.room;
  options.object_move = scene.object_move;
  options.hand = scene.hand;
  options.measure = scene.measure;
  options.record = scene.record;
  options.color_camera = scene.color_camera;
  return options;
}

}  // namespace turnscan
