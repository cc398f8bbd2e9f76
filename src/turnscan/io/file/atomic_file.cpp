#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/decode_file.hpp>
#include <turnscan/io/file/folder.hpp>

namespace turnscan {

namespace fs = std::filesystem;

namespace {

constexpr int kMaxTemporaries = 10000;
constexpr std::size_t kBufferBytes = std::size_t(1) << 16;

std::string words_of(int error) { return std::generic_category().message(error); }

tl::unexpected<Error> system_error(const fs::path& path, std::string_view what, int error) {
  const bool missing = error == ENOENT || error == ENOTDIR;
  return fail_at(path.string(), missing ? ErrorCode::kNotFound : ErrorCode::kIo, "{}: {}", what,
                 words_of(error));
}

/// Closes on destruction.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }
  int close() {
    const int result = value_ >= 0 ? ::close(value_) : 0;
    value_ = -1;
    return result;
  }

 private:
  int value_;
};

Result<> read_all(int descriptor, const fs::path& path, std::string& content) {
  std::size_t used = 0;
  while (used < content.size()) {
    const ssize_t got = ::read(descriptor, content.data() + used, content.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error(path, "cannot read", errno);
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
  }
  content.resize(used);
  return {};
}

/// base, flags: of openat().
Descriptor open_to_read(const fs::path& path, int base = AT_FDCWD, int flags = 0) {
  // O_NONBLOCK: opening a pipe must not wait for a writer.
  return Descriptor(::openat(base, path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | flags));
}

/// Call right after open_to_read, whose failure it reports.
Result<std::uint64_t> size_of_regular_file(const Descriptor& descriptor, const fs::path& path) {
  if (descriptor.get() < 0) return system_error(path, "cannot open", errno);
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) return system_error(path, "cannot read", errno);
  if (S_ISDIR(status.st_mode)) return system_error(path, "cannot read", EISDIR);
  if (!S_ISREG(status.st_mode))
    return fail_at(path.string(), ErrorCode::kIo, "cannot read: not a regular file");
  return static_cast<std::uint64_t>(status.st_size);
}

/// The target of a symbolic link, even if it does not exist yet.
fs::path follow_links(fs::path path) {
  std::error_code error;
  for (int depth = 0; depth < 40 && fs::is_symlink(path, error); ++depth) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> counter{0};
  return path.parent_path() / fmt::format(".{}.{}-{}.part", path.filename().string().substr(0, 200),
                                          ::getpid(), counter.fetch_add(1));
}

void sync_folder(int base, const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const Descriptor descriptor(::openat(base, folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Not every file system can sync a folder; the content itself is already on disk.
  if (descriptor.get() >= 0) (void)::fsync(descriptor.get());
}

Result<std::string> read_opened(const Descriptor& descriptor, const fs::path& path,
                                std::uint64_t max_bytes) {
  TURNSCAN_ASSIGN(const std::uint64_t size, size_of_regular_file(descriptor, path));
  if (size > max_bytes)
    return fail_at(path.string(), ErrorCode::kResourceLimit,
                   "the file has {} bytes: at most {} are allowed", size, max_bytes);
  std::string content(size, '\0');
  TURNSCAN_TRY(read_all(descriptor.get(), path, content));
  return content;
}

}  // namespace

Result<std::string> read_file(const fs::path& path, std::uint64_t max_bytes) {
  return read_opened(open_to_read(path), path, max_bytes);
}

Result<std::string> file::Folder::read(const std::string& name, std::uint64_t max_bytes) const {
  return read_opened(open_to_read(name, descriptor_, O_NOFOLLOW), path_ / name, max_bytes);
}

Result<> file::check_readable(const fs::path& path) {
  TURNSCAN_TRY(size_of_regular_file(open_to_read(path), path));
  return {};
}

FileSink::FileSink(int descriptor, std::string path)
    : descriptor_(descriptor),
      path_(std::move(path)),
      buffer_(std::make_unique_for_overwrite<char[]>(kBufferBytes)) {}

FileSink::~FileSink() = default;

Result<> FileSink::write(std::span<const std::byte> bytes) {
  return write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

Result<> FileSink::write(std::string_view text) {
  if (used_ + text.size() > kBufferBytes) TURNSCAN_TRY(flush());
  if (text.size() >= kBufferBytes) return write_through(text.data(), text.size());
  std::copy(text.begin(), text.end(), buffer_.get() + used_);
  used_ += text.size();
  return state_;
}

Result<> FileSink::flush() {
  const std::size_t size = used_;
  used_ = 0;
  return write_through(buffer_.get(), size);
}

Result<> FileSink::write_through(const char* data, std::size_t size) {
  while (state_ && size > 0) {
    const ssize_t done = ::write(descriptor_, data, size);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) {
      state_ = system_error(path_, "cannot write", errno);
      break;
    }
    data += done;
    size -= static_cast<std::size_t>(done);
  }
  return state_;
}

/// A file being written: the temporary file is removed unless commit() succeeded.
class AtomicFile {
 public:
  explicit AtomicFile(const fs::path& path) : name_(follow_links(path)) {
    std::error_code error;
    if (fs::exists(path, error) && !fs::equivalent(path, name_, error)) {
      // /dev/stdout may refer to a file without a name, or one that was renamed.
      name_ = path;
      nameless_ = true;
    }
    path_ = name_;
  }
  /// Whatever has the name is replaced, be it a link or a pipe.
  AtomicFile(const file::Folder& folder, const std::string& name)
      : base_(folder.descriptor()), path_(folder.path() / name), name_(name) {}
  ~AtomicFile() {
    if (!temporary_.empty()) ::unlinkat(base_, temporary_.c_str(), 0);
  }
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// verify: if given, checks the temporary file before it is renamed.
  Result<> write(const std::function<Result<>(FileSink&)>& body, Durability durability,
                 const std::function<Result<>(const fs::path&)>& verify = {}) {
    struct stat status {};
    const bool inside = base_ != AT_FDCWD;
    const bool there =
        ::fstatat(base_, name_.c_str(), &status, inside ? AT_SYMLINK_NOFOLLOW : 0) == 0;
    if (there && S_ISDIR(status.st_mode)) return system_error(path_, "cannot write", EISDIR);
    const bool regular = there && S_ISREG(status.st_mode);
    if (nameless_ || (there && !regular && !inside)) return write_directly(body);
    Descriptor descriptor(create_temporary());
    if (descriptor.get() < 0) return refuse(errno);
    if (regular) (void)::fchmod(descriptor.get(), status.st_mode & 07777);
    TURNSCAN_TRY(run(body, descriptor));
    if (durability == Durability::kSynced && ::fsync(descriptor.get()) != 0)
      return system_error(path_, "cannot write", errno);
    if (descriptor.close() != 0) return system_error(path_, "cannot write", errno);
    if (verify) TURNSCAN_TRY(verify(temporary_));
    return commit(durability);
  }

 private:
  /// -1 with errno set. A killed process with the same id may have left a file with the first name.
  int create_temporary() {
    for (int tries = 0;; ++tries) {
      temporary_ = temporary_beside(name_);
      const int descriptor =
          ::openat(base_, temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0 || errno != EEXIST || tries == kMaxTemporaries) return descriptor;
    }
  }

  Result<> refuse(int error) {
    temporary_.clear();  // not created by us
    return system_error(path_, "cannot write", error);
  }

  Result<> run(const std::function<Result<>(FileSink&)>& body, const Descriptor& descriptor) {
    FileSink sink(descriptor.get(), path_.string());
    TURNSCAN_TRY(body(sink));
    return sink.flush();
  }

  Result<> write_directly(const std::function<Result<>(FileSink&)>& body) {
    Descriptor descriptor(::open(path_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
    if (descriptor.get() < 0) return system_error(path_, "cannot write", errno);
    TURNSCAN_TRY(run(body, descriptor));
    if (descriptor.close() != 0) return system_error(path_, "cannot write", errno);
    return {};
  }

  Result<> commit(Durability durability) {
    if (::renameat(base_, temporary_.c_str(), base_, name_.c_str()) != 0)
      return system_error(path_, "cannot write", errno);
    temporary_.clear();
    if (durability == Durability::kSynced) sync_folder(base_, name_);
    return {};
  }

  int base_ = AT_FDCWD;  ///< of name_ and temporary_
  fs::path path_;        ///< for people
  fs::path name_;
  fs::path temporary_;
  bool nameless_ = false;
};

Result<> write_file_atomically(const fs::path& path, const std::function<Result<>(FileSink&)>& body,
                               Durability durability) {
  return AtomicFile(path).write(body, durability);
}

Result<> write_file_atomically(const fs::path& path, std::span<const std::byte> bytes,
                               Durability durability) {
  return write_file_atomically(
      path, [bytes](FileSink& sink) { return sink.write(bytes); }, durability);
}

Result<> write_file_atomically(const fs::path& path, std::string_view text, Durability durability) {
  return write_file_atomically(
      path, [text](FileSink& sink) { return sink.write(text); }, durability);
}

Result<> file::Folder::write(const std::string& name, std::string_view text,
                             Durability durability) const {
  return AtomicFile(*this, name)
      .write([text](FileSink& sink) { return sink.write(text); }, durability);
}

Result<> write_file_verified(const fs::path& path, std::string_view text) {
  const auto verify = [&](const fs::path& temporary) -> Result<> {
    auto back = read_file(temporary, text.size());
    if (back && *back == text) return {};
    return fail_at(path.string(), ErrorCode::kIo,
                   "what was written does not read back; the file was left as it is, check the "
                   "disk");
  };
  return AtomicFile(path).write([text](FileSink& sink) { return sink.write(text); },
                                Durability::kSynced, verify);
}

}  // namespace turnscan
