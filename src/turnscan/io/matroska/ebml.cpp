#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <turnscan/io/matroska/ebml.hpp>

namespace turnscan::matroska {

namespace {

tl::unexpected<Error> refuse_read(const std::filesystem::path& path, int reason) {
  return fail_at(path.string(), reason == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo,
                 "cannot read it: {}", std::strerror(reason));
}

}  // namespace

Result<PositionedFile> PositionedFile::open(const std::filesystem::path& path) {
  PositionedFile out;
  out.path_ = path;
  // Without O_NONBLOCK, opening a pipe would block.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return refuse_read(path, errno);
  out.descriptor_ = std::shared_ptr<const int>(new int(descriptor), [](const int* owned) {
    ::close(*owned);
    delete owned;
  });
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return refuse_read(path, errno);
  if (!S_ISREG(status.st_mode))
    return fail_at(path.string(), ErrorCode::kFormat, "this is not a regular file");
  out.size_ = static_cast<std::uint64_t>(status.st_size);
  return out;
}

Result<std::string> PositionedFile::read(std::uint64_t at, std::uint64_t size) const {
  std::string out;
  if (at >= size_) return out;
  out.resize(std::min(size, size_ - at));
  std::size_t done = 0;
  while (done < out.size()) {
    const ssize_t got =
        ::pread(*descriptor_, out.data() + done, out.size() - done, static_cast<off_t>(at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return refuse_read(path_, errno);
    if (got == 0) break;  // truncated while open
    done += static_cast<std::size_t>(got);
  }
  out.resize(done);
  return out;
}

std::optional<VariableNumber> parse_variable_number(std::string_view bytes) {
  if (bytes.empty()) return std::nullopt;
  const auto first = static_cast<unsigned char>(bytes[0]);
  if (first == 0) return std::nullopt;
  VariableNumber out;
  out.length = static_cast<std::size_t>(std::countl_zero(first)) + 1;
  if (bytes.size() < out.length) return std::nullopt;
  out.value = first & (0xffu >> out.length);
  for (std::size_t i = 1; i < out.length; ++i)
    out.value = out.value << 8 | static_cast<unsigned char>(bytes[i]);
  out.all_ones = out.value == (std::uint64_t(1) << (7 * out.length)) - 1;
  return out;
}

std::optional<Element> parse_element(std::string_view bytes, std::uint64_t at) {
  const auto id = parse_variable_number(bytes);
  if (!id || id->length > 4) return std::nullopt;
  const auto size = parse_variable_number(bytes.substr(id->length));
  if (!size) return std::nullopt;
  Element out;
  out.id = static_cast<std::uint32_t>(id->value | std::uint64_t(1) << (7 * id->length));
  out.at = at;
  out.begin = at + id->length + size->length;
  out.size = size->value;
  out.known_size = !size->all_ones;
  return out;
}

std::optional<std::uint64_t> unsigned_number(std::string_view payload) {
  if (payload.size() > 8) return std::nullopt;
  std::uint64_t value = 0;
  for (const char c : payload) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

std::string text_of(std::string_view payload) {
  return std::string(payload.substr(0, payload.find('\0')));
}

std::optional<ChildElements::Child> ChildElements::next() {
  if (rest_.empty() || damaged_) return std::nullopt;
  const auto element = parse_element(rest_, 0);
  if (!element || !element->known_size || element->size > rest_.size() - element->begin) {
    damaged_ = true;
    return std::nullopt;
  }
  const Child child{element->id, rest_.substr(element->begin, element->size)};
  rest_.remove_prefix(element->begin + element->size);
  return child;
}

}  // namespace turnscan::matroska
