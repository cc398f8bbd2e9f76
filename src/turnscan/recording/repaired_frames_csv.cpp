#include <algorithm>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/recording/repaired_frames_csv.hpp>

namespace turnscan::recording_format {

namespace {

/// Lines without their ends; the byte order mark belongs to the first.
std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

class TableMender {
 public:
  TableMender(std::string_view text, text::CsvColumns columns)
      : lines_(lines_of(text)),
        columns_(std::move(columns)),
        end_(text.find("\r\n") < text.find('\n') ? "\r\n" : "\n") {}

  Result<std::string> mend(const std::vector<FrameRow>& rows, const RunContext& context) const {
    TURNSCAN_ASSIGN(const std::vector<bool> dropped, newly_dropped(rows, context));
    const bool add_column =
        !columns_.has("status") && std::find(dropped.begin(), dropped.end(), true) != dropped.end();
    std::string out(lines_.front());
    out += (add_column ? ",status" : "") + end_;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      TURNSCAN_TRY(context.check());
      const std::string_view line = lines_[rows[i].line - 1];
      if (add_column) {
        out += fmt::format("{},{}", line, dropped[i] ? "dropped" : "");
      } else if (dropped[i]) {
        TURNSCAN_ASSIGN(const std::string changed, with_status_dropped(line));
        out += changed;
      } else {
        out += line;
      }
      out += end_;
    }
    return out;
  }

 private:
  Result<std::vector<bool>> newly_dropped(const std::vector<FrameRow>& rows,
                                          const RunContext& context) const {
    std::vector<bool> out;
    for (const FrameRow& row : rows) {
      TURNSCAN_TRY(context.check());
      TURNSCAN_ASSIGN(const auto fields, text::csv_fields(lines_[row.line - 1]));
      out.push_back(row.info.status == FrameStatus::kDropped &&
                    columns_.field(fields, "status") != "dropped");
    }
    return out;
  }

  Result<std::string> with_status_dropped(std::string_view line) const {
    TURNSCAN_ASSIGN(std::vector<std::string> fields, text::csv_fields(line));
    fields[columns_.position("status")] = "dropped";
    for (std::string& field : fields) field = text::csv_field(field);
    return fmt::format("{}", fmt::join(fields, ","));
  }

  std::vector<std::string_view> lines_;
  text::CsvColumns columns_;
  std::string end_;
};

bool same_rows(const std::vector<FrameRow>& a, const std::vector<FrameRow>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const FrameRow& x, const FrameRow& y) {
        return frames_csv_line(x.info, x.color_file) == frames_csv_line(y.info, y.color_file);
      });
}

}  // namespace

Result<std::string> repaired_frames_csv(std::string_view text, const std::vector<FrameRow>& rows,
                                        std::size_t sensor_count, const RunContext& context) {
  text::LineReader reader(text);
  TURNSCAN_ASSIGN(text::CsvColumns columns, text::CsvColumns::parse(reader.next()->text));
  TURNSCAN_ASSIGN(std::string mended, TableMender(text, std::move(columns)).mend(rows, context));
  const auto back = parse_frames_csv(mended, sensor_count, context);
  TURNSCAN_TRY(context.check());
  if (!back || !same_rows(back->rows, rows))
    return fail(ErrorCode::kLibrary,
                "the mended table would not read back as the frames that it lists; the recording "
                "was left as it is");
  return mended;
}

}  // namespace turnscan::recording_format
