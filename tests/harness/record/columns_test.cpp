#include "harness/record/findings.h"
#include "harness/record/raw_row.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

TEST(Columns, OfMeasurementsAreDocumented) {
  expect_documented("raw.csv", column_docs<RawRow>());
}

TEST(Columns, OfDiscrepanciesAreDocumented) {
  expect_documented("departures.csv", column_docs<Departure>());
}

}  // namespace
}  // namespace touchstone
