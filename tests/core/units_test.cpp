#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <ostream>
#include <turnscan/core/units.hpp>

namespace turnscan {
namespace {

constexpr double kPi = std::numbers::pi;

struct Reading {
  std::string text;
  Quantity quantity;
  double si;
};
void PrintTo(const Reading& reading, std::ostream* out) { *out << reading.text; }

class UnitsOfAQuantity : public testing::TestWithParam<Reading> {};

TEST_P(UnitsOfAQuantity, AreReadInSi) {
  const Reading& r = GetParam();
  const Result<double> value = parse_quantity(r.text, r.quantity);
  ASSERT_TRUE(value) << value.error().message;
  EXPECT_NEAR(*value, r.si, 1e-12 * std::abs(r.si));
}

INSTANTIATE_TEST_SUITE_P(
    Every, UnitsOfAQuantity,
    testing::Values(
        Reading{"1.5mm", Quantity::kLength, 0.0015}, Reading{"1.5 mm", Quantity::kLength, 0.0015},
        Reading{" 2cm ", Quantity::kLength, 0.02}, Reading{"3m", Quantity::kLength, 3.0},
        Reading{"40um", Quantity::kLength, 40e-6}, Reading{"2in", Quantity::kLength, 0.0508},
        Reading{"-1e-3m", Quantity::kLength, -0.001}, Reading{"+5mm", Quantity::kLength, 0.005},
        Reading{"0", Quantity::kLength, 0.0}, Reading{"180deg", Quantity::kAngle, kPi},
        Reading{"0.5rad", Quantity::kAngle, 0.5}, Reading{"250ms", Quantity::kTime, 0.25},
        Reading{"2s", Quantity::kTime, 2.0}, Reading{"1.5min", Quantity::kTime, 90.0},
        Reading{"10.4478deg/s", Quantity::kAngularSpeed, 10.4478 * kPi / 180.0},
        Reading{"-2rad/s", Quantity::kAngularSpeed, -2.0},
        Reading{"1rpm", Quantity::kAngularSpeed, 2.0 * kPi / 60.0},
        Reading{"2.5", Quantity::kNone, 2.5}));

class BadQuantity : public testing::TestWithParam<const char*> {};

TEST_P(BadQuantity, IsRefusedAsALength) {
  const Result<double> value = parse_quantity(GetParam(), Quantity::kLength);
  ASSERT_FALSE(value) << *value;
  EXPECT_EQ(value.error().code, ErrorCode::kInvalidOption);
  EXPECT_NE(value.error().message.find("mm"), std::string::npos) << value.error().message;
}

INSTANTIATE_TEST_SUITE_P(Each, BadQuantity,
                         testing::Values("", " ", "mm", "1.5", "1.5kg", "1.5deg", "1,5mm", "nanmm",
                                         "nan", "infmm", "-inf mm", "1e999mm", "1.5mm2",
                                         "1.5 mm mm", "+-1mm", "++1mm", "0x10mm", "1.5MM"));

TEST(ParseQuantity, AMissingUnitIsNamedAsSuch) {
  EXPECT_EQ(parse_quantity("1.5", Quantity::kAngle).error().message,
            "'1.5' lacks a unit; write one of rad, deg");
}

TEST(ParseQuantity, AnUnknownUnitIsNamed) {
  EXPECT_EQ(parse_quantity("3h", Quantity::kTime).error().message,
            "'3h' has the unknown unit 'h'; write one of s, ms, min");
}

class BadNumber : public testing::TestWithParam<const char*> {};

TEST_P(BadNumber, IsRefused) { EXPECT_FALSE(parse_number(GetParam())) << GetParam(); }

INSTANTIATE_TEST_SUITE_P(Each, BadNumber,
                         testing::Values("", " ", "+", "-", "+-1", "++1", "1,5", "1.5x", "nan",
                                         "inf", "-inf", "1e999", "0x1p3", "1 2"));

TEST(ParseNumber, ReadsPlainNumbers) {
  EXPECT_EQ(parse_number("12").value(), 12.0);
  EXPECT_EQ(parse_number(" -1.25e2\n").value(), -125.0);
  EXPECT_EQ(parse_number("+.5").value(), 0.5);
}

// Every quantity's text must be what the parser reads, to the six digits that it shows.
TEST(FormatQuantity, ReadsBackAsTheSameValue) {
  for (const Quantity q : {Quantity::kNone, Quantity::kLength, Quantity::kAngle, Quantity::kTime,
                           Quantity::kAngularSpeed}) {
    for (const double value : {0.0, 1.0, -0.001667, 123456.0, 1e-9, 3.0e7}) {
      const std::string text = format_quantity(value, q);
      const Result<double> back = parse_quantity(text, q);
      ASSERT_TRUE(back) << text;
      EXPECT_NEAR(*back, value, 1e-5 * std::abs(value)) << text;
    }
  }
}

TEST(FormatQuantity, UsesTheUnitsOfPeople) {
  EXPECT_EQ(format_quantity(0.0015, Quantity::kLength), "1.5mm");
  EXPECT_EQ(format_quantity(kPi / 2, Quantity::kAngle), "90deg");
  EXPECT_EQ(format_quantity(0.25, Quantity::kTime), "0.25s");
  EXPECT_EQ(format_quantity(kPi, Quantity::kAngularSpeed), "180deg/s");
  EXPECT_EQ(format_quantity(2.5, Quantity::kNone), "2.5");
  EXPECT_EQ(format_quantity(256e6, Quantity::kNone), "256000000");
  EXPECT_EQ(format_quantity(1e15, Quantity::kNone), "1e+15");
}

TEST(MetresPer, KnowsLengthsAndNothingElse) {
  EXPECT_EQ(metres_per("mm").value(), 0.001);
  EXPECT_EQ(metres_per("m").value(), 1.0);
  EXPECT_FALSE(metres_per("deg"));
  EXPECT_FALSE(metres_per(""));
}

TEST(Units, IgnoreTheDecimalCommaOfTheLocale) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "%.1f", 1.5);
  if (std::string_view(text.data()) != "1,5") GTEST_SKIP() << "the locale has no decimal comma";
  EXPECT_EQ(parse_quantity("1.5mm", Quantity::kLength).value(), 0.0015);
  EXPECT_FALSE(parse_number("1,5"));
  EXPECT_EQ(format_quantity(0.0015, Quantity::kLength), "1.5mm");
  EXPECT_EQ(format_quantity(123456.0, Quantity::kNone), "123456");
}

}  // namespace
}  // namespace turnscan
