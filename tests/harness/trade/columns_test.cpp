// Tests that the columns of a trade's files are documented.
#include "harness/trade/advice/advice_files.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

using record::column_docs;

TEST(Columns, OfTradesAreDocumented) {
  expect_documented("points.csv of a trade", column_docs<trade::TradePointRow>());
  expect_documented("bins.csv of a trade", column_docs<trade::TradeBinRow>());
  expect_documented("front.csv of a trade", column_docs<trade::TradeFrontRow>());
  expect_documented("left_out.csv of a trade", column_docs<trade::LeftOutRow>());
  expect_documented("advice.csv", column_docs<trade::AdviceRow>());
  expect_documented("samples.csv of a trade", column_docs<trade::TradeSampleRow>());
}

}  // namespace
}  // namespace touchstone
