#pragma once
// Parses the elements of a Matroska file (EBML: RFC 8794): an identifier, a length, a payload.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::matroska {

/// An open file for positioned reads. read() may be called from several threads at once.
class PositionedFile {
 public:
  /// Fails with kNotFound, kIo, and kFormat if it is not a regular file.
  static Result<PositionedFile> open(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// `size` bytes from `at` on, fewer if the file ends earlier. Fails with kIo.
  Result<std::string> read(std::uint64_t at, std::uint64_t size) const;

 private:
  PositionedFile() = default;

  std::filesystem::path path_;
  std::uint64_t size_ = 0;
  std::shared_ptr<const int> descriptor_;
};

struct Element {
  std::uint32_t id = 0;     ///< including its length bits, as written in the specification
  std::uint64_t at = 0;     ///< offset of its first byte
  std::uint64_t begin = 0;  ///< offset of its payload
  std::uint64_t size = 0;   ///< of its payload; meaningless if not known
  bool known_size = true;   ///< false: it ends where an element begins that cannot be its child
};

/// Maximum length of identifier and length field together.
inline constexpr std::size_t kMaxElementHeader = 12;

/// Parses the element at the beginning of the bytes, which are at the file offset `at`. nullopt if
/// they do not begin an element.
std::optional<Element> parse_element(std::string_view bytes, std::uint64_t at);

/// A variable-length integer of 1 to 8 bytes whose leading bits encode its length; these bits are
/// removed. nullopt if there are too few bytes.
struct VariableNumber {
  std::uint64_t value = 0;
  std::size_t length = 0;
  bool all_ones = false;  ///< means "not known" for a length
};
std::optional<VariableNumber> parse_variable_number(std::string_view bytes);

/// Decoded payloads: unsigned integers of up to 8 bytes, text up to its first zero byte.
std::optional<std::uint64_t> unsigned_number(std::string_view payload);
std::string text_of(std::string_view payload);

/// Iterates over the elements inside a payload.
class ChildElements {
 public:
  explicit ChildElements(std::string_view payload) : rest_(payload) {}

  struct Child {
    std::uint32_t id;
    std::string_view payload;
  };
  /// nullopt at the end, and if the rest is damaged: see damaged().
  std::optional<Child> next();
  bool damaged() const { return damaged_; }

 private:
  std::string_view rest_;
  bool damaged_ = false;
};

}  // namespace turnscan::matroska
