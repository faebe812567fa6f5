// Tests that the columns of result files are documented.
#include "harness/record/findings.h"
#include "harness/record/raw_row.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

TEST(Columns, OfMeasurementsAreDocumented) {
  expect_documented("raw.csv", record::column_docs<record::RawRow>());
}

TEST(Columns, OfDeparturesAreDocumented) {
  expect_documented("departures.csv", record::column_docs<record::Departure>());
}

}  // namespace
}  // namespace touchstone
