#pragma once
// A file of which parts are read, by several threads at once.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan::file {

class RandomAccessFile {
 public:
  /// Fails as read_file() does: kNotFound, or kIo for what is not a regular file or cannot be read.
  static Result<RandomAccessFile> open(const std::filesystem::path& path);
  RandomAccessFile(RandomAccessFile&& other) noexcept;
  RandomAccessFile& operator=(RandomAccessFile&& other) noexcept;
  ~RandomAccessFile();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }  ///< when it was opened

  /// Fills `bytes` from the offset on. Fails with kIo (the system's words), and with kFormat where
  /// the file ends before.
  Result<> read(std::uint64_t offset, std::span<char> bytes) const;
  /// The same as a string; nothing is allocated for what lies beyond the file's end.
  Result<std::string> read(std::uint64_t offset, std::uint64_t size) const;

 private:
  RandomAccessFile(int descriptor, std::uint64_t size, std::filesystem::path path)
      : descriptor_(descriptor), size_(size), path_(std::move(path)) {}

  int descriptor_;
  std::uint64_t size_;
  std::filesystem::path path_;
};

}  // namespace turnscan::file
