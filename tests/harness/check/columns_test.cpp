// Tests that the columns of checks and soaks are documented.
#include "harness/check/check_rows.h"
#include "harness/check/families/family_rows.h"
#include "harness/check/soak/soak_rows.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

TEST(Columns, OfChecksAreDocumented) {
  expect_documented("summary.csv", record::column_docs<check::SummaryRow>(check::CheckSubjects{}));
}

TEST(Columns, OfFamiliesAreDocumented) {
  expect_documented("families.csv",
                    record::column_docs<check::FamilyCount>(check::CheckSubjects{}));
}

TEST(Columns, OfSoaksAreDocumented) {
  const check::CheckSubjects none;
  expect_documented("soak.csv", record::column_docs<check::SoakRow>(none));
  expect_documented("jobs.csv of a soak", record::column_docs<check::SoakJobRow>(none));
}

}  // namespace
}  // namespace touchstone
