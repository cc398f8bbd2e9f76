#include <turnscan/io/cloud/xyz_read.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <utility>

namespace turnscan::xyz {

namespace {

constexpr std::size_t kMaxColumns = 16;

struct XyzRow {
  std::array<double, kMaxColumns> values{};
  std::size_t count = 0;
};

/// False if something in the line is not a number, or there are too many.
bool parse_row(std::string_view line, XyzRow& row) {
  std::string points;
  std::string_view separators = ", \t";
  if (line.find(';') != line.npos) {
    points = line;
    std::replace(points.begin(), points.end(), ',', '.');
    line = points;
    separators = "; \t";
  }
  row.count = 0;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
    if (line.empty()) return true;
    if (line.front() == '+') line.remove_prefix(1);
    if (row.count == kMaxColumns) return false;
    const auto [end, error] =
        std::from_chars(line.data(), line.data() + line.size(), row.values[row.count++]);
    if (error != std::errc()) return false;
    line.remove_prefix(std::size_t(end - line.data()));
    if (!line.empty() && separators.find(line.front()) == separators.npos) return false;
  }
}

/// Takes the last three of six or seven columns for colours while they can be.
class ColorColumns {
 public:
  void add(const XyzRow& row) {
    if (!possible_) return;
    possible_ = row.count == 6 || row.count == 7;
    std::array<std::uint8_t, 3> c{};
    for (std::size_t i = 0; possible_ && i < 3; ++i) {
      const double value = row.values[row.count - 3 + i];
      possible_ = value >= 0.0 && value <= 255.0 && value == std::floor(value);
      if (possible_) c[i] = std::uint8_t(value);
      above_one_ |= c[i] > 1;  // else they may be normals
    }
    colors_.push_back({c[0], c[1], c[2]});
  }
  std::vector<Rgb> take() {
    return possible_ && above_one_ ? std::move(colors_) : std::vector<Rgb>();
  }

 private:
  std::vector<Rgb> colors_;
  bool possible_ = true, above_one_ = false;
};

}  // namespace

bool is_xyz_name(const std::filesystem::path& path) {
  const std::string ending = file::lower_extension(path);
  return ending == "xyz" || ending == "asc" || ending == "txt" || ending == "pts";
}

Result<CloudFile> parse_xyz(std::string_view bytes) {
  CloudFile out;
  ColorColumns colors;
  text::LineReader lines(bytes);
  XyzRow row;
  bool first = true;
  while (const auto line = lines.next_content()) {
    if (line->text.starts_with("//") || text::trimmed(line->text).empty()) continue;
    const bool numbers = parse_row(line->text, row);
    if (std::exchange(first, false) && (!numbers || row.count == 1)) continue;
    if (!numbers || row.count < 3)
      return fail(ErrorCode::kFormat, "line {}: this is not a point (x y z)", line->number);
    out.cloud.points.push_back(Vec3d(row.values[0], row.values[1], row.values[2]).cast<float>());
    colors.add(row);
  }
  out.cloud.colors = colors.take();
  return out;
}

}  // namespace turnscan::xyz
