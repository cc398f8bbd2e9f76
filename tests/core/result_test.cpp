#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <turnscan/core/result.hpp>
#include <turnscan/core/version.hpp>

namespace turnscan {
namespace {

Result<> refuse() { return fail(ErrorCode::kIo, "disk {} is full", 7); }

TEST(Result, FailFormatsItsMessage) {
  const Result<> r = refuse();
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, ErrorCode::kIo);
  EXPECT_EQ(r.error().message, "disk 7 is full");
  EXPECT_EQ(r.error().path, "");
}

TEST(Result, TextPutsThePathFirst) {
  const Result<> r = fail_at("scan/a.ply", ErrorCode::kFormat, "no header");
  EXPECT_EQ(r.error().text(), "scan/a.ply: no header");
}

TEST(Result, TextDoesNotRepeatAPathThatTheMessageNames) {
  const Result<> r = fail_at("a.ply", ErrorCode::kFormat, "a.ply: no header");
  EXPECT_EQ(r.error().text(), "a.ply: no header");
}

TEST(Result, TextWithoutPathIsTheMessage) { EXPECT_EQ(refuse().error().text(), "disk 7 is full"); }

Result<int> try_then_one(bool failing) {
  TURNSCAN_TRY(failing ? refuse() : Result<>());
  return 1;
}

TEST(Result, TryReturnsTheErrorFromTheEnclosingFunction) {
  EXPECT_EQ(try_then_one(false).value(), 1);
  ASSERT_FALSE(try_then_one(true));
  EXPECT_EQ(try_then_one(true).error().message, "disk 7 is full");
}

Result<std::unique_ptr<int>> boxed(int value) {
  if (value < 0) return fail(ErrorCode::kInvalidOption, "negative");
  return std::make_unique<int>(value);
}

Result<int> sum_of_boxed(int a, int b) {
  TURNSCAN_ASSIGN(const auto x, boxed(a));
  TURNSCAN_ASSIGN(const auto y, boxed(b));
  return *x + *y;
}

TEST(Result, AssignMovesTheValueOutOrReturnsTheError) {
  EXPECT_EQ(sum_of_boxed(2, 3).value(), 5);
  EXPECT_EQ(sum_of_boxed(2, -3).error().message, "negative");
}

TEST(Result, EveryCodeHasANameOfItsOwn) {
  std::set<std::string_view> names;
  const int last = static_cast<int>(ErrorCode::kLibrary);
  for (int i = 0; i <= last; ++i) names.insert(name_of(static_cast<ErrorCode>(i)));
  EXPECT_EQ(names.size(), std::size_t(last) + 1);
  EXPECT_EQ(names.count("unknown"), 0u);
}

TEST(Version, HasThreeNumbers) {
  int dots = 0;
  for (const char c : std::string_view(version())) {
    dots += c == '.';
    EXPECT_TRUE(c == '.' || (c >= '0' && c <= '9'));
  }
  EXPECT_EQ(dots, 2);
}

}  // namespace
}  // namespace turnscan
