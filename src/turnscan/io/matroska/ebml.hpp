#pragma once
// The elements of which a Matroska file consists (EBML: RFC 8794): an identifier, a length, a
// payload. And the file, read by position.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::matroska {

/// An open file. read() may be called from several threads at once.
class PositionedFile {
 public:
  /// Fails with kNotFound, kIo, and kFormat for what is not a regular file.
  static Result<PositionedFile> open(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// `size` bytes from `at` on, fewer where the file ends earlier. Fails with kIo.
  Result<std::string> read(std::uint64_t at, std::uint64_t size) const;

 private:
  PositionedFile() = default;

  std::filesystem::path path_;
  std::uint64_t size_ = 0;
  std::shared_ptr<const int> descriptor_;
};

struct Element {
  std::uint32_t id = 0;     ///< with the bits that tell its length, as the specification writes it
  std::uint64_t at = 0;     ///< of its first byte
  std::uint64_t begin = 0;  ///< of its payload
  std::uint64_t size = 0;   ///< of its payload; meaningless where it is not known
  bool known_size = true;   ///< false: it lasts until something begins that cannot be inside
};

/// The longest identifier and length.
inline constexpr std::size_t kMaxElementHeader = 12;

/// The element that begins with the first of the bytes, which lies `at` that place. Nothing where
/// these bytes begin none.
std::optional<Element> parse_element(std::string_view bytes, std::uint64_t at);

/// A whole number of 1 to 8 bytes whose first bits tell its length; those are left out. Nothing
/// where there are too few bytes.
struct VariableNumber {
  std::uint64_t value = 0;
  std::size_t length = 0;
  bool all_ones = false;  ///< "not known" where it is a length
};
std::optional<VariableNumber> parse_variable_number(std::string_view bytes);

/// Payloads: whole numbers of up to 8 bytes, text up to its first zero byte.
std::optional<std::uint64_t> unsigned_number(std::string_view payload);
std::string text_of(std::string_view payload);

/// The elements inside a payload, one after another.
class ChildElements {
 public:
  explicit ChildElements(std::string_view payload) : rest_(payload) {}

  struct Child {
    std::uint32_t id;
    std::string_view payload;
  };
  /// Nothing at the end, and where what follows is damaged: see damaged().
  std::optional<Child> next();
  bool damaged() const { return damaged_; }

 private:
  std::string_view rest_;
  bool damaged_ = false;
};

}  // namespace turnscan::matroska
