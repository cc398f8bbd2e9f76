#include <gtest/gtest.h>

#include <turnscan/io/file/sha256.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::file {
namespace {

std::string hash_of(std::string_view text, std::size_t piece) {
  Sha256 sum;
  for (std::size_t at = 0; at < text.size(); at += piece) sum.add(text.substr(at, piece));
  return hex_of(sum.finish());
}

// FIPS 180-4's examples, as NIST publishes them.
TEST(Sha256, GivesTheDigestsOfTheStandard) {
  EXPECT_EQ(hash_of("", 1), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash_of("abc", 3), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 56),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash_of(std::string(1000000, 'a'), 1000000),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnHowTheBytesAreCut) {
  for (std::size_t length : {0, 1, 55, 56, 57, 63, 64, 65, 119, 120, 128, 200}) {
    const std::string text(length, 'x');
    const std::string whole = hash_of(text, length + 1);
    for (std::size_t piece : {1, 3, 63, 64, 65}) EXPECT_EQ(hash_of(text, piece), whole) << length;
  }
}

TEST(Sha256, OfAFileIsThatOfItsContent) {
  const testing::TempFolder folder;
  testing::write_file(folder / "a", "abc");
  EXPECT_EQ(*sha256_of_file(folder / "a"), hash_of("abc", 3));
  EXPECT_EQ(sha256_of_file(folder / "none").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(sha256_of_file(folder.path()).error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace turnscan::file
