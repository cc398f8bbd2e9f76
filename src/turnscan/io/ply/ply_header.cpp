#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <turnscan/io/ply/ply_header.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::ply {

namespace {

constexpr std::size_t kMaxHeaderBytes = std::size_t(1) << 20;
constexpr std::size_t kMaxProperties = 1024;  // of all elements together

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> kTypes{{{"char", PlyType::kInt8},
                                           {"int8", PlyType::kInt8},
                                           {"uchar", PlyType::kUint8},
                                           {"uint8", PlyType::kUint8},
                                           {"short", PlyType::kInt16},
                                           {"int16", PlyType::kInt16},
                                           {"ushort", PlyType::kUint16},
                                           {"uint16", PlyType::kUint16},
                                           {"int", PlyType::kInt32},
                                           {"int32", PlyType::kInt32},
                                           {"uint", PlyType::kUint32},
                                           {"uint32", PlyType::kUint32},
                                           {"float", PlyType::kFloat},
                                           {"float32", PlyType::kFloat},
                                           {"double", PlyType::kDouble},
                                           {"float64", PlyType::kDouble}}};

Result<PlyType> type_from(std::string_view name) {
  for (const TypeName& type : kTypes)
    if (type.name == name) return type.type;
  return fail(ErrorCode::kUnsupported, "PLY header: '{}' is not a type of PLY", name.substr(0, 40));
}

class HeaderParser {
 public:
  explicit HeaderParser(std::string_view bytes) : bytes_(bytes), cursor_(bytes) {}

  Result<PlyHeader> parse() {
    cursor_.skip_line();  // "ply"
    for (bool more = true; more;) {
      if (cursor_.at_end() || cursor_.position() > kMaxHeaderBytes)
        return damaged("it has no end_header");
      cursor_.skip_blanks();
      const std::string_view keyword = cursor_.word();
      more = keyword != "end_header";
      if (more) TURNSCAN_TRY(statement(keyword));
      cursor_.skip_line();
    }
    header_.body = cursor_.position();
    if (!has_format_) return damaged("it does not say its format");
    TURNSCAN_TRY(check_elements());
    return std::move(header_);
  }

 private:
  tl::unexpected<Error> damaged(std::string_view why) const {
    return fail(ErrorCode::kFormat, "PLY header, line {}: {}", cursor_.line_number(), why);
  }

  std::string_view next_word() {
    cursor_.skip_blanks();
    return cursor_.word();
  }

  Result<> statement(std::string_view keyword) {
    if (keyword == "format") return format();
    if (keyword == "element") return element();
    if (keyword == "property") return property();
    if (keyword == "obj_info") {
      header_.obj_info.emplace_back(cursor_.rest_of_line());
      return {};
    }
    if (keyword == "comment" || keyword.empty()) return {};
    return damaged(fmt::format("unknown statement '{}'", keyword.substr(0, 40)));
  }

  Result<> format() {
    const std::string_view name = next_word();
    if (name == "ascii")
      header_.format = PlyFormat::kAscii;
    else if (name == "binary_little_endian")
      header_.format = PlyFormat::kLittleEndian;
    else if (name == "binary_big_endian")
      header_.format = PlyFormat::kBigEndian;
    else
      return damaged(fmt::format("unknown format '{}'", name.substr(0, 40)));
    has_format_ = true;
    return {};
  }

  Result<> element() {
    PlyElement element;
    element.name = std::string(next_word());
    const std::string_view count = next_word();
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || error != std::errc() || end != count.data() + count.size())
      return damaged("an element needs a name and a count");
    if (header_.elements.size() >= kMaxProperties) return damaged("too many elements");
    if (header_.find(element.name) != nullptr)
      return damaged(fmt::format("element '{}' appears twice", element.name));
    header_.elements.push_back(std::move(element));
    return {};
  }

  Result<> property() {
    if (header_.elements.empty()) return damaged("a property before the first element");
    if (++property_count_ > kMaxProperties) return damaged("too many properties");
    PlyProperty property;
    std::string_view type = next_word();
    property.is_list = type == "list";
    if (property.is_list) {
      TURNSCAN_ASSIGN(property.count_type, type_from(next_word()));
      if (is_floating(property.count_type)) return damaged("the count of a list is not an integer");
      type = next_word();
    }
    TURNSCAN_ASSIGN(property.type, type_from(type));
    property.name = std::string(next_word());
    if (property.name.empty()) return damaged("a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
    return {};
  }

  /// Checks the counts against the length of the file, before anything is allocated for them.
  Result<> check_elements() const {
    // The last line of a text need not be terminated.
    std::uint64_t left = bytes_.size() - header_.body + (header_.format == PlyFormat::kAscii);
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0) continue;
      if (element.properties.empty())
        return fail(ErrorCode::kFormat, "PLY header: element '{}' has no properties", element.name);
      const std::uint64_t row = element.min_row_bytes(header_.format);
      if (element.count > left / row)
        return fail(ErrorCode::kFormat,
                    "the file is too short: its header promises {} of element '{}', which need at "
                    "least {} bytes each, and only {} bytes are left",
                    element.count, element.name, row, left);
      left -= element.count * row;
    }
    return {};
  }

  std::string_view bytes_;
  text::TextCursor cursor_;
  PlyHeader header_;
  bool has_format_ = false;
  std::size_t property_count_ = 0;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_floating(PlyType type) { return type == PlyType::kFloat || type == PlyType::kDouble; }

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end())
      return static_cast<int>(i);
  return -1;
}

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& p) { return p.is_list; });
}

std::uint64_t PlyElement::min_row_bytes(PlyFormat format) const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : properties)
    bytes += format == PlyFormat::kAscii ? 2 : size_of(p.is_list ? p.count_type : p.type);
  return bytes;
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  for (const PlyElement& element : elements)
    if (element.name == name) return &element;
  return nullptr;
}

std::string_view PlyHeader::info(std::string_view key) const {
  for (const std::string& text : obj_info) {
    text::TextCursor cursor(text);
    if (cursor.word() == key) return cursor.rest_of_line();
  }
  return {};
}

bool looks_like_ply(std::string_view bytes) {
  return bytes.starts_with("ply") && bytes.size() > 4 &&
         (bytes[3] == '\n' || bytes.substr(3, 2) == "\r\n" || text::is_blank(bytes[3]));
}

Result<PlyHeader> parse_ply_header(std::string_view bytes) {
  if (!looks_like_ply(bytes)) return fail(ErrorCode::kUnsupported, "not a PLY file");
  return HeaderParser(bytes).parse();
}

}  // namespace turnscan::ply
