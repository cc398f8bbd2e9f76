#include <array>
#include <cmath>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/ply/ply_body.hpp>
#include <turnscan/io/ply/ply_rows.hpp>

namespace turnscan::ply {

namespace {

constexpr bool kLittleHere = std::endian::native == std::endian::little;

double color_scale(PlyType type) {
  if (is_floating(type)) return 255.0;
  return type == PlyType::kUint16 ? 1.0 / 257.0 : 1.0;
}

template <class T>
void put(char* target, T value) {
  std::memcpy(target, &value, sizeof(T));
}

void store(PlyColumn::Kind kind, double value, double scale, char* target) {
  switch (kind) {
    case PlyColumn::Kind::kFloat:
      put(target, static_cast<float>(value));
      break;
    case PlyColumn::Kind::kColor:
      put(target, value > 0.0 ? static_cast<std::uint8_t>(std::min(value * scale, 255.0) + 0.5)
                              : std::uint8_t(0));
      break;
    case PlyColumn::Kind::kIndex:
      put(target, value > 0.0 ? static_cast<std::uint32_t>(std::min(value, 4294967295.0))
                              : std::uint32_t(0));
      break;
  }
}

/// Copies one column of rows of equal length.
template <class T, bool kSwap>
void gather(const char* from, std::size_t row_bytes, std::uint64_t rows, const PlyColumn& column,
            PlyType type) {
  char* target = static_cast<char*>(column.target);
  const double scale = color_scale(type);
  if (column.kind == PlyColumn::Kind::kFloat) {
    for (std::uint64_t i = 0; i < rows; ++i)
      put(target + i * column.stride,
          static_cast<float>(file::load<T, kSwap>(from + i * row_bytes)));
    return;
  }
  for (std::uint64_t i = 0; i < rows; ++i)
    store(column.kind, static_cast<double>(file::load<T, kSwap>(from + i * row_bytes)), scale,
          target + i * column.stride);
}

/// Rows without lists have equal length and are read column by column.
template <bool kSwap>
Result<std::size_t> read_table(std::string_view bytes, std::size_t position,
                               const PlyElement& element, const PlyWanted& wanted) {
  std::vector<std::size_t> offsets;
  std::size_t row_bytes = 0;
  for (const PlyProperty& property : element.properties) {
    offsets.push_back(row_bytes);
    row_bytes += size_of(property.type);
  }
  if (element.count > (bytes.size() - position) / row_bytes)
    return fail(ErrorCode::kFormat, "the file ends within element '{}'", element.name);
  for (const PlyColumn& column : wanted.columns) {
    const PlyType type = element.properties[column.property].type;
    const char* from = bytes.data() + position + offsets[column.property];
    with_type(type, [&](auto t) {
      gather<decltype(t), kSwap>(from, row_bytes, element.count, column, type);
    });
  }
  return position + element.count * row_bytes;
}

/// Walks through rows whose length is only known after reading them.
template <class Rows>
class RowReader {
 public:
  RowReader(Rows rows, std::string_view bytes, const PlyElement& element, const PlyWanted& wanted)
      : rows_(rows), bytes_(bytes), element_(element), wanted_(wanted) {
    columns_.assign(element.properties.size(), nullptr);
    for (const PlyColumn& column : wanted.columns) columns_[column.property] = &column;
  }

  Result<std::size_t> read() {
    for (std::uint64_t row = 0; row < element_.count; ++row) {
      if (!rows_.begin_row() || !read_row(row) || !rows_.end_row()) return damaged(row);
    }
    return rows_.position();
  }

 private:
  bool read_row(std::uint64_t row) {
    for (std::size_t i = 0; i < element_.properties.size(); ++i) {
      const PlyProperty& property = element_.properties[i];
      if (!(property.is_list ? read_list(i, property) : read_scalar(i, property, row)))
        return false;
    }
    return true;
  }

  bool read_scalar(std::size_t i, const PlyProperty& property, std::uint64_t row) {
    const PlyColumn* column = columns_[i];
    if (column == nullptr) return rows_.skip(property.type);
    double value = 0.0;
    if (!rows_.scalar(property.type, value)) return false;
    store(column->kind, value, color_scale(property.type),
          static_cast<char*>(column->target) + row * column->stride);
    return true;
  }

  bool read_list(std::size_t i, const PlyProperty& property) {
    std::int64_t count = 0;
    if (!rows_.integer(property.count_type, count)) return false;
    if (count < 0 ||
        !rows_.can_hold(property.type, static_cast<std::uint64_t>(count), bytes_.size())) {
      why_ = "a list is longer than the file";
      return false;
    }
    const auto length = static_cast<std::size_t>(count);
    if (static_cast<int>(i) == wanted_.list) return read_wanted(property.type, length);
    for (std::size_t k = 0; k < length; ++k)
      if (!rows_.skip(property.type)) return false;
    return true;
  }

  bool read_wanted(PlyType type, std::size_t length) {
    if (list_.size() < length) list_.resize(length);
    for (std::size_t k = 0; k < length; ++k)
      if (!rows_.integer(type, list_[k])) return false;
    why_ = wanted_.on_list({list_.data(), length});
    return why_ == nullptr;
  }

  tl::unexpected<Error> damaged(std::uint64_t row) const {
    return fail(ErrorCode::kFormat, "damaged at {}, row {} of element '{}': {}", rows_.where(), row,
                element_.name, why_ != nullptr ? why_ : "not the values that the header promises");
  }

  Rows rows_;
  std::string_view bytes_;
  const PlyElement& element_;
  const PlyWanted& wanted_;
  std::vector<const PlyColumn*> columns_;
  std::vector<std::int64_t> list_;
  const char* why_ = nullptr;
};

template <class Rows>
Result<std::size_t> read_rows(std::string_view bytes, std::size_t position,
                              const PlyElement& element, const PlyWanted& wanted) {
  return RowReader<Rows>(Rows(bytes, position), bytes, element, wanted).read();
}

template <bool kSwap>
Result<std::size_t> read_binary(std::string_view bytes, std::size_t position,
                                const PlyElement& element, const PlyWanted& wanted) {
  if (!element.has_list()) return read_table<kSwap>(bytes, position, element, wanted);
  return read_rows<BinaryRows<kSwap>>(bytes, position, element, wanted);
}

}  // namespace

Result<std::size_t> read_ply_element(std::string_view bytes, std::size_t position, PlyFormat format,
                                     const PlyElement& element, const PlyWanted& wanted) {
  if (element.count == 0) return position;
  if (format == PlyFormat::kAscii) return read_rows<AsciiRows>(bytes, position, element, wanted);
  if ((format == PlyFormat::kLittleEndian) == kLittleHere)
    return read_binary<false>(bytes, position, element, wanted);
  return read_binary<true>(bytes, position, element, wanted);
}

}  // namespace turnscan::ply
