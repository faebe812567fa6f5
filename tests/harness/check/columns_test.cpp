// Tests that the columns of a soak's files are documented.
#include "harness/check/soak/soak_rows.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

TEST(Columns, OfSoaksAreDocumented) {
  const check::CheckSubjects none;
  expect_documented("soak.csv", record::column_docs<check::SoakRow>(none));
  expect_documented("jobs.csv of a soak", record::column_docs<check::SoakJobRow>(none));
}

}  // namespace
}  // namespace touchstone
