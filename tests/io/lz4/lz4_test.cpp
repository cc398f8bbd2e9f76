// Frames and blocks are packed by liblz4; the wrapping of Apple's blocks is written here after its
// description.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4.h>
#include <lz4frame.h>

#include <turnscan/io/lz4/lz4.hpp>

namespace turnscan::lz4 {
namespace {

using ::testing::HasSubstr;

std::string text(std::size_t size) {
  std::string out;
  for (std::size_t i = 0; out.size() < size; ++i) out += std::to_string(i * i % 977) + " depth ";
  out.resize(size);
  return out;
}

std::string frame(const std::string& bytes) {
  std::string out(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  return out;
}

std::string number(std::size_t value) {
  std::string out;
  for (int i = 0; i < 4; ++i) out += char(value >> (8 * i) & 0xff);
  return out;
}

/// Blocks that refer to those before them, as a stream of liblz4 makes them.
std::string apple(const std::string& bytes, std::size_t block) {
  LZ4_stream_t* stream = LZ4_createStream();
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    const std::size_t raw = std::min(block, bytes.size() - at);
    std::string packed(std::size_t(LZ4_compressBound(int(raw))), '\0');
    packed.resize(std::size_t(LZ4_compress_fast_continue(stream, bytes.data() + at, packed.data(),
                                                         int(raw), int(packed.size()), 1)));
    out += "bv41" + number(raw) + number(packed.size()) + packed;
  }
  LZ4_freeStream(stream);
  return out + "bv4$";
}

std::string message(const Result<std::string>& result) {
  EXPECT_FALSE(result);
  return result ? "" : result.error().message;
}

TEST(Lz4, UnpacksFramesAndApplesBlocks) {
  for (const std::size_t size : {0u, 1u, 1000u, 200000u}) {
    const std::string bytes = text(size);
    EXPECT_EQ(*decode(frame(bytes), size), bytes) << size;
    EXPECT_EQ(*decode(apple(bytes, 70000), size), bytes) << size;
    EXPECT_EQ(*decode(apple(bytes, 4096) + "what follows", size), bytes) << size;
  }
  EXPECT_LT(apple(text(200000), 4096).size(), 100000u) << "blocks refer to those before";
}

TEST(Lz4, TakesStoredBlocksAmongPackedOnes) {
  const std::string packed = apple(text(500), 500);
  const std::string both =
      packed.substr(0, packed.size() - 4) + "bv4-" + number(3) + "abc" + "bv4$";
  EXPECT_EQ(*decode(both, 1000), text(500) + "abc");
}

TEST(Lz4, IsToldByItsFirstBytes) {
  EXPECT_TRUE(looks_like_lz4(frame("a")));
  EXPECT_TRUE(looks_like_lz4(apple("a", 1)));
  EXPECT_TRUE(looks_like_lz4("bv4$"));
  for (const char* other : {"", "bv4", "bvx2", "bv42", "abcd"}) EXPECT_FALSE(looks_like_lz4(other));
  EXPECT_THAT(message(decode("abcd", 100)), HasSubstr("does not begin"));
}

TEST(Lz4, RefusesWhatIsCutOffDamagedOrTooLong) {
  const std::string bytes = text(3000);
  for (const std::string& whole : {frame(bytes), apple(bytes, 1000)}) {
    for (std::size_t size = 4; size < whole.size(); size += 37)
      EXPECT_FALSE(decode(std::string_view(whole).substr(0, size), 3000)) << size;
    const auto longer = decode(whole, 2999);
    ASSERT_FALSE(longer);
    EXPECT_EQ(longer.error().code, ErrorCode::kResourceLimit);
  }
  EXPECT_THAT(message(decode("bv41" + number(1u << 30) + number(2) + "ab", std::size_t(1) << 31)),
              HasSubstr("damaged"));
  EXPECT_THAT(message(decode("bv41" + number(10) + number(9) + "ab", 100)), HasSubstr("too early"));
  EXPECT_THAT(message(decode("bv4-" + number(9) + "ab", 100)), HasSubstr("too early"));
  EXPECT_THAT(message(decode("bv4-" + number(2) + "abbv4?", 100)), HasSubstr("no block"));
  // A match that goes back farther than there is anything: token 0x10, one literal, distance 9.
  EXPECT_THAT(
      message(decode("bv41" + number(20) + number(4) + std::string("\x10z\x09\x00", 4), 100)),
      HasSubstr("damaged"));
}

}  // namespace
}  // namespace turnscan::lz4
