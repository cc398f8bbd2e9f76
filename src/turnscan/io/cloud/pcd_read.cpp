#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <turnscan/io/cloud/lzf.hpp>
#include <turnscan/io/cloud/pcd_header.hpp>
#include <turnscan/io/cloud/pcd_read.hpp>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::pcd {

namespace {

constexpr bool kSwap = std::endian::native == std::endian::big;

/// First value of a field, and the stride from point to point.
struct Column {
  const char* first = nullptr;  ///< nullptr: there is no such field
  std::size_t stride = 0;
  char type = 'F';
  std::size_t size = 4;

  double at(std::size_t i) const {
    const char* from = first + i * stride;
    if (type == 'F')
      return size == 4 ? double(file::load<float, kSwap>(from)) : file::load<double, kSwap>(from);
    switch (size) {
      case 1:
        return type == 'I' ? file::load<std::int8_t, kSwap>(from)
                           : file::load<std::uint8_t, kSwap>(from);
      case 2:
        return type == 'I' ? file::load<std::int16_t, kSwap>(from)
                           : file::load<std::uint16_t, kSwap>(from);
      case 4:
        return type == 'I' ? double(file::load<std::int32_t, kSwap>(from))
                           : double(file::load<std::uint32_t, kSwap>(from));
      default:
        return type == 'I' ? double(file::load<std::int64_t, kSwap>(from))
                           : double(file::load<std::uint64_t, kSwap>(from));
    }
  }
};

/// Locates the fields in unpacked data, stored point by point or field by field.
class Table {
 public:
  Table(const PcdHeader& header, const char* data) : header_(header), data_(data) {}

  Column column(std::string_view name) const {
    const int position = header_.find(name);
    if (position < 0) return {};
    const bool by_field = header_.data == PcdData::kCompressed;
    std::size_t offset = 0;
    for (int i = 0; i < position; ++i)
      offset +=
          header_.fields[static_cast<std::size_t>(i)].bytes() * (by_field ? header_.points : 1);
    const PcdField& field = header_.fields[static_cast<std::size_t>(position)];
    return {data_ + offset, by_field ? field.bytes() : header_.point_bytes(), field.type,
            field.size};
  }

  /// Empty unless all three fields exist.
  std::vector<Vec3f> vectors(const std::array<std::string_view, 3>& names) const {
    std::array<Column, 3> columns;
    for (std::size_t i = 0; i < 3; ++i) columns[i] = column(names[i]);
    for (const Column& c : columns)
      if (c.first == nullptr) return {};
    std::vector<Vec3f> values(header_.points);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = Vec3d(columns[0].at(i), columns[1].at(i), columns[2].at(i)).cast<float>();
    return values;
  }

