#include "harness/base/table.h"

#include <gtest/gtest.h>

namespace {

using touchstone::base::Table;

TEST(Table, AlignsTheFirstColumnLeftAndTheOthersRight) {
  Table table({"", "a", "bb"});
  table.add({"row", "1.5", "2"});
  EXPECT_EQ(table.text(80),
            "       a  bb\n"
            "------------\n"
            "row  1.5   2\n");
}

TEST(Table, IsCutWhereThePageEnds) {
  Table table({"", "aaaa", "bbbb"});
  table.add({"r", "1", "2"});
  EXPECT_EQ(table.text(8),
            "   aaaa\n"
            "-------\n"
            "r     1\n"
            "\n"
            "   bbbb\n"
            "-------\n"
            "r     2\n");
}

TEST(Table, IsAlignedAndEscapedInMarkdown) {
  Table table({"a", "b", "c"}, 2);
  EXPECT_TRUE(table.is_empty());
  table.add({"x|y", "", "1"});
  EXPECT_FALSE(table.is_empty());
  EXPECT_EQ(table.markdown(),
            "| a | b | c |\n"
            "|---|---|---:|\n"
            "| x\\|y |  | 1 |\n");
}

}  // namespace
