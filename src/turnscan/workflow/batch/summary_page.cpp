#include <turnscan/workflow/batch/batch_summary.hpp>
#include <turnscan/workflow/page/encoding.hpp>

namespace turnscan::batch {

namespace {

using page::escaped;

constexpr std::string_view kSummaryStyle = R"css(
:root { color-scheme: light; }
body { margin: 0 auto; max-width: 78rem; padding: 1rem 1.25rem; color: #1d2430; background: #fff;
  font: 16px/1.45 system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.6rem; overflow-wrap: anywhere; }
.tasks { display: grid; grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)); gap: 1rem;
  list-style: none; padding: 0; }
.tasks li { border: 1px solid #d5d8dc; border-radius: 0.5rem; padding: 0.6rem;
  overflow-wrap: anywhere; }
.tasks img, .none { display: block; width: 100%; aspect-ratio: 1; object-fit: contain; }
.none { background: #f4f5f6; }
h2 { font-size: 1rem; margin: 0.5rem 0 0.3rem; }
p { margin: 0.25rem 0; font-size: 0.92rem; }
ul.why { margin: 0.25rem 0; padding-left: 1.1rem; font-size: 0.88rem; color: #4a5462; }
.badge { display: inline-block; padding: 0.05rem 0.6rem; border-radius: 1rem; font-weight: 700;
  font-size: 0.9rem; background: #e3e6ea; }
.badge.green { background: #1b6e3a; color: #fff; }
.badge.amber { background: #f2b632; }
.badge.red, .badge.failed { background: #b3261e; color: #fff; }
)css";

std::string counts_text(const BatchSummary& summary) {
  std::string text = fmt::format("{} tasks", summary.rows.size());
  for (const TaskState state :
       {TaskState::kDone, TaskState::kFailed, TaskState::kRunning, TaskState::kWaiting})
    if (const std::size_t count = summary.count(state); count > 0)
      text += fmt::format(", {} {}", count, name_of(state));
  return text;
}

std::string verdicts_text(const BatchSummary& summary) {
  std::string text;
  for (const char* verdict : {"green", "amber", "red"}) {
    std::size_t count = 0;
    for (const SummaryRow& row : summary.rows) count += row.facts.verdict == verdict ? 1 : 0;
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, verdict);
  }
  return text.empty() ? text : "<p>Verdicts: " + text + "</p>\n";
}

std::string options_text(const BatchTask& task) {
  std::string text;
  for (const auto& [name, value] : task.options)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
  return text.empty() ? text : "<p>" + escaped(text) + "</p>\n";
}

std::string card(const SummaryRow& row) {
  const std::string& name = row.task->name;
  const bool done = row.record.state == TaskState::kDone;
  std::string text = "<li>";
  text += row.thumbnail.empty()
              ? "<div class=\"none\"></div>"
              : fmt::format(
                    "<a href=\"tasks/{0}/result/\"><img loading=\"lazy\" src=\"{1}\" "
                    "alt=\"picture of {0}\"></a>",
                    escaped(name), escaped(row.thumbnail));
  text += fmt::format("<h2>{}</h2>\n", escaped(name));
  const std::string label =
      done && !row.facts.verdict.empty() ? row.facts.verdict : name_of(row.record.state);
  text += fmt::format("<p><span class=\"badge {0}\">{0}</span>", label);
  if (done && row.facts.triangles > 0)
    text += fmt::format(" {} triangles{}", row.facts.triangles,
                        row.facts.watertight ? ", watertight" : ", not watertight");
  text += fmt::format("</p>\n{}", options_text(*row.task));
  if (row.record.seconds > 0.0)
    text += fmt::format("<p>{:.1f} s, {:.0f} MB{}</p>\n", row.record.seconds,
                        static_cast<double>(row.record.peak_bytes) / 1e6,
                        row.record.host.empty() ? "" : ", " + escaped(row.record.host));
  if (!row.record.reason.empty() && !done)
    text += fmt::format("<p>{}</p>\n", escaped(row.record.reason));
  if (!row.facts.sentences.empty()) {
    text += "<ul class=\"why\">";
    for (const std::string& sentence : row.facts.sentences)
      text += fmt::format("<li>{}</li>", escaped(sentence));
    text += "</ul>";
  }
  return text + "</li>\n";
}

}  // namespace

std::string summary_page(const BatchSummary& summary, const std::string& title) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"script-src 'none'; object-src "
      "'none'; base-uri 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style></head>\n<body><h1>{0}</h1>\n<p>{2}</p>\n{3}"
      "<ul class=\"tasks\">\n",
      escaped(title), kSummaryStyle, counts_text(summary), verdicts_text(summary));
  for (const SummaryRow& row : summary.rows) text += card(row);
  return text + "</ul></body></html>\n";
}

}  // namespace turnscan::batch
