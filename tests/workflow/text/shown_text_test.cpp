#include <gtest/gtest.h>

#include <turnscan/workflow/text/shown_text.hpp>

namespace turnscan {
namespace {

TEST(ShownText, ControlCharactersAreEscapes) {
  EXPECT_EQ(shown_text("a\x1b[31mb\x7f\r\n\tc\xc2\x9b"), "a\\u001b[31mb\\u007f\\u000d\n\tc\\u009b");
  EXPECT_EQ(shown_text(std::string_view("a\0b", 3)), "a\\u0000b");
}

TEST(ShownText, OtherCharactersStay) {
  EXPECT_EQ(shown_text("d\xc3\xb6ner \xc2\xb5m \xe2\x82\xac \xc2"),
            "d\xc3\xb6ner \xc2\xb5m \xe2\x82\xac \xc2");
}

TEST(ShownText, ALineIsOneAndShort) {
  EXPECT_EQ(shown_line("a\nb"), "a\\u000ab");
  const std::string line = shown_line(std::string(100000, 'x'), 100);
  EXPECT_LT(line.size(), 110u);
  EXPECT_NE(line.find(" ... "), std::string::npos);
}

}  // namespace
}  // namespace turnscan
