#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <optional>
#include <regex>
#include <string_view>
#include <system_error>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/recording/file_check.hpp>

namespace turnscan::recording_format {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHeaderBytes = 64 * 1024;

class InputFile {
 public:
  // O_NONBLOCK: opening a pipe must not wait for a writer.
  explicit InputFile(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    struct stat status {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
      error_ = errno;
      return;
    }
    regular_ = S_ISREG(status.st_mode);
    if (regular_) size_ = static_cast<std::uint64_t>(status.st_size);
  }
  ~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  int error() const { return error_; }  ///< of opening or reading; 0: none
  bool regular() const { return regular_; }
  std::uint64_t size() const { return size_; }
  std::string read(std::uint64_t offset, std::size_t count) {
    std::string bytes(count, '\0');
    const ssize_t got = ::pread(descriptor_, bytes.data(), count, static_cast<off_t>(offset));
    if (got < 0) error_ = errno;
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }
  bool ends_with(std::string_view tail) {
    return size_ >= tail.size() && read(size_ - tail.size(), tail.size()) == tail;
  }

 private:
  int descriptor_;
  int error_ = 0;
  bool regular_ = false;
  std::uint64_t size_ = 0;
};

struct PlyOutline {
  std::size_t bytes = 0;
  std::uint64_t least_body = 0;  ///< minimum size of the body
};

std::uint64_t size_of_type(std::string_view type) {
  if (type == "double" || type == "float64") return 8;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  return 4;
}

/// Minimum number of bytes that a property adds to an element.
std::uint64_t least_size(const std::vector<std::string_view>& words, bool ascii) {
  if (ascii) return 2;  // a digit and a separator
  return size_of_type(words[1] == "list" && words.size() > 2 ? words[2] : words[1]);
}

/// Counts are only summed here, never used for allocation; 2^40 keeps the sum from wrapping.
std::optional<PlyOutline> ply_outline(std::string_view text) {
  if (!text.starts_with("ply")) return std::nullopt;
  bool ascii = false;
  std::uint64_t count = 0;
  PlyOutline header;
  text::LineReader lines(text);
  while (const auto line = lines.next()) {
    const auto words = text::words_of(line->text.substr(0, 1000));
    if (words.empty()) continue;
    if (words[0] == "end_header" && line->ended) {
      header.bytes =
          static_cast<std::size_t>(line->text.data() - text.data()) + line->text.size() + 1;
      return header;
    }
    if (words[0] == "format" && words.size() > 1) ascii = words[1] == "ascii";
    if (words[0] == "element" && words.size() > 2) {
      count = 0;
      (void)std::from_chars(words[2].data(), words[2].data() + words[2].size(), count);
      count = std::min(count, std::uint64_t(1) << 40);
    }
    if (words[0] == "property" && words.size() > 1)
      header.least_body += count * least_size(words, ascii);
  }
  return std::nullopt;
}

std::string defect_of_ply(InputFile& file) {
  const auto header = ply_outline(file.read(0, kHeaderBytes));
  if (!header) return "its header is damaged";
  // The last value of an ASCII file need not be followed by a separator.
  return file.size() + 1 < header->bytes + header->least_body ? "is truncated" : "";
}

std::string defect_of_content(InputFile& file, const std::string& extension) {
  using namespace std::string_view_literals;
  if (file.size() == 0) return "is empty";
  // PNG specification (ISO/IEC 15948), 11.2.5: an IEND chunk has no data and a fixed CRC.
  if (extension == "png" && !file.ends_with("\0\0\0\0IEND\xAE\x42\x60\x82"sv))
    return "is truncated";
  if ((extension == "jpg" || extension == "jpeg") && !file.ends_with("\xFF\xD9"sv))
    return "is truncated";
  return extension == "ply" ? defect_of_ply(file) : "";
}

FileCheck unreadable(const char* what, int error) {
  const bool ours = error == EMFILE || error == ENFILE || error == ENOMEM;
  return {ours ? FileState::kNoResources : FileState::kUnreadable,
          fmt::format("{} ({})", what, std::generic_category().message(error))};
}

}  // namespace

FileCheck check_file(const fs::path& path) {
  InputFile file(path);
  // A name that exceeds the limits of the file system cannot have been written, either.
  if (file.error() == ENOENT || file.error() == ENOTDIR || file.error() == ENAMETOOLONG)
    return {FileState::kLost, "is missing"};
  if (file.error() != 0) return unreadable("cannot be opened", file.error());
  if (!file.regular()) return {FileState::kUnreadable, "is not a regular file"};
  std::string defect = defect_of_content(file, file::lower_extension(path));
  if (file.error() != 0) return unreadable("cannot be read", file.error());
  if (defect.empty()) return {};
  return {FileState::kLost, std::move(defect)};
}

FileCheck check_frame_file(const fs::path& folder, const FrameRow& row) {
  if (row.info.file.empty()) return {FileState::kLost, "is not named"};
  return check_file(folder / row.info.file);
}

bool is_leftover(const std::string& name) {
  static const std::regex pattern(R"(\.(.*\.[0-9]+-[0-9]+|recording\.json)\.part)");
  return name.size() < 256 && std::regex_match(name, pattern);
}

}  // namespace turnscan::recording_format
