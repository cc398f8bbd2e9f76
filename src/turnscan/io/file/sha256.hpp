#pragma once
// SHA-256 (FIPS 180-4).

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::file {

class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// The digest, 32 bytes. add() must not be called afterwards.
  std::string finish();

 private:
  void add_block(const char* block);

  std::array<std::uint32_t, 8> state_;
  std::array<char, 64> rest_{};
  std::size_t used_ = 0;
  std::uint64_t length_ = 0;
};

/// Lower-case hexadecimal digits of bytes.
std::string hex_of(std::string_view bytes);

/// SHA-256 of a regular file's content, 64 digits. Fails with kNotFound or kIo.
Result<std::string> sha256_of_file(const std::filesystem::path& path);

}  // namespace turnscan::file
