// Tests that the columns of the tables' files are documented.
#include "harness/stats/table_check.h"
#include "harness/stats/tables/table_rows.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

using record::column_docs;

// The key of a set as a row of its own.
struct KeyRow {
  stats::SetKey key;
};
template <record::row_of<KeyRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  stats::key_columns(row.key, visit);
}

// Expects that the file's documentation opens with the key's, which the page has once.
void expect_documented_after_key(const std::string& file, const std::string& docs) {
  const std::string key = column_docs<KeyRow>();
  ASSERT_EQ(docs.substr(0, key.size()), key) << file;
  const std::string head = docs.substr(0, docs.find('\n', docs.find('\n') + 1) + 1);
  expect_documented(file, head + docs.substr(key.size()));
}

TEST(Columns, OfTablesAreDocumented) {
  expect_documented("set", column_docs<KeyRow>());
  expect_documented_after_key("times.csv", column_docs<stats::TimeRow>());
  expect_documented_after_key("ratios.csv", column_docs<stats::RatioRow>(1.0));
  expect_documented_after_key("winners.csv", column_docs<stats::WinnerRow>());
  expect_documented_after_key("exponents.csv", column_docs<stats::ExponentRow>());
  expect_documented_after_key("speed_ups.csv", column_docs<stats::SpeedUpRow>());
  expect_documented_after_key("executors.csv", column_docs<stats::ExecutorRow>());
  expect_documented_after_key("work.csv", column_docs<stats::WorkRow>());
  expect_documented_after_key("agreement.csv", column_docs<stats::AgreementRow>());
  expect_documented_after_key("broad_best.csv", column_docs<stats::BroadBestRow>());
  expect_documented_after_key("narrow_best.csv", column_docs<stats::NarrowBestRow>());
  expect_documented("published.csv", column_docs<stats::PublishedRow>());
}

}  // namespace
}  // namespace touchstone
