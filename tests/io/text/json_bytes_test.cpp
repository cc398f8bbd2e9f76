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

TEST(JsonBytes, ASyntaxErrorIsNamedWithLineAndColumn) {
  const auto json = parse_json("{\n  \"a\": 1\n  \"b\": 2\n}\n");
  ASSERT_FALSE(json);
  EXPECT_NE(json.error().message.find("not valid JSON: line 3, column 3: "), std::string::npos)
      << json.error().message;
  EXPECT_NE(json.error().message.find("expected"), std::string::npos) << json.error().message;
  EXPECT_EQ(json.error().message.find("; "), std::string::npos) << json.error().message;
}

TEST(JsonBytes, ALineAndAColumnCountCharacters) {
  const std::string text = "a\n\xC3\xA4\xC3\xB6x";
  EXPECT_EQ(line_and_column(text, 0), "line 1, column 1");
  EXPECT_EQ(line_and_column(text, text.size() - 1), "line 2, column 3");
}

TEST(JsonBytes, APathLeadsToItsValue) {
  const std::string text =
      "{\"a\": {\"b\": [1, {\"c\" : \"],}\"}, 7]},\n \"d\": [[2, 3], []], \"a2\": 0}";
  const auto at = [&](const char* path) { return text.substr(json_offset(text, path), 3); };
  EXPECT_EQ(at(""), "{\"a");
  EXPECT_EQ(at("a.b"), "[1,");
  EXPECT_EQ(at("a.b[1].c"), "\"],");
  EXPECT_EQ(at("a.b[2]"), "7]}");
  EXPECT_EQ(at("d[0][1]"), "3],");
  EXPECT_EQ(at("a2"), "0}");
  // What is not there: where it would be.
  EXPECT_EQ(at("a.x"), "{\"b");
  EXPECT_EQ(at("d[1][4]"), "[]]");
  EXPECT_EQ(at("d.x"), "[[2");
}

TEST(JsonBytes, OfAKeyThatIsThereTwiceTheLastOneCounts) {
  const std::string text = "{\"a\": 1, \"a\": 2}";
  EXPECT_EQ(text[json_offset(text, "a")], '2');
}

TEST(JsonObject, NamesLineAndColumnOfAWrongField) {
  const std::string text = "{\n \"camera\": {\n  \"fx\": \"wide\"}}";
  const auto json = parse_json(text);
  ASSERT_TRUE(json);
  const auto root = JsonObject::from(*json, text);
  ASSERT_TRUE(root);
  const auto camera = root->object("camera");
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->number("fx").error().message, "line 3, column 9: camera.fx is not a number");
  EXPECT_EQ(camera->number("fy").error().message, "line 2, column 12: camera.fy is missing");
}

TEST(JsonBytes, ParsingEndsWhenCancelled) {
  RunContext context;
  context.cancel();
  const auto json = parse_json("{}", context);
  ASSERT_FALSE(json);
  EXPECT_EQ(json.error().code, ErrorCode::kCancelled);
}

TEST(JsonBytes, ValuesThatTakeFarMoreMemoryThanTheirTextAreRefused) {
  // A member takes a hundred bytes and more, however short its name.
  std::string members = "[0";
  for (int i = 0; i < 700000; ++i) members += ",{\"a\":1}";
  const auto refused = parse_json(members + "]");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kResourceLimit);
  // So does a text.
  std::string texts = "[0";
  for (int i = 0; i < 3000000; ++i) texts += ",\"\"";
  EXPECT_FALSE(parse_json(texts + "]"));
  std::string numbers = "[0";
  for (int i = 0; i < 3000000; ++i) numbers += ",1";
  EXPECT_TRUE(parse_json(numbers + "]"));
  // As a part of a small file it is out of proportion, too.
  EXPECT_FALSE(parse_json(numbers + "]", file::ReadBudget(1000)));
}

TEST(ForEachJsonMember, TakesThemInTheOrderOfTheFile) {
  std::string taken;
  const auto take = [&](const std::string& name, const Json& value) -> Result<> {
    taken += name + value.dump() + ' ';
    if (name == "bad") return fail(ErrorCode::kFormat, "bad");
    return {};
  };
  EXPECT_TRUE(for_each_json_member("{}", {}, take));
  EXPECT_EQ(taken, "");
  EXPECT_TRUE(for_each_json_member(R"({"b": {"x": {"y": 1}, "z": [[2]]}, "a": [3, {}], "c": null,
                                       "b": "again"})",
                                   {}, take));
  EXPECT_EQ(taken, R"(b{"x":{"y":1},"z":[[2]]} a[3,{}] cnull b"again" )");
  taken.clear();
  EXPECT_EQ(for_each_json_member(R"({"a": 1, "bad": 2, "c": 3})", {}, take).error().message, "bad");
  EXPECT_EQ(taken, "a1 bad2 ");
}

TEST(ForEachJsonMember, NeedsAnObject) {
  const auto none = [](const std::string&, const Json&) -> Result<> { return {}; };
  for (const char* text : {"[1, {\"a\": 2}]", "1", "", "{\"a\": 1", "{\"a\": 1} x"})
    EXPECT_EQ(for_each_json_member(text, {}, none).error().code, ErrorCode::kFormat) << text;
  RunContext context;
  context.cancel();
  EXPECT_EQ(for_each_json_member("{}", context, none).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::text
