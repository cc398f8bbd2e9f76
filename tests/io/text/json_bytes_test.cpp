#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <turnscan/io/text/json_bytes.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::text {
namespace {

std::string nested(int depth) {
  return std::string(std::size_t(depth), '[') + std::string(std::size_t(depth), ']');
}

TEST(JsonBytes, NestingIsBoundedBeforeParsing) {
  EXPECT_TRUE(parse_json(nested(kMaxJsonDepth)));
  for (const int depth : {kMaxJsonDepth + 1, 1000000}) {
    const auto json = parse_json("\n" + nested(depth));
    ASSERT_FALSE(json);
    EXPECT_EQ(json.error().code, ErrorCode::kFormat);
    EXPECT_NE(json.error().message.find("line 2"), std::string::npos);
  }
}

TEST(JsonBytes, BracketsWithinTextsDoNotNest) {
  EXPECT_TRUE(parse_json("{\"a\": \"" + std::string(1000, '[') + "\\\"{\"}"));
}

TEST(JsonBytes, NothingFollowsAZeroByte) {
  using namespace std::string_literals;
  for (const std::string& text : {"{}\0\0"s, "{}\0{\"a\": 1}"s, "{\0}"s}) {
    const auto json = parse_json(text);
    ASSERT_FALSE(json);
    EXPECT_EQ(json.error().code, ErrorCode::kFormat);
  }
  EXPECT_TRUE(parse_json("{\"a\": \"\\u0000\"}"));
}

TEST(JsonBytes, AMemberIsSetAndAllElseStays) {
  EXPECT_EQ(with_json_member("{\"a\": 1,\n \"b\" : false }\n", "b", "true"),
            "{\"a\": 1,\n \"b\" : true }\n");
  EXPECT_EQ(with_json_member("{ }", "b", "3"), "{\n  \"b\": 3 }");
  EXPECT_EQ(with_json_member("{\"a\": {\"b\": 1}, \"c\": \"b\"}", "b", "3"),
            "{\"a\": {\"b\": 1}, \"c\": \"b\",\n  \"b\": 3}");
  EXPECT_EQ(with_json_member("{\"b\": [1, {\"b\": 2}], \"b\":\"}\\\",\"}", "b", "0"),
            "{\"b\": [1, {\"b\": 2}], \"b\":0}");
}

}  // namespace
}  // namespace turnscan::text
