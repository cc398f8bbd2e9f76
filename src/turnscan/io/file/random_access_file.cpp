#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <turnscan/io/file/random_access_file.hpp>
#include <utility>

namespace turnscan::file {

namespace {

std::string words_of_errno(int number) { return std::generic_category().message(number); }

}  // namespace

Result<RandomAccessFile> RandomAccessFile::open(const std::filesystem::path& path) {
  // Opening a pipe without a writer must not block.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    const int error = errno;
    return fail_at(path.string(), error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo,
                   "it cannot be read ({})", words_of_errno(error));
  }
  RandomAccessFile file(descriptor, 0, path);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    return fail_at(path.string(), ErrorCode::kIo, "this is not a file; name one");
  file.size_ = std::uint64_t(status.st_size);
  return file;
}

RandomAccessFile::RandomAccessFile(RandomAccessFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      path_(std::move(other.path_)) {}

RandomAccessFile& RandomAccessFile::operator=(RandomAccessFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  std::swap(path_, other.path_);
  return *this;
}

RandomAccessFile::~RandomAccessFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<> RandomAccessFile::read(std::uint64_t offset, std::span<char> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = offset > size_ ? 0
                                       : ::pread(descriptor_, bytes.data(), bytes.size(),
                                                 static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      return fail_at(path_.string(), ErrorCode::kIo, "it cannot be read at byte {} ({})", offset,
                     words_of_errno(errno));
    if (got == 0)
      return fail_at(path_.string(), ErrorCode::kFormat,
                     "the file ends at byte {}, but more was to follow; it is cut off", size_);
    bytes = bytes.subspan(std::size_t(got));
    offset += std::uint64_t(got);
  }
  return {};
}

Result<std::string> RandomAccessFile::read(std::uint64_t offset, std::uint64_t size) const {
  if (offset > size_ || size > size_ - offset)
    return fail_at(path_.string(), ErrorCode::kFormat,
                   "the file ends at byte {}, but more was to follow; it is cut off", size_);
  std::string bytes(std::size_t(size), '\0');
  TURNSCAN_TRY(read(offset, std::span(bytes)));
  return bytes;
}

}  // namespace turnscan::file
