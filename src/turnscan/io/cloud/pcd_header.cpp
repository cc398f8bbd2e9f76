#include <limits>
#include <turnscan/io/cloud/pcd_header.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::pcd {

namespace {

constexpr std::size_t kMaxFields = 1024;
constexpr std::uint64_t kMaxPoints = std::numeric_limits<std::int32_t>::max();

class HeaderParser {
 public:
  explicit HeaderParser(std::string_view bytes) : bytes_(bytes), cursor_(bytes) {}

  Result<PcdHeader> parse() {
    for (bool more = true; more;) {
      if (cursor_.at_end()) return damaged("it has no DATA");
      cursor_.skip_blanks();
      const std::string_view keyword = cursor_.word();
      more = keyword != "DATA";
      TURNSCAN_TRY(statement(keyword));
      cursor_.skip_line();
    }
    header_.body = cursor_.position();
    TURNSCAN_TRY(check());
    return std::move(header_);
  }

 private:
  tl::unexpected<Error> damaged(std::string_view why) const {
    return fail(ErrorCode::kFormat, "PCD header, line {}: {}", cursor_.line_number(), why);
  }

  Result<> statement(std::string_view keyword) {
    if (keyword.empty() || keyword.front() == '#' || keyword == "VERSION") return {};
    if (keyword == "FIELDS") return fields();
    if (keyword == "SIZE") return each([this](PcdField& field) { return number(field.size); });
    if (keyword == "TYPE") return each([this](PcdField& field) { return type(field.type); });
    if (keyword == "COUNT") return each([this](PcdField& field) { return number(field.count); });
    if (keyword == "WIDTH") return size(header_.width);
    if (keyword == "HEIGHT") return size(header_.height);
    if (keyword == "POINTS") return size(header_.points);
    if (keyword == "VIEWPOINT") return viewpoint();
    if (keyword == "DATA") return data();
    return damaged(fmt::format("unknown statement '{}'", keyword.substr(0, 40)));
  }

  Result<> fields() {
    header_.fields.clear();
    for (cursor_.skip_blanks(); !cursor_.at_line_end(); cursor_.skip_blanks()) {
      if (header_.fields.size() >= kMaxFields) return damaged("too many fields");
      PcdField field;
      field.name = std::string(cursor_.word());
      if (field.name.empty()) return damaged("an unexpected character");
      header_.fields.push_back(std::move(field));
    }
    return {};
  }

  template <class Read>
  Result<> each(const Read& read) {
    for (PcdField& field : header_.fields)
      if (!read(field)) return damaged("not the values that its fields need");
    return {};
  }

  bool number(std::uint64_t& value) {
    std::int64_t read = 0;
    if (!cursor_.integer(read) || read < 0) return false;
    value = static_cast<std::uint64_t>(read);
    return true;
  }

  bool type(char& value) {
    cursor_.skip_blanks();
    const std::string_view text = cursor_.word();
    if (text != "I" && text != "U" && text != "F") return false;
    value = text.front();
    return true;
  }

  Result<> size(std::uint64_t& value) {
    if (!number(value) || value > kMaxPoints) return damaged("not a number of points");
    return {};
  }

  Result<> viewpoint() {
    Viewpoint read;
    for (int i = 0; i < 3; ++i)
      if (!cursor_.floating(read.value[i]) || !std::isfinite(read.value[i]))
        return damaged("not a position");
    header_.viewpoint = read;
    return {};
  }

  Result<> data() {
    cursor_.skip_blanks();
    const std::string_view kind = cursor_.word();
    if (kind == "ascii")
      header_.data = PcdData::kAscii;
    else if (kind == "binary")
      header_.data = PcdData::kBinary;
    else if (kind == "binary_compressed")
      header_.data = PcdData::kCompressed;
    else
      return damaged(fmt::format("unknown kind of data '{}'", kind.substr(0, 40)));
    return {};
  }

  Result<> check_fields() const {
    for (const PcdField& f : header_.fields) {
      const bool size_ok =
          f.size == 4 || f.size == 8 || ((f.size == 1 || f.size == 2) && f.type != 'F');
      if (!size_ok || f.count < 1 || f.count > bytes_.size())
        return fail(ErrorCode::kFormat, "PCD header: field '{}' has size {}, type {}, count {}",
                    f.name.substr(0, 40), f.size, f.type, f.count);
    }
    for (const std::string_view name : {"x", "y", "z"})
      if (header_.find(name) < 0)
        return fail(ErrorCode::kFormat, "PCD header: there is no field '{}'", name);
    return {};
  }

  Result<> check() {
    TURNSCAN_TRY(check_fields());
    if (header_.width == 0 && header_.height == 1) header_.width = header_.points;
    if (header_.points == 0) header_.points = header_.width * header_.height;
    if (header_.width * header_.height != header_.points || header_.points > kMaxPoints)
      return fail(ErrorCode::kFormat, "PCD header: {} points are not {} x {}", header_.points,
                  header_.width, header_.height);
    if (header_.data == PcdData::kCompressed) return {};
    const bool ascii = header_.data == PcdData::kAscii;
    const std::uint64_t left = bytes_.size() - header_.body + (ascii ? 1 : 0);
    const std::uint64_t row = ascii ? 2 * header_.values_per_point() : header_.point_bytes();
    if (header_.points > left / row)
      return fail(ErrorCode::kFormat,
                  "the file is too short: its header promises {} points of at least {} bytes, and "
                  "only {} bytes are left",
                  header_.points, row, left);
    return {};
  }

  std::string_view bytes_;
  text::TextCursor cursor_;
  PcdHeader header_;
};

}  // namespace

std::uint64_t PcdHeader::point_bytes() const {
  std::uint64_t sum = 0;
  for (const PcdField& field : fields) sum += field.bytes();
  return sum;
}

std::uint64_t PcdHeader::values_per_point() const {
  std::uint64_t sum = 0;
  for (const PcdField& field : fields) sum += field.count;
  return sum;
}

int PcdHeader::find(std::string_view name) const {
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].name == name) return static_cast<int>(i);
  return -1;
}

Result<PcdHeader> parse_pcd_header(std::string_view bytes) { return HeaderParser(bytes).parse(); }

}  // namespace turnscan::pcd
