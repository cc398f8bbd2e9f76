#include <gtest/gtest.h>

#include <turnscan/capture/source/source_uri.hpp>

namespace turnscan {
namespace {

TEST(SourceUri, HasSchemeAddressAndParameters) {
  const auto uri = parse_source_uri("Virtual:doll?sensor=kinect-v2&seed=1&noise=gaussian:1.5mm");
  ASSERT_TRUE(uri);
  EXPECT_EQ(uri->scheme, "virtual");
  EXPECT_EQ(uri->address, "doll");
  ASSERT_EQ(uri->parameters.size(), 3u);
  EXPECT_EQ(uri->parameters[2].first, "noise");
  EXPECT_EQ(uri->parameters[2].second, "gaussian:1.5mm");
}

TEST(SourceUri, TheAddressMayBeEmptyAndMayHoldColonsAndSlashes) {
  EXPECT_EQ(parse_source_uri("openni2:")->address, "");
  EXPECT_EQ(parse_source_uri("replay:/a/b:c.d")->address, "/a/b:c.d");
  EXPECT_EQ(parse_source_uri("replay:a?")->address, "a");
}

TEST(SourceUri, BytesMayBeWrittenAsHexadecimalDigits) {
  const auto uri = parse_source_uri("replay:what%3f%20now?a=x%26y");
  ASSERT_TRUE(uri);
  EXPECT_EQ(uri->address, "what? now");
  EXPECT_EQ(uri->parameters[0].second, "x&y");
}

TEST(SourceUri, WhatIsWrittenIsReadBack) {
  SourceUri uri;
  uri.scheme = "replay";
  uri.address = "a?b%c&d=e";
  uri.parameters = {{"n&=", "v=%&?"}, {"e", ""}};
  const auto back = parse_source_uri(format_source_uri(uri));
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(back->address, uri.address);
  EXPECT_EQ(back->parameters, uri.parameters);
}

TEST(SourceUri, SaysInOneLineWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"doll", "no scheme"},
      {"", "no scheme"},
      {":doll", "no scheme"},
      {"vir tual:doll", "'vir tual' is no scheme"},
      {"virtual:doll?seed", "'seed' has no value"},
      {"virtual:doll?=1", "'=1' has no name"},
      {"virtual:doll?a=1&a=2", "'a' is given twice"},
      {"virtual:doll?a=1&", "behind the last '&'"},
      {"virtual:doll?a=1&&b=1", "'' has no value"},
      {"replay:a%2", "without two hexadecimal digits"},
      {"replay:a%zz", "without two hexadecimal digits"},
      {"replay:a%00", "byte 0"},
      {"replay:" + std::string(5000, 'a'), "5007 bytes long"}};
  for (const auto& [text, why] : cases) {
    const auto uri = parse_source_uri(text);
    ASSERT_FALSE(uri) << text;
    EXPECT_EQ(uri.error().code, ErrorCode::kInvalidOption);
    EXPECT_NE(uri.error().message.find(why), std::string::npos) << uri.error().message;
    EXPECT_EQ(uri.error().message.find('\n'), std::string::npos);
    EXPECT_LT(uri.error().message.size(), 400u);
  }
}

struct Options {
  int number = 1;
  bool flag = false;
};

OptionTable describe(Options& o) {
  OptionTable table;
  table.number("number", o.number, {0, 9}, "A number").flag("flag", o.flag, "A flag");
  return table;
}

TEST(SourceUri, SetsFieldsByNameAndFlagsAlsoByNumber) {
  Options options;
  ASSERT_TRUE(set_from_uri(*parse_source_uri("x:?number=3&flag=1"), describe(options)));
  EXPECT_EQ(options.number, 3);
  EXPECT_TRUE(options.flag);
  ASSERT_TRUE(set_from_uri(*parse_source_uri("x:?flag=false"), describe(options)));
  EXPECT_FALSE(options.flag);
}

TEST(SourceUri, NamesTheFieldThatIsUnknownOrOutOfRange) {
  Options options;
  const auto unknown = set_from_uri(*parse_source_uri("x:?nummber=3"), describe(options));
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("'number'"), std::string::npos);
  const auto outside = set_from_uri(*parse_source_uri("x:?number=10"), describe(options));
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().message, "x: number = 10 is outside 0 to 9");
}

}  // namespace
}  // namespace turnscan
