#include "harness/base/text_table.h"

#include <gtest/gtest.h>

namespace {

using touchstone::base::TextTable;

TEST(TextTable, AlignsTheFirstColumnLeftAndTheOthersRight) {
  TextTable table({"", "a", "bb"});
  table.add({"row", "1.5", "2"});
  EXPECT_EQ(table.text(80),
            "       a  bb\n"
            "------------\n"
            "row  1.5   2\n");
}

TEST(TextTable, IsCutWhereThePageEnds) {
  TextTable table({"", "aaaa", "bbbb"});
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

}  // namespace
