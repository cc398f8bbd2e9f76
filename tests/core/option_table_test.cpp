#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <turnscan/core/option_table.hpp>

namespace turnscan {
namespace {

enum class Method { kCentroid, kSubvoxel };

struct Options {
  bool colour = false;
  double size = 0.0015;
  double lambda = 1.0;
  int count = 10;
  std::optional<double> radius;
  std::optional<int> limit;
  std::string name = "scan";
  Method method = Method::kCentroid;
};

OptionTable describe(Options& o) {
  OptionTable t;
  t.flag("colour", o.colour, "Carry colour along.")
      .number("size", o.size, Quantity::kLength, {1e-4, 0.1}, "Size of a voxel.")
      .number("lambda", o.lambda, Quantity::kNone, {0.0, 10.0}, "Width in standard deviations.")
      .number("count", o.count, {1, 100}, "How many.")
      .number("radius", o.radius, Quantity::kLength, {0.0, 1.0}, "Radius.")
      .number("limit", o.limit, {0, 1000}, "Limit.")
      .text("name", o.name, "Name.")
      .choice("method", o.method, {"centroid", "sub-voxel"}, "Method.");
  return t;
}

std::string refusal(const OptionTable& table, std::string_view name, std::string_view value) {
  const Result<> r = table.set(name, value);
  EXPECT_FALSE(r) << name << " took " << value;
  if (r) return "";
  EXPECT_EQ(r.error().code, ErrorCode::kInvalidOption);
  return r.error().message;
}

TEST(OptionTable, SetsEveryKindOfField) {
  Options o;
  const OptionTable t = describe(o);
  EXPECT_TRUE(t.set("colour", "true"));
  EXPECT_TRUE(t.set("size", "2mm"));
  EXPECT_TRUE(t.set("lambda", "2.5"));
  EXPECT_TRUE(t.set("count", "12"));
  EXPECT_TRUE(t.set("radius", "3mm"));
  EXPECT_TRUE(t.set("limit", "7"));
  EXPECT_TRUE(t.set("name", "two words"));
  EXPECT_TRUE(t.set("method", "sub-voxel"));
  EXPECT_TRUE(o.colour);
  EXPECT_EQ(o.size, 0.002);
  EXPECT_EQ(o.lambda, 2.5);
  EXPECT_EQ(o.count, 12);
  EXPECT_EQ(o.radius, 0.003);
  EXPECT_EQ(o.limit, 7);
  EXPECT_EQ(o.name, "two words");
  EXPECT_EQ(o.method, Method::kSubvoxel);
}

TEST(OptionTable, AutoEmptiesAnOptionalField) {
  Options o;
  o.radius = 0.5;
  o.limit = 5;
  const OptionTable t = describe(o);
  EXPECT_TRUE(t.set("radius", "auto"));
  EXPECT_TRUE(t.set("limit", "auto"));
  EXPECT_FALSE(o.radius);
  EXPECT_FALSE(o.limit);
  EXPECT_TRUE(t.check()) << "auto is in every range";
  refusal(t, "size", "auto");
}

TEST(OptionTable, EveryFieldTakesItsOwnTextBack) {
  Options o;
  o.radius = 0.25;
  const OptionTable t = describe(o);
  for (const OptionField& field : t.fields()) {
    const std::string text = field.get();
    EXPECT_TRUE(field.set(text)) << field.name << " = " << text;
    EXPECT_EQ(field.get(), text) << field.name;
  }
}

TEST(OptionTable, DescribesItsFields) {
  Options o;
  const OptionTable t = describe(o);
  ASSERT_EQ(t.fields().size(), 8u);
  const OptionField& size = *t.find("size");
  EXPECT_EQ(size.quantity, Quantity::kLength);
  EXPECT_EQ(size.help, "Size of a voxel.");
  EXPECT_EQ(size.range->min, 1e-4);
  EXPECT_EQ(size.range->max, 0.1);
  EXPECT_FALSE(size.may_be_auto);
  EXPECT_EQ(size.get(), "1.5mm");
  EXPECT_TRUE(t.find("colour")->is_flag);
  EXPECT_TRUE(t.find("radius")->may_be_auto);
  EXPECT_EQ(t.find("radius")->get(), "auto");
  EXPECT_EQ(t.find("method")->choices, (std::vector<std::string>{"centroid", "sub-voxel"}));
  EXPECT_EQ(t.find("method")->get(), "centroid");
  EXPECT_EQ(t.find("nothing"), nullptr);
}

TEST(OptionTable, AValueOutsideTheRangeIsNamedWithFieldAndRange) {
  Options o;
  const OptionTable t = describe(o);
  EXPECT_EQ(refusal(t, "size", "1m"), "size = 1000mm is outside 0.1mm to 100mm");
  EXPECT_EQ(refusal(t, "count", "0"), "count = 0 is outside 1 to 100");
  EXPECT_EQ(o.size, 0.0015) << "a refused value changes nothing";
  EXPECT_EQ(o.count, 10);
}

TEST(OptionTable, LimitsAreAllowedThemselves) {
  Options o;
  const OptionTable t = describe(o);
  EXPECT_TRUE(t.set("count", "1"));
  EXPECT_TRUE(t.set("count", "100"));
  EXPECT_TRUE(t.set("lambda", "0"));
}

TEST(OptionTable, BadTextIsNamedWithItsField) {
  Options o;
  const OptionTable t = describe(o);
  EXPECT_EQ(refusal(t, "size", "2"), "size: '2' lacks a unit; write one of m, mm, cm, um, in");
  EXPECT_EQ(refusal(t, "colour", "yes"), "colour = yes is neither true nor false");
  EXPECT_EQ(refusal(t, "count", "1.5"), "count = 1.5 is not a whole number");
  EXPECT_EQ(refusal(t, "method", "mean"), "method = mean is not one of centroid, sub-voxel");
  EXPECT_NE(refusal(t, "lambda", "nan").find("lambda"), std::string::npos);
  EXPECT_NE(refusal(t, "radius", "many").find("radius"), std::string::npos);
  EXPECT_NE(refusal(t, "limit", "2000").find("limit"), std::string::npos);
}

TEST(OptionTable, AnUnknownNameIsAnsweredWithTheNearest) {
  Options o;
  EXPECT_EQ(refusal(describe(o), "radus", "1mm"),
            "there is no option 'radus'; did you mean 'radius'");
  EXPECT_EQ(refusal(OptionTable(), "radius", "1mm"), "there is no option 'radius'");
}

template <class Change>
std::string first_failure(const Change& change) {
  Options o;
  change(o);
  const Result<> r = describe(o).check();
  return r ? "" : r.error().message;
}

TEST(OptionTable, CheckNamesTheFieldTheValueAndTheRange) {
  EXPECT_EQ(first_failure([](Options&) {}), "");
  EXPECT_EQ(first_failure([](Options& o) { o.count = 101; }), "count = 101 is outside 1 to 100");
  EXPECT_EQ(first_failure([](Options& o) { o.limit = -1; }), "limit = -1 is outside 0 to 1000");
  EXPECT_EQ(first_failure([](Options& o) { o.radius = 2.0; }),
            "radius = 2000mm is outside 0mm to 1000mm");
  EXPECT_EQ(first_failure([](Options& o) { o.method = static_cast<Method>(5); }),
            "method = 5 is not one of centroid, sub-voxel");
}

TEST(OptionTable, CheckRefusesNan) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(first_failure([=](Options& o) { o.size = nan; }), "");
  EXPECT_NE(first_failure([=](Options& o) { o.lambda = nan; }), "");
  EXPECT_NE(first_failure([=](Options& o) { o.radius = nan; }), "");
}

TEST(OptionTable, AppendPutsThePrefixBeforeEachName) {
  Options a, b;
  OptionTable t = describe(a);
  t.append(describe(b), "second-");
  EXPECT_TRUE(t.set("second-count", "3"));
  EXPECT_EQ(a.count, 10);
  EXPECT_EQ(b.count, 3);
}

TEST(OptionTable, TwoFieldsOfOneNameAreABrokenPrecondition) {
  Options a, b;
  OptionTable t = describe(a);
  EXPECT_THROW(t.append(describe(b)), std::invalid_argument);
  EXPECT_THROW(t.flag("size", b.colour, "Again."), std::invalid_argument);
}

TEST(OptionTable, AWholeNumberBeyondIntIsRefusedWhateverTheRange) {
  int value = 1;
  OptionTable t;
  t.number("n", value, {0.0, 1e18}, "N.");
  refusal(t, "n", "1e12");
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace turnscan
