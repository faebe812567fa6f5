// Tests of what is counted of peers.
#include "harness/peer/use.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>

#include "harness/peer/peer_process.h"
#include "tests/harness/columns_page.h"

namespace touchstone::peer {
namespace {

TEST(Use, CountsOverProcesses) {
  Use use(10);
  const pid_t child = fork();
  if (child == 0) {
    for (const double seconds : {3.0, 1.0, 2.0, 8.0}) use.add_seconds(seconds);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  use.add_memory(5);
  use.add_memory(3);
  const PeerRow row = use.row("x@1");
  EXPECT_EQ(row.peer, "x@1");
  EXPECT_EQ(row.repeat, 10);
  EXPECT_EQ(row.repeated, 4);
  EXPECT_EQ(row.peak_memory, 5);
  EXPECT_EQ(row.least_seconds, 1);
  EXPECT_EQ(row.median_seconds, 2.5);
  EXPECT_EQ(row.greatest_seconds, 8);
  EXPECT_TRUE(std::isnan(Use(0).row("y").median_seconds));
}

TEST(Use, HasTheStartsAndMemoryOfPrograms) {
  Use use(0);
  for (int i = 0; i < 2; ++i) {
    PeerProcess process(
        {"python3 -c 'x = b\"x\" * 50_000_000; print(len(x), flush=True); input()'", ""},
        {.use = &use});
    EXPECT_EQ(process.exchange("", 1).front(), "50000000");
  }
  const PeerRow row = use.row("x");
  EXPECT_EQ(row.starts, 2);
  EXPECT_GT(row.peak_memory, 50'000'000);
  EXPECT_LT(row.peak_memory, 200'000'000);
}

TEST(Columns, OfPeersAreDocumented) {
  expect_documented("peers.csv", record::column_docs<PeerRow>());
}

}  // namespace
}  // namespace touchstone::peer
