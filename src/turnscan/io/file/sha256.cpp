#include <turnscan/io/file/sha256.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

namespace turnscan::file {

namespace {

constexpr std::size_t kReadBytes = std::size_t(1) << 20;

constexpr std::array<std::uint32_t, 64> kSha256Constants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

/// A file open for reading.
class Sha256Source {
 public:
  explicit Sha256Source(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Sha256Source() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Sha256Source(const Sha256Source&) = delete;
  Sha256Source& operator=(const Sha256Source&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

tl::unexpected<Error> cannot_hash(const std::filesystem::path& path) {
  const int error = errno;
  return fail_at(path.string(), error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo,
                 "the file cannot be read: {}", std::generic_category().message(error));
}

}  // namespace

Sha256::Sha256()
    : state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
             0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19} {}

void Sha256::add(std::string_view bytes) {
  length_ += bytes.size();
  if (used_ > 0) {
    const std::size_t taken = std::min(bytes.size(), rest_.size() - used_);
    std::copy_n(bytes.data(), taken, rest_.data() + used_);
    used_ += taken;
    bytes.remove_prefix(taken);
    if (used_ < rest_.size()) return;
    add_block(rest_.data());
    used_ = 0;
  }
  for (; bytes.size() >= rest_.size(); bytes.remove_prefix(rest_.size())) add_block(bytes.data());
  std::copy(bytes.begin(), bytes.end(), rest_.data());
  used_ = bytes.size();
}

std::string Sha256::finish() {
  const std::uint64_t bits = 8 * length_;
  std::string padding(1, '\x80');
  padding.resize(1 + (119 - used_) % 64, '\0');
  for (int shift = 56; shift >= 0; shift -= 8)
    padding.push_back(static_cast<char>(bits >> shift & 0xff));
  add(padding);
  std::string digest;
  for (const std::uint32_t word : state_)
    for (int shift = 24; shift >= 0; shift -= 8)
      digest.push_back(static_cast<char>(word >> shift & 0xff));
  return digest;
}

// The names follow the standard (FIPS 180-4, 6.2.2).
void Sha256::add_block(const char* block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t i = 0; i < 64; ++i)
    w[i / 4] |= std::uint32_t(static_cast<unsigned char>(block[i])) << (24 - 8 * (i % 4));
  for (std::size_t i = 16; i < 64; ++i) {
    const std::uint32_t a = w[i - 15], b = w[i - 2];
    w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ (a >> 3)) + w[i - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ (b >> 10));
  }
  auto [a, b, c, d, e, f, g, h] = state_;
  for (std::size_t i = 0; i < 64; ++i) {
    const std::uint32_t t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                             ((e & f) ^ (~e & g)) + kSha256Constants[i] + w[i];
    const std::uint32_t t2 =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> sums{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state_[i] += sums[i];
}

std::string hex_of(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  for (const char c : bytes) {
    out += kDigits[static_cast<unsigned char>(c) >> 4];
    out += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return out;
}

Result<std::string> sha256_of_file(const std::filesystem::path& path) {
  const Sha256Source source(path);
  struct stat status {};
  if (source.descriptor() < 0 || ::fstat(source.descriptor(), &status) != 0)
    return cannot_hash(path);
  if (!S_ISREG(status.st_mode))
    return fail_at(path.string(), ErrorCode::kIo, "it is no regular file; give a file");
  Sha256 sum;
  std::vector<char> buffer(kReadBytes);
  for (;;) {
    const ssize_t got = ::read(source.descriptor(), buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return cannot_hash(path);
    if (got == 0) return hex_of(sum.finish());
    sum.add({buffer.data(), static_cast<std::size_t>(got)});
  }
}

}  // namespace turnscan::file
