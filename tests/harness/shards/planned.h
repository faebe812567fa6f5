// A plan in a temporary folder.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "harness/shards/merge.h"
#include "harness/shards/shard_folder.h"
#include "harness/shards/shard_plan.h"
#include "harness/shards/status.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

class Planned : public ::testing::Test {
 protected:
  std::filesystem::path plan() const { return folder_.path() / "plan"; }
  std::filesystem::path out() const { return folder_.path() / "out"; }
  std::filesystem::path part(std::int64_t shard, std::int64_t first, std::int64_t end) const {
    return shards::part_path(shards::shard_path(plan(), shard), {first, end});
  }

  shards::ShardPlan make(const std::string& toml, std::int64_t shards) {
    return shards::make_plan(folder_.write("work.toml", toml), {.shards = shards}, plan());
  }
  void run(std::int64_t shard) {
    ASSERT_EQ(shards::run_shard(plan(), shard, 2), shards::ShardEnd::done) << shard;
  }
  shards::MergeResult merge() { return shards::merge_plan(plan(), out(), {}); }

  // Replaces a text in a file of the folder.
  void edit(const std::filesystem::path& file, const std::string& from, const std::string& to) {
    const std::string name = file.lexically_relative(folder_.path()).string();
    std::string text = folder_.read(name);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << file << " has no " << from;
    folder_.write(name, text.replace(at, from.size(), to));
  }

  TemporaryFolder folder_;
};

}  // namespace touchstone
