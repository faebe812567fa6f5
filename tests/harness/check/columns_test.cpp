// Tests that the columns of checks are documented.
#include "harness/check/family_checker.h"
#include "harness/check/versions.h"
#include "harness/kinds/pair/pair_rows.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

TEST(Columns, OfChecksAreDocumented) {
  expect_documented("summary.csv", record::column_docs<kinds::SummaryRow>(
                                       kinds::PairRequest(kinds::CheckRequest())));
}

TEST(Columns, OfVersionsAreDocumented) {
  expect_documented("versions.csv", record::column_docs<check::VersionCount>());
  expect_documented("version_changes.csv", record::column_docs<check::VersionChange>());
}

TEST(Columns, OfFamiliesAreDocumented) {
  expect_documented("families.csv", record::column_docs<check::FamilyCount>(check::CheckRequest()));
}

TEST(Columns, OfCountsAreDocumented) {
  const kinds::PairRequest none{kinds::CheckRequest()};
  expect_documented("soak.csv", record::column_docs<kinds::VerdictSum>(none));
  expect_documented("jobs.csv of a count", record::column_docs<kinds::VerdictCount>(none));
}

}  // namespace
}  // namespace touchstone
