// Tests that the columns of plans and of joined results are documented.
#include "harness/record/raw_row.h"
#include "harness/shards/merge.h"
#include "harness/shards/shard_folder.h"
#include "harness/shards/shard_plan.h"
#include "harness/stats/machines.h"
#include "tests/harness/columns_page.h"

namespace touchstone {
namespace {

TEST(Columns, OfPlansAreDocumented) {
  expect_documented("shards.csv of a plan", record::column_docs<shards::PlannedShard>());
  expect_documented("attempts.csv", record::column_docs<shards::Attempt>());
}

TEST(Columns, OfJoinedResultsAreDocumented) {
  expect_documented("shards.csv", record::column_docs<shards::JoinedShard>());
  expect_documented("blocks.csv", record::column_docs<stats::BlockRow>());
  expect_documented("across.csv", record::column_docs<stats::AcrossRow>());
}

}  // namespace
}  // namespace touchstone
