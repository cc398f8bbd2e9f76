#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> fields(std::string_view line) {
  const auto result = csv_fields(line);
  EXPECT_TRUE(result) << result.error().text();
  return result.value_or(std::vector<std::string>{});
}

TEST(LineReader, CountsLinesAndTellsWhetherTheLastOneIsEnded) {
  LineReader lines("a\r\n\nb");
  EXPECT_EQ(lines.next()->text, "a");
  EXPECT_EQ(lines.next()->text, "");
  const auto last = lines.next();
  EXPECT_EQ(last->text, "b");
  EXPECT_EQ(last->number, 3u);
  EXPECT_FALSE(last->ended);
  EXPECT_FALSE(lines.next());
}

TEST(LineReader, ContentSkipsCommentsAndBlankLines) {
  LineReader lines("# a comment\n\n  \t\n  # another\nx 1\n");
  const auto line = lines.next_content();
  EXPECT_EQ(line->text, "x 1");
  EXPECT_EQ(line->number, 5u);
  EXPECT_FALSE(lines.next_content());
}

TEST(CsvFields, AreTrimmedAndMayBeEmpty) {
  EXPECT_THAT(fields(" a , b,,"), ElementsAre("a", "b", "", ""));
  EXPECT_THAT(fields(""), ElementsAre(""));
}

TEST(CsvFields, QuotesHoldCommasAndQuotes) {
  EXPECT_THAT(fields("\"a,b\",\"say \"\"no\"\"\" ,c"), ElementsAre("a,b", "say \"no\"", "c"));
  EXPECT_FALSE(csv_fields("\"a"));
  EXPECT_FALSE(csv_fields("\"a\"b,c"));
  EXPECT_FALSE(csv_fields("a,\"\"\""));
}

TEST(CsvFields, LineOfCommasIsRefused) { EXPECT_FALSE(csv_fields(std::string(1000000, ','))); }

TEST(CsvFields, AFieldIsNoLongerThanAPath) {
  const std::string longest(4096, 'a');
  EXPECT_THAT(fields(longest + ",b"), ElementsAre(longest, "b"));
  EXPECT_THAT(fields('"' + longest + "\",b"), ElementsAre(longest, "b"));
  EXPECT_FALSE(csv_fields(longest + "a,b"));
  EXPECT_FALSE(csv_fields('"' + longest + "a\",b"));
}

TEST(ParseIndex, TakesDigitsUpToTheMaximum) {
  EXPECT_EQ(parse_index("000042", 100).value(), 42u);
  for (const char* bad : {"", "-1", "1.5", "101", "99999999999", "x", " 1", "0x1"})
    EXPECT_FALSE(parse_index(bad, 100)) << bad;
}

TEST(ParseNumbers, WantsExactlyAsManyFiniteNumbers) {
  EXPECT_THAT(parse_numbers(" 1.5e0\t2,3 ,\n-4 ", 4).value(), ElementsAre(1.5, 2, 3, -4));
  for (const char* bad :
       {"1 2 3", "1 2 3 4 5", "1 2 3 nan", "1 2 3 inf", "1 2 3 x", "1,,2,3,4", ""})
    EXPECT_FALSE(parse_numbers(bad, 4)) << bad;
}

TEST(CheckInside, RefusesWhatLeavesTheFolder) {
  for (const char* good : {"a.png", "depth/a.png", "a..b.png", "./a.png"})
    EXPECT_TRUE(check_inside(good)) << good;
  for (const char* bad : {"", "/a", "..", "../a", "a/..", "a/../../b"})
    EXPECT_FALSE(check_inside(bad)) << bad;
  EXPECT_FALSE(check_inside(std::string_view("a\0b", 3)));
}

}  // namespace
}  // namespace turnscan::text
