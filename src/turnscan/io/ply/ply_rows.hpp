#pragma once
// Reads the rows of one element of a PLY file, value by value.

#include <span>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/ply/ply_header.hpp>
#include <turnscan/io/text/number_text.hpp>
#include <type_traits>

namespace turnscan::ply {

/// Calls f(T()) with the C++ type that corresponds to `type`.
template <class F>
auto with_type(PlyType type, const F& f) {
  switch (type) {
    case PlyType::kInt8:
      return f(std::int8_t());
    case PlyType::kUint8:
      return f(std::uint8_t());
    case PlyType::kInt16:
      return f(std::int16_t());
    case PlyType::kUint16:
      return f(std::uint16_t());
    case PlyType::kInt32:
      return f(std::int32_t());
    case PlyType::kUint32:
      return f(std::uint32_t());
    case PlyType::kFloat:
      return f(float());
    case PlyType::kDouble:
      break;
  }
  return f(double());
}

/// Source of values for ascii files: each row is a line. Functions return false if the text is
/// damaged.
class AsciiRows {
 public:
  AsciiRows(std::string_view bytes, std::size_t position) : cursor_(bytes, position) {}

  bool begin_row() {
    cursor_.skip_space();
    return !cursor_.at_end();
  }
  bool end_row() {
    cursor_.skip_blanks();
    return cursor_.at_line_end();
  }
  bool scalar(PlyType type, double& value) {
    if (type == PlyType::kFloat) {  // rounded once, directly to float
      float number = 0.0F;
      const bool ok = cursor_.floating(number);
      value = static_cast<double>(number);
      return ok;
    }
    if (type == PlyType::kDouble) return cursor_.floating(value);
    std::int64_t number = 0;
    const bool ok = cursor_.integer(number);
    value = static_cast<double>(number);
    return ok;
  }
  bool integer(PlyType, std::int64_t& value) { return cursor_.integer(value); }
  bool skip(PlyType) {
    cursor_.skip_blanks();
    return !cursor_.word().empty();
  }
  /// Whether the file can contain this many more values.
  bool can_hold(PlyType, std::uint64_t count, std::size_t file_bytes) const {
    return count <= (file_bytes - cursor_.position()) / 2 + 1;
  }
  std::size_t position() const { return cursor_.position(); }
  std::string where() const { return fmt::format("line {}", cursor_.line_number()); }

 private:
  text::TextCursor cursor_;
};

template <bool kSwap>
class BinaryRows {
 public:
  BinaryRows(std::string_view bytes, std::size_t position) : bytes_(bytes), at_(position) {}

  bool begin_row() const { return true; }
  bool end_row() const { return true; }
  bool scalar(PlyType type, double& value) {
    if (bytes_.size() - at_ < size_of(type)) return false;
    value = with_type(type, [this](auto t) {
      return static_cast<double>(file::load<decltype(t), kSwap>(bytes_.data() + at_));
    });
    at_ += size_of(type);
    return true;
  }
  bool integer(PlyType type, std::int64_t& value) {
    if (bytes_.size() - at_ < size_of(type)) return false;
    value = with_type(type, [this](auto t) {
      return static_cast<std::int64_t>(file::load<decltype(t), kSwap>(bytes_.data() + at_));
    });
    at_ += size_of(type);
    return true;
  }
  bool skip(PlyType type) {
    if (bytes_.size() - at_ < size_of(type)) return false;
    at_ += size_of(type);
    return true;
  }
  bool can_hold(PlyType type, std::uint64_t count, std::size_t file_bytes) const {
    return count <= (file_bytes - at_) / size_of(type);
  }
  std::size_t position() const { return at_; }
  std::string where() const { return fmt::format("byte {}", at_); }

 private:
  std::string_view bytes_;
  std::size_t at_;
};

}  // namespace turnscan::ply
