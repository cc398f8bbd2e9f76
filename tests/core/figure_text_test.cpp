#include <turnscan/core/figure_text.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace turnscan {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(FigureText, HasAsManyDecimalsAsAreKnown) {
  EXPECT_EQ(figure_text(12.3, 2, "mm"), "12.30 mm");
  EXPECT_EQ(figure_text(-0.04, 1, "deg"), "-0.0 deg");
}

TEST(FigureText, OfWhatIsNoNumberIsNotKnown) {
  EXPECT_EQ(figure_text(kNan, 2, "mm"), "not known");
  EXPECT_EQ(figure_text(-std::numeric_limits<double>::infinity(), 2, "mm"), "not known");
}

TEST(LengthText, IsNoFinerThanAHundredthOfAMillimetreOrAThousandthBelowOne) {
  EXPECT_EQ(length_text(0.123456789), "123.46mm");
  EXPECT_EQ(length_text(0.015), "15mm");
  EXPECT_EQ(length_text(-0.0000137985), "-0.014mm");
  EXPECT_EQ(length_text(-1e-9), "0mm");
}

TEST(LengthText, OfWhatIsNoNumberIsNotKnown) { EXPECT_EQ(length_text(kNan), "not known"); }

}  // namespace
}  // namespace turnscan
