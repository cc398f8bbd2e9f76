#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/mesh/srgb.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::text {
namespace {

double floating(std::string_view text) {
  TextCursor cursor(text);
  double value = 12345.0;
  return cursor.floating(value) ? value : 98765.0;
}

std::int64_t integer(std::string_view text) {
  TextCursor cursor(text);
  std::int64_t value = 0;
  return cursor.integer(value) ? value : 98765;
}

TEST(TextCursor, ReadsNumbersWithAPointInAnyLocale) {
  EXPECT_EQ(floating("1.5"), 1.5);
  EXPECT_EQ(floating(" \t\r-1.5e3 x"), -1500.0);
  EXPECT_EQ(floating("+0.25\n"), 0.25);
  EXPECT_TRUE(std::isnan(floating("nan")));
  EXPECT_EQ(floating("-inf"), -INFINITY);
}

TEST(TextCursor, NumbersThatDoNotFitAreZeroOrInfinite) {
  EXPECT_EQ(floating("1e-400"), 0.0);
  EXPECT_EQ(floating("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_TRUE(std::isinf(floating("-1e400")));
  EXPECT_TRUE(std::isinf(floating(std::string(400, '9'))));
  float value = 1.0F;
  EXPECT_TRUE(TextCursor("1e-60").floating(value));
  EXPECT_EQ(value, 0.0F);
}

TEST(TextCursor, TextThatRunsOnIsNoNumber) {
  for (const char* text : {"", "-", "+", "+-1", "++1", "1,5", "1.5x", "0x10", "e5"})
    EXPECT_EQ(floating(text), 98765.0) << text;
  for (const char* text : {"", "+-1", "1.5", "1,0", "1x", "99999999999999999999", "nan"})
    EXPECT_EQ(integer(text), 98765) << text;
}

TEST(TextCursor, IntegersMayBeWrittenAsNumbersWithAPoint) {
  EXPECT_EQ(integer("3.0"), 3);
  EXPECT_EQ(integer("-1e2"), -100);
  EXPECT_EQ(integer("+7"), 7);
  EXPECT_EQ(integer("4294967295"), 4294967295);
}

TEST(TextCursor, NumbersDoNotReachIntoTheNextLine) {
  TextCursor cursor("1 \n2");
  double value = 0.0;
  EXPECT_TRUE(cursor.floating(value));
  EXPECT_FALSE(cursor.floating(value));
  EXPECT_TRUE(cursor.at_line_end());
  cursor.skip_line();
  EXPECT_TRUE(cursor.floating(value));
  EXPECT_EQ(value, 2.0);
  EXPECT_TRUE(cursor.at_end());
  EXPECT_EQ(cursor.line_number(), 2U);
}

TEST(Srgb, EveryValueComesBackFromLinearLight) {
  for (int i = 0; i < 256; ++i) {
    const double linear = mesh_io::linear_from_srgb(static_cast<std::uint8_t>(i));
    EXPECT_EQ(mesh_io::srgb_from_linear(linear), i);
    EXPECT_EQ(mesh_io::srgb_from_linear(std::round(linear * 65535.0) / 65535.0), i);
  }
  EXPECT_EQ(mesh_io::srgb_from_linear(NAN), 0);
  EXPECT_EQ(mesh_io::srgb_from_linear(-1.0), 0);
  EXPECT_EQ(mesh_io::srgb_from_linear(7.0), 255);
  EXPECT_NEAR(mesh_io::linear_from_srgb(128), 0.2158605, 1e-6);
}

TEST(CleanName, KeepsTextAndReplacesWhatFormatsCannotHold) {
  EXPECT_EQ(file::clean_name("letter A <&>\""), "letter A <&>\"");
  EXPECT_EQ(file::clean_name("M\xc3\xbcnze \xe2\x82\xac \xf0\x9f\x90\xbb"),
            "M\xc3\xbcnze \xe2\x82\xac \xf0\x9f\x90\xbb");
  EXPECT_EQ(file::clean_name("a\nb\tc\x7f"), "a b c ");
  EXPECT_EQ(file::clean_name("\xff\xc3\xc0\x80\xed\xa0\x80\xf5"), "????????");
  EXPECT_EQ(file::clean_name("\xe2\x82"), "??");
  EXPECT_LE(file::clean_name(std::string(5000, 'x')).size(), 203U);
}

}  // namespace
}  // namespace turnscan::text
