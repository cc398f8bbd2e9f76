// Streams in data/ were packed by the reference encoder (lzfse 1.0, `lzfse -encode`) from the bytes
// that the functions below make; depth-bvx1.lzfse is depth.lzfse whose header the reference's own
// decoder had unpacked to the older kind, which no encoder writes any more.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <turnscan/io/lzfse/lzfse.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::lzfse {
namespace {

using ::testing::HasSubstr;

std::string stream(std::string_view name) {
  const std::string bytes =
      testing::content_of(std::filesystem::path(TURNSCAN_IO_TESTS) / "lzfse/data" / name);
  EXPECT_FALSE(bytes.empty()) << name;
  return bytes;
}

class Sequence {
 public:
  explicit Sequence(std::uint32_t seed) : state_(seed) {}
  std::uint32_t next() {
    state_ = state_ * 1664525U + 1013904223U;
    return state_ >> 16;
  }

 private:
  std::uint32_t state_;
};

std::string depth() {
  Sequence noise(1);
  std::string bytes;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      float value = 0.0f;
      if (x >= 8 && y >= 4)
        value = float(0.5 + ((x * x + y * y * 2) % 977) / 8192.0 + (noise.next() % 16) / 65536.0);
      char four[4];
      std::memcpy(four, &value, 4);
      bytes.append(four, 4);
    }
  }
  return bytes;
}

std::string confidence() {
  std::string bytes;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 192; ++x)
      bytes += char(y > 40 && y < 200 && x > 30 && x < 160 ? 2 : (x / 16 + y / 16) % 3);
  }
  return bytes;
}

std::string random_bytes(std::uint32_t seed, std::size_t count, std::uint32_t below) {
  Sequence sequence(seed);
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += char(sequence.next() % below);
  return bytes;
}

std::string repeated() {
  std::string bytes;
  for (int i = 0; i < 80; ++i) bytes += "turn the table, see the object; ";
  return bytes;
}

std::string words() {
  Sequence sequence(4);
  const char* const all[] = {"ab", "cde", "fghi", "jklmnopq",
                             "0123456789abcdefghijklmnopqrstuvwxyz"};
  std::string bytes;
  for (int i = 0; i < 400; ++i) bytes += all[sequence.next() % 5];
  return bytes.substr(0, 3500);
}

void expect_unpacks(std::string_view name, std::string_view kind, const std::string& truth) {
  const std::string packed = stream(name);
  EXPECT_EQ(packed.substr(0, 4), kind) << name;
  EXPECT_TRUE(looks_like_lzfse(packed));
  const auto bytes = decode(packed, truth.size());
  ASSERT_TRUE(bytes) << name << ": " << bytes.error().text();
  EXPECT_TRUE(*bytes == truth) << name;
}

TEST(Lzfse, UnpacksWhatTheReferenceEncoderPacked) {
  expect_unpacks("depth.lzfse", "bvx2", depth());
  expect_unpacks("confidence.lzfse", "bvx2", confidence());
  expect_unpacks("nibbles.lzfse", "bvx2", random_bytes(2, 60000, 13));  // two blocks
  expect_unpacks("text.lzfse", "bvxn", repeated());
  expect_unpacks("words.lzfse", "bvxn", words());
  expect_unpacks("random.lzfse", "bvx-", random_bytes(3, 3000, 256));
  expect_unpacks("few.lzfse", "bvx-", "abc");
  expect_unpacks("depth-bvx1.lzfse", "bvx1", depth());
}

TEST(Lzfse, GivesNoMoreThanTheCallerAllows) {
  for (const char* name : {"depth.lzfse", "text.lzfse", "random.lzfse"}) {
    const auto bytes = decode(stream(name), 2000);
    ASSERT_FALSE(bytes) << name;
    EXPECT_EQ(bytes.error().code, ErrorCode::kResourceLimit);
  }
}

TEST(Lzfse, RefusesEveryStreamThatIsCutOff) {
  for (const char* name : {"depth.lzfse", "words.lzfse", "few.lzfse", "depth-bvx1.lzfse"}) {
    const std::string packed = stream(name);
    const std::size_t step = packed.size() / 60 + 1;
    for (std::size_t size = 0; size < packed.size(); size += step) {
      const auto bytes = decode(packed.substr(0, size), 1 << 20);
      ASSERT_FALSE(bytes) << name << " " << size;
      EXPECT_EQ(bytes.error().code, ErrorCode::kFormat);
      EXPECT_THAT(bytes.error().message, HasSubstr("byte"));
    }
  }
}

TEST(Lzfse, FlippedBitsGiveAnErrorOrOtherBytesNeverMore) {
  for (const char* name : {"depth.lzfse", "words.lzfse", "depth-bvx1.lzfse"}) {
    const std::string packed = stream(name);
    for (std::size_t bit = 0; bit < packed.size() * 8; bit += packed.size() / 40 + 1) {
      std::string damaged = packed;
      damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << bit % 8));
      const auto bytes = decode(damaged, 1 << 16);
      if (bytes) {
        EXPECT_LE(bytes->size(), std::size_t(1) << 16);
      }
    }
  }
}

TEST(Lzfse, SizesThatABlockCannotHaveAreNotBelieved) {
  std::string packed = stream("text.lzfse");
  packed[7] = '\x7f';  // 2 GB from 60 bytes
  const auto bytes = decode(packed, std::size_t(1) << 40);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kFormat);
}

}  // namespace
}  // namespace turnscan::lzfse