 private:
  const PcdHeader& header_;
  const char* data_;
};

/// 0xAARRGGBB, as an integer of 4 bytes or as the bits of a float.
std::uint32_t packed_color(const Column& column, std::size_t i) {
  const auto bits = file::load<std::uint32_t, kSwap>(column.first + i * column.stride);
  // Text files declare even integers as F. The bits of a colour make a float below 1e-37 or, with
  // an opaque alpha, a huge negative one or NaN.
  const auto value = std::bit_cast<float>(bits);
  const bool integer_in_text = column.type == 'F' && value >= 1.0F && value < 4294967296.0F;
  return integer_in_text ? static_cast<std::uint32_t>(value) : bits;
}

std::vector<Rgb> read_colors(const Table& table, std::size_t points) {
  Column column = table.column("rgb");
  if (column.first == nullptr) column = table.column("rgba");
  if (column.first == nullptr || column.size != 4) return {};
  std::vector<Rgb> colors(points);
  for (std::size_t i = 0; i < points; ++i) {
    const std::uint32_t packed = packed_color(column, i);
    colors[i] = {static_cast<std::uint8_t>(packed >> 16), static_cast<std::uint8_t>(packed >> 8),
                 static_cast<std::uint8_t>(packed)};
  }
  return colors;
}

template <class T>
void append(std::string& target, T value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  target.append(bytes.data(), bytes.size());
}

bool append_integer(text::TextCursor& cursor, std::size_t size, std::string& target) {
  std::int64_t value = 0;
  if (!cursor.integer(value)) return false;
  auto bytes = std::bit_cast<std::array<char, 8>>(value);
  if constexpr (kSwap) std::reverse(bytes.begin(), bytes.end());
  target.append(bytes.data(), size);
  return true;
}

bool append_value(text::TextCursor& cursor, const PcdField& field, std::string& target) {
  if (field.type != 'F') return append_integer(cursor, field.size, target);
  if (field.size == 4) {
    float value = 0.0F;
    const bool ok = cursor.floating(value);
    append(target, file::load<float, kSwap>(reinterpret_cast<const char*>(&value)));
    return ok;
  }
  double value = 0.0;
  const bool ok = cursor.floating(value);
  append(target, file::load<double, kSwap>(reinterpret_cast<const char*>(&value)));
  return ok;
}

bool append_row(text::TextCursor& cursor, const PcdHeader& header, std::string& target) {
  cursor.skip_space();
  for (const PcdField& field : header.fields)
    for (std::uint64_t i = 0; i < field.count; ++i)
      if (!append_value(cursor, field, target)) return false;
  cursor.skip_blanks();
  return cursor.at_line_end();
}

/// Converts text data to the equivalent binary data.
Result<std::string> binary_of_text(std::string_view bytes, const PcdHeader& header) {
  std::string data;
  data.reserve(header.points * header.point_bytes());
  text::TextCursor cursor(bytes, header.body);
  for (std::uint64_t row = 0; row < header.points; ++row)
    if (!append_row(cursor, header, data))
      return fail(ErrorCode::kFormat, "damaged at line {}: not the values that the header promises",
                  cursor.line_number());
  return data;
}

Result<std::string> unpack(std::string_view bytes, const PcdHeader& header) {
  if (bytes.size() - header.body < 8)
    return fail(ErrorCode::kFormat, "the file ends before its compressed data");
  const std::uint64_t packed = file::load<std::uint32_t, kSwap>(bytes.data() + header.body);
  const std::uint64_t size = file::load<std::uint32_t, kSwap>(bytes.data() + header.body + 4);
  const std::uint64_t left = bytes.size() - header.body - 8;
  const std::uint64_t row = header.point_bytes();
  if (packed > left || size > packed * kMaxLzfRatio || size % row != 0 ||
      size / row != header.points)
    return fail(ErrorCode::kFormat,
                "the sizes of the compressed data ({} bytes for {}) do not fit the file's length "
                "or its {} points of {} bytes",
                packed, size, header.points, row);
  std::string data(size, '\0');
  if (!unpack_lzf(bytes.substr(header.body + 8, packed), data.data(), size))
    return fail(ErrorCode::kFormat, "the compressed data are damaged");
  return data;
}

void set_grid(const PcdHeader& header, CloudFile& file) {
  if (header.height < 2) return;
  file.grid_width = static_cast<int>(header.width);
  file.grid_height = static_cast<int>(header.height);
  file.grid.resize(header.points);
  for (std::size_t i = 0; i < file.grid.size(); ++i) file.grid[i] = static_cast<std::int32_t>(i);
}

CloudFile cloud_from(const PcdHeader& header, const char* data) {
  const Table table(header, data);
  CloudFile file;
  file.cloud.points = table.vectors({"x", "y", "z"});
  file.cloud.normals = table.vectors({"normal_x", "normal_y", "normal_z"});
  file.cloud.colors = read_colors(table, header.points);
  file.viewpoint = header.viewpoint;
  set_grid(header, file);
  return file;
}

}  // namespace

bool looks_like_pcd(std::string_view bytes) {
  return bytes.starts_with("# .PCD") || bytes.starts_with("VERSION") || bytes.starts_with("FIELDS");
}

Result<CloudFile> parse_pcd(std::string_view bytes) {
  TURNSCAN_ASSIGN(const PcdHeader header, parse_pcd_header(bytes));
  if (header.data == PcdData::kBinary) return cloud_from(header, bytes.data() + header.body);
  TURNSCAN_ASSIGN(const std::string data, header.data == PcdData::kAscii
                                              ? binary_of_text(bytes, header)
                                              : unpack(bytes, header));
  return cloud_from(header, data.data());
}

}  // namespace turnscan::pcd
