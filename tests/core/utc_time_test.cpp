#include <gtest/gtest.h>

#include <turnscan/core/utc_time.hpp>

namespace turnscan {
namespace {

TEST(UtcTime, WritesDatesAsOtherProgramsDo) {
  // As date -u -d @SECONDS has them.
  EXPECT_EQ(utc_text(0), "1970-01-01T00:00:00Z");
  EXPECT_EQ(utc_text(1709164799), "2024-02-28T23:59:59Z");
  EXPECT_EQ(utc_text(1709164800), "2024-02-29T00:00:00Z");
  EXPECT_EQ(utc_text(-1), "1969-12-31T23:59:59Z");
}

TEST(UtcTime, ReadsWhatItWrites) {
  for (const std::int64_t s : {-62167219200LL, -1LL, 0LL, 951782400LL, 1790000000LL})
    EXPECT_EQ(utc_seconds(utc_text(s)), s) << utc_text(s);
  EXPECT_EQ(utc_seconds("2024-02-29T00:00:00.125Z"), 1709164800);
}

TEST(UtcTime, KnowsNoDateThatThereIsNot) {
  for (const char* bad :
       {"", "2023-02-29T00:00:00Z", "2024-13-01T00:00:00Z", "2024-00-01T00:00:00Z",
        "2024-01-01T24:00:00Z", "2024-01-01T00:60:00Z", "2024-01-01 00:00:00Z",
        "2024-01-01T00:00:00", "2024-01-01T00:00:00+01:00", "2024-01-01T00:00:00.Z",
        "2024-1-01T00:00:000Z", "-024-01-01T00:00:00Z", "2024-01-01T00:00:00.1xZ"})
    EXPECT_EQ(utc_seconds(bad), std::nullopt) << bad;
}

TEST(UtcTime, SaysHowLongInTheUnitThatFits) {
  EXPECT_EQ(duration_text(0.0), "0 seconds");
  EXPECT_EQ(duration_text(1.0), "1 second");
  EXPECT_EQ(duration_text(100.0), "2 minutes");
  EXPECT_EQ(duration_text(86400.0), "24 hours");
  EXPECT_EQ(duration_text(3.2 * 86400.0), "3 days");
  EXPECT_EQ(duration_text(100.0 * 86400.0), "3 months");
  EXPECT_EQ(duration_text(800.0 * 86400.0), "2 years");
}

}  // namespace
}  // namespace turnscan
