#include <turnscan/workflow/page/report_facts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <turnscan/io/text/json_bytes.hpp>

namespace turnscan::page {

namespace {

using Json = nlohmann::json;  // reading an ordered one takes quadratic time

const Json& at(const Json& json, const char* key) {
  static const Json none;
  const auto found = json.is_object() ? json.find(key) : json.end();
  return json.is_object() && found != json.end() ? *found : none;
}

std::string text_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_string() ? value.get<std::string>() : "";
}

std::optional<double> number_at(const Json& json, const char* key) {
  const Json& value = at(json, key);
  return value.is_number() ? std::optional<double>(value.get<double>()) : std::nullopt;
}

std::vector<std::string> texts_at(const Json& json, const char* key) {
  std::vector<std::string> texts;
  if (!at(json, key).is_array()) return texts;
  for (const Json& text : at(json, key))
    if (text.is_string()) texts.push_back(text.get<std::string>());
  return texts;
}

std::optional<Verdict> verdict_of(const Json& json) {
  Verdict verdict{text_at(json, "colour"), {}};
  if (verdict.colour != "green" && verdict.colour != "amber" && verdict.colour != "red")
    return std::nullopt;
  if (!at(json, "sentences").is_array()) return verdict;
  for (const Json& s : at(json, "sentences")) {
    const std::string level = text_at(s, "level");
    const bool known = level == "good" || level == "fair" || level == "bad";
    verdict.sentences.push_back({text_at(s, "topic"), known ? level : "", text_at(s, "text"),
                                 text_at(s, "unit"), number_at(s, "value")});
  }
  return verdict;
}

/// Non-numbers become NaN.
std::vector<double> numbers_at(const Json& json, const char* key) {
  std::vector<double> numbers;
  if (!at(json, key).is_array()) return numbers;
  for (const Json& value : at(json, key))
    numbers.push_back(value.is_number() ? value.get<double>()
                                        : std::numeric_limits<double>::quiet_NaN());
  return numbers;
}

std::optional<FrameColumns> frames_of(const Json& json) {
  FrameColumns out{numbers_at(json, "frame"), numbers_at(json, "off_mm"),
                   numbers_at(json, "spread_mm")};
  const std::size_t count = out.frame.size();
  if (count == 0 || out.off_mm.size() != count || out.spread_mm.size() != count)
    return std::nullopt;
  return out;
}

ReportedObject object_of(const Json& json) {
  ReportedObject object;
  object.verdict = verdict_of(at(json, "verdict"));
  object.notes = texts_at(json, "notes");
  object.frames = frames_of(at(json, "frame_residuals"));
  for (const char* key : {"expected_error_m", "seen_by", "invented"}) {
    const Json& values = at(json, key);
    if (!values.is_array()) continue;
    auto& out = object.per_vertex[key];
    for (const Json& value : values)
      out.push_back(value.is_number()    ? value.get<double>()
                    : value.is_boolean() ? double(value.get<bool>())
                                         : std::numeric_limits<double>::quiet_NaN());
  }
  return object;
}

/// A figure of the report with its display name.
struct FigureName {
  const char *key, *name, *unit;
};
constexpr std::array<FigureName, 6> kFigures{
    {{"frames", "Frames used", ""},
     {"dropped_frames", "Frames left out", ""},
     {"points", "Points measured on the object", ""},
     {"sensor_noise_mm", "Noise of one measurement", "mm"},
     {"merged_noise_mm", "Noise after frames are merged", "mm"},
     {"frame_spacing_mm", "Distance of neighbouring points in a frame", "mm"}}};

std::string figure_text(double value, const std::string& unit) {
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  const std::string number = whole ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
  return unit.empty() ? number : number + " " + unit;
}

void read_reconstruction(const Json& json, ReportFacts& facts) {
  for (const FigureName& figure : kFigures) {
    if (const auto value = number_at(json, figure.key))
      facts.figures.emplace_back(figure.name, figure_text(*value, figure.unit));
  }
  if (at(json, "parameters").is_array()) {
    for (const Json& p : at(json, "parameters"))
      facts.parameters.push_back({text_at(p, "option"), text_at(p, "value"), text_at(p, "reason")});
  }
  if (at(json, "objects").is_array()) {
    for (const Json& object : at(json, "objects")) facts.objects.push_back(object_of(object));
  }
  if (at(json, "seconds").is_object()) {
    for (const auto& [stage, seconds] : at(json, "seconds").items())
      if (seconds.is_number()) facts.seconds.emplace_back(stage, seconds.get<double>());
    std::stable_sort(facts.seconds.begin(), facts.seconds.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
  }
  if (at(json, "options").is_object())
    facts.options = at(json, "options").dump(2, ' ', false, Json::error_handler_t::replace);
  for (std::string& note : texts_at(json, "notes")) facts.notes.push_back(std::move(note));
}

}  // namespace

Result<ReportFacts> facts_of(const std::string& report) {
  ReportFacts facts;
  if (report.empty()) return facts;
  TURNSCAN_TRY(text::check_json_shape(report, file::ReadBudget(report.size())));
  const Json json = Json::parse(report, nullptr, false);
  if (!json.is_object())
    return fail(ErrorCode::kFormat,
                "report: it is not a JSON object; give the file that --report wrote");
  facts.version = text_at(json, "version");
  // A scan's report contains that of the reconstruction.
  const Json& inner = at(json, "reconstruction");
  if (inner.is_object()) {
    facts.version = text_at(inner, "version");
    facts.notes = texts_at(json, "notes");
  }
  read_reconstruction(inner.is_object() ? inner : json, facts);
  return facts;
}

}  // namespace turnscan::page
