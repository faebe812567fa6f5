// Tests that the columns of checks are documented.
#include "harness/check/check_rows.h"
#include "harness/check/versions.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

TEST(Columns, OfChecksAreDocumented) {
  expect_documented("summary.csv", record::column_docs<check::SummaryRow>(check::CheckSubjects{}));
}

TEST(Columns, OfVersionsAreDocumented) {
  expect_documented("versions.csv", record::column_docs<check::VersionCount>());
  expect_documented("version_changes.csv", record::column_docs<check::VersionChange>());
}

TEST(Columns, OfFamiliesAreDocumented) {
  expect_documented("families.csv",
                    record::column_docs<check::FamilyCount>(check::CheckSubjects{}));
}

TEST(Columns, OfCountsAreDocumented) {
  const check::CheckSubjects none;
  expect_documented("soak.csv", record::column_docs<check::VerdictSum>(none));
  expect_documented("jobs.csv of a count", record::column_docs<check::VerdictCount>(none));
}

}  // namespace
}  // namespace touchstone
