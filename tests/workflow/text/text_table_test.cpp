#include <gtest/gtest.h>

#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {
namespace {

TEST(TextTable, AlignsItsColumns) {
  workflow::TextTable table({0});
  EXPECT_TRUE(table.empty());
  table.add({"name", "size"});
  table.add({"a", "1.5"});
  EXPECT_EQ(table.text(), "name  size\na      1.5\n");
  EXPECT_EQ(table.text(2), "  name  size\n  a      1.5\n");
}

TEST(TextTable, LeavesNoSpacesAtTheEnd) {
  workflow::TextTable table({0, 1});
  table.add({"a", "long"});
  table.add({"b", ""});
  EXPECT_EQ(table.text(), "a  long\nb\n");
}

}  // namespace
}  // namespace turnscan
