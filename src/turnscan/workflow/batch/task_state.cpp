#include <turnscan/workflow/batch/task_state.hpp>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::batch {

namespace {

constexpr std::array<const char*, 4> kStateNames{"waiting", "running", "done", "failed"};

}  // namespace

std::string name_of(TaskState state) { return kStateNames.at(static_cast<std::size_t>(state)); }

std::string record_json(const TaskRecord& record) {
  text::OrderedJson json = text::OrderedJson::object();
  json["schema"] = 1;
  json["state"] = name_of(record.state);
  if (!record.reason.empty()) json["reason"] = record.reason;
  json["digest"] = record.digest;
  json["attempts"] = record.attempts;
  json["host"] = record.host;
  json["started_s"] = record.started_s;
  json["seconds"] = record.seconds;
  json["command_seconds"] = record.command_seconds;
  json["cpu_seconds"] = record.cpu_seconds;
  json["peak_bytes"] = record.peak_bytes;
  json["threads"] = record.threads;
  json["inputs"] = text::OrderedJson::array();
  for (const InputPrint& input : record.inputs) {
    text::OrderedJson entry = text::OrderedJson::object();
    entry["path"] = input.path;
    entry["stamp"] = input.stamp;
    entry["sha256"] = input.sha256;
    json["inputs"].push_back(std::move(entry));
  }
  return text::json_text(json);
}

Result<TaskRecord> record_of(const std::string& json) {
  TURNSCAN_ASSIGN(const text::Json value, text::parse_json(json));
  TURNSCAN_ASSIGN(const text::JsonObject object, text::JsonObject::from(value, json));
  TaskRecord record;
  TURNSCAN_ASSIGN(const std::string state, object.text_or("state", ""));
  const auto name = std::find(kStateNames.begin(), kStateNames.end(), state);
  if (name == kStateNames.end())
    return fail(ErrorCode::kFormat, "state: '{}' is none; use one of {}", state,
                fmt::join(kStateNames, ", "));
  record.state = static_cast<TaskState>(name - kStateNames.begin());
  TURNSCAN_ASSIGN(record.reason, object.text_or("reason", ""));
  TURNSCAN_ASSIGN(record.digest, object.text_or("digest", ""));
  TURNSCAN_ASSIGN(record.host, object.text_or("host", ""));
  TURNSCAN_ASSIGN(record.started_s, object.number_or("started_s", 0.0));
  TURNSCAN_ASSIGN(record.seconds, object.number_or("seconds", 0.0));
  TURNSCAN_ASSIGN(record.command_seconds, object.number_or("command_seconds", 0.0));
  TURNSCAN_ASSIGN(record.cpu_seconds, object.number_or("cpu_seconds", 0.0));
  TURNSCAN_ASSIGN(const double peak_bytes, object.number_or("peak_bytes", 0.0));
  record.peak_bytes = static_cast<std::uint64_t>(std::clamp(peak_bytes, 0.0, 1e15));
  if (object.has("attempts")) {
    TURNSCAN_ASSIGN(record.attempts, object.integer("attempts", 0, 1000000));
  }
  if (object.has("threads")) {
    TURNSCAN_ASSIGN(record.threads, object.integer("threads", 0, 100000));
  }
  if (!object.has("inputs")) return record;
  TURNSCAN_ASSIGN(const std::vector<text::JsonObject> inputs, object.objects("inputs"));
  for (const text::JsonObject& input : inputs) {
    InputPrint print;
    TURNSCAN_ASSIGN(print.path, input.text_or("path", ""));
    TURNSCAN_ASSIGN(print.stamp, input.text_or("stamp", ""));
    TURNSCAN_ASSIGN(print.sha256, input.text_or("sha256", ""));
    record.inputs.push_back(std::move(print));
  }
  return record;
}

}  // namespace turnscan::batch
