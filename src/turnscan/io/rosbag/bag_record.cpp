#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/rosbag/bag_record.hpp>

namespace turnscan::rosbag {

namespace {

template <class T>
std::optional<T> number(std::string_view text) {
  if (text.size() != sizeof(T)) return std::nullopt;
  return file::load<T, false>(text.data());
}

}  // namespace

Result<RecordHeader> RecordHeader::parse(std::string_view bytes) {
  RecordHeader header;
  header.bytes_ = bytes;
  while (!bytes.empty()) {
    const auto length = number<std::uint32_t>(bytes.substr(0, 4));
    if (!length || *length > bytes.size() - 4)
      return fail(ErrorCode::kFormat, "a field is longer than its record's header");
    if (bytes.substr(4, *length).find('=') == std::string_view::npos)
      return fail(ErrorCode::kFormat, "a field of a record's header has no name");
    bytes.remove_prefix(4 + *length);
  }
  return header;
}

std::string_view RecordHeader::text(std::string_view name) const {
  for (std::string_view rest = bytes_; !rest.empty();) {
    const auto length = file::load<std::uint32_t, false>(rest.data());
    const std::string_view field = rest.substr(4, length);
    if (field.size() > name.size() && field.starts_with(name) && field[name.size()] == '=')
      return field.substr(name.size() + 1);
    rest.remove_prefix(4 + length);
  }
  return {};
}

std::optional<std::uint8_t> RecordHeader::u8(std::string_view name) const {
  return number<std::uint8_t>(text(name));
}

std::optional<std::uint32_t> RecordHeader::u32(std::string_view name) const {
  return number<std::uint32_t>(text(name));
}

std::optional<std::int64_t> RecordHeader::time_ns(std::string_view name) const {
  const std::string_view value = text(name);
  if (value.size() != 8) return std::nullopt;
  return std::int64_t(file::load<std::uint32_t, false>(value.data())) * 1000000000 +
         file::load<std::uint32_t, false>(value.data() + 4);
}

Result<RecordView> record_at(std::string_view bytes, std::size_t offset) {
  const auto length_at = [&](std::size_t at) {
    return at <= bytes.size() ? number<std::uint32_t>(bytes.substr(at, 4)) : std::nullopt;
  };
  const auto header_bytes = length_at(offset);
  if (!header_bytes || *header_bytes > kMaxHeaderBytes || *header_bytes > bytes.size() - offset - 4)
    return fail(ErrorCode::kFormat, "a record is longer than what holds it");
  const std::size_t data_at = offset + 4 + *header_bytes;
  const auto data_bytes = length_at(data_at);
  if (!data_bytes || *data_bytes > bytes.size() - data_at - 4)
    return fail(ErrorCode::kFormat, "a record is longer than what holds it");
  RecordView record;
  TURNSCAN_ASSIGN(record.header, RecordHeader::parse(bytes.substr(offset + 4, *header_bytes)));
  record.data = bytes.substr(data_at + 4, *data_bytes);
  record.end = data_at + 4 + *data_bytes;
  return record;
}

}  // namespace turnscan::rosbag
