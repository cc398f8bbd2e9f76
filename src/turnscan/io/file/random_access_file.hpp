#pragma once
// A file for random access from several threads at once.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan::file {

class RandomAccessFile {
 public:
  /// Fails as read_file() does: kNotFound, or kIo if it is not a regular file or cannot be read.
  static Result<RandomAccessFile> open(const std::filesystem::path& path);
  RandomAccessFile(RandomAccessFile&& other) noexcept;
  RandomAccessFile& operator=(RandomAccessFile&& other) noexcept;
  ~RandomAccessFile();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }  ///< at the time of opening

  /// Fills `bytes` starting at the offset. Fails with kIo (the system's message), and with kFormat
  /// if the file ends earlier.
  Result<> read(std::uint64_t offset, std::span<char> bytes) const;
  /// The same as a string; does not allocate memory for bytes beyond the file's end.
  Result<std::string> read(std::uint64_t offset, std::uint64_t size) const;

 private:
  RandomAccessFile(int descriptor, std::uint64_t size, std::filesystem::path path)
      : descriptor_(descriptor), size_(size), path_(std::move(path)) {}

  int descriptor_;
  std::uint64_t size_;
  std::filesystem::path path_;
};

}  // namespace turnscan::file
