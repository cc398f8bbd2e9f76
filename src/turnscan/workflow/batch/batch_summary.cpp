#include <turnscan/workflow/batch/batch_summary.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <turnscan/core/version.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/text/json_fields.hpp>
#include <turnscan/io/text/sheet_field.hpp>

namespace turnscan::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLongestReport = std::uint64_t(64) << 20;

int rank_of(const std::string& verdict) {
  return verdict == "red" ? 3 : verdict == "amber" ? 2 : verdict == "green" ? 1 : 0;
}

std::string text_at(const text::Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string()
             ? json[key].get<std::string>()
             : std::string();
}

std::uint64_t count_at(const text::Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_number_unsigned()
             ? json[key].get<std::uint64_t>()
             : 0;
}

text::Json member_of(const text::Json& json, const char* key) {
  return json.is_object() && json.contains(key) ? json[key] : text::Json();
}

void add_object(const text::Json& object, ResultFacts& facts) {
  ++facts.objects;
  facts.triangles += count_at(object, "triangles");
  const text::Json mesh = member_of(object, "mesh");
  const text::Json watertight = member_of(mesh, "watertight");
  facts.watertight &= watertight.is_boolean() && watertight.get<bool>();
  const text::Json verdict = member_of(object, "verdict");
  const std::string colour = text_at(verdict, "colour");
  if (rank_of(colour) > rank_of(facts.verdict)) facts.verdict = colour;
  for (const text::Json& sentence : member_of(verdict, "sentences"))
    if (text_at(sentence, "level") != "good") facts.sentences.push_back(text_at(sentence, "text"));
}

ResultFacts facts_of(const fs::path& report) {
  ResultFacts facts;
  const auto text = read_file(report, kLongestReport);
  const auto json = text ? text::parse_json(*text) : tl::unexpected<Error>(text.error());
  if (!json) return facts;
  facts.frames = count_at(*json, "frames");
  facts.watertight = true;
  for (const text::Json& object : member_of(*json, "objects")) add_object(object, facts);
  facts.watertight &= facts.objects > 0;
  return facts;
}

std::string option_value(const BatchTask& task, const std::string& name) {
  std::string values;
  for (const auto& [key, value] : task.options)
    if (key == name) values += (values.empty() ? "" : ";") + value;
  return values;
}

std::vector<std::string> option_names(const BatchSummary& summary) {
  std::set<std::string> names;
  for (const SummaryRow& row : summary.rows)
    for (const auto& [name, value] : row.task->options) names.insert(name);
  return {names.begin(), names.end()};
}

double megabytes(std::uint64_t bytes) { return static_cast<double>(bytes) / 1e6; }

}  // namespace

std::size_t BatchSummary::count(TaskState state) const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [&](const SummaryRow& row) { return row.record.state == state; }));
}

BatchSummary summarize(const BatchFolder& folder, const std::vector<BatchTask>& tasks) {
  BatchSummary summary;
  std::error_code error;
  for (const BatchTask& task : tasks) {
    SummaryRow row{&task, folder.record(task.name), {}, {}};
    if (row.record.state == TaskState::kDone) {
      row.facts = facts_of(folder.result_folder(task.name) / "report.json");
      if (fs::exists(folder.result_folder(task.name) / "thumbnail.png", error))
        row.thumbnail = "tasks/" + task.name + "/result/thumbnail.png";
    }
    summary.rows.push_back(std::move(row));
  }
  return summary;
}

std::string summary_csv(const BatchSummary& summary) {
  const std::vector<std::string> names = option_names(summary);
  std::string text =
      "name,state,verdict,objects,triangles,watertight,frames,seconds,cpu_seconds,peak_mb,attempts,"
      "host,reason,inputs";
  for (const std::string& name : names) text += "," + text::sheet_field(name);
  text += "\n";
  for (const SummaryRow& row : summary.rows) {
    const TaskRecord& r = row.record;
    const bool done = r.state == TaskState::kDone;
    text += fmt::format("{},{},{},", text::sheet_field(row.task->name), name_of(r.state),
                        text::sheet_field(row.facts.verdict));
    text += done ? fmt::format("{},{},{},{},", row.facts.objects, row.facts.triangles,
                               row.facts.watertight ? "yes" : "no", row.facts.frames)
                 : ",,,,";
    text += fmt::format("{:.3f},{:.3f},{:.1f},{},{},{},{}", r.seconds, r.cpu_seconds,
                        megabytes(r.peak_bytes), r.attempts, text::sheet_field(r.host),
                        text::sheet_field(r.reason),
                        text::sheet_field(fmt::format("{}", fmt::join(row.task->inputs, ";"))));
    for (const std::string& name : names)
      text += "," + text::sheet_field(option_value(*row.task, name));
    text += "\n";
  }
  return text;
}

std::string summary_json(const BatchSummary& summary) {
  text::OrderedJson json = text::OrderedJson::object();
  json["software"] = "turnscan";
  json["version"] = version();
  json["tasks"] = summary.rows.size();
  for (const TaskState state :
       {TaskState::kDone, TaskState::kFailed, TaskState::kRunning, TaskState::kWaiting})
    json[name_of(state)] = summary.count(state);
  json["results"] = text::OrderedJson::array();
  for (const SummaryRow& row : summary.rows) {
    text::OrderedJson entry = text::OrderedJson::object();
    entry["name"] = row.task->name;
    entry["state"] = name_of(row.record.state);
    entry["command"] = row.task->command;
    entry["inputs"] = row.task->inputs;
    entry["options"] = text::OrderedJson::object();
    for (const auto& [name, value] : row.task->options)
      entry["options"][name] = option_value(*row.task, name);
    if (!row.record.reason.empty()) entry["reason"] = row.record.reason;
    if (row.record.state == TaskState::kDone) {
      if (!row.facts.verdict.empty()) entry["verdict"] = row.facts.verdict;
      entry["sentences"] = row.facts.sentences;
      entry["objects"] = row.facts.objects;
      entry["triangles"] = row.facts.triangles;
      entry["watertight"] = row.facts.watertight;
      entry["frames"] = row.facts.frames;
    }
    entry["attempts"] = row.record.attempts;
    entry["host"] = row.record.host;
    entry["seconds"] = row.record.seconds;
    entry["command_seconds"] = row.record.command_seconds;
    entry["cpu_seconds"] = row.record.cpu_seconds;
    entry["peak_bytes"] = row.record.peak_bytes;
    entry["estimated_peak_bytes"] = row.task->peak_bytes;
    json["results"].push_back(std::move(entry));
  }
  return text::json_text(json);
}

Result<std::vector<std::string>> write_summary(const BatchSummary& summary,
                                               const BatchFolder& batch) {
  TURNSCAN_ASSIGN(const file::Folder folder, batch.open());
  std::vector<std::string> files;
  for (const auto& [name, text] :
       {std::pair("summary.csv", summary_csv(summary)),
        std::pair("summary.json", summary_json(summary)),
        std::pair("summary.html", summary_page(summary, batch.path().filename().string()))}) {
    TURNSCAN_TRY(folder.write(name, text));
    files.push_back((batch.path() / name).string());
  }
  return files;
}

}  // namespace turnscan::batch
