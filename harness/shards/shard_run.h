// Does a shard of a plan.
#pragma once

#include <cstdint>
#include <filesystem>

#include "harness/shards/work.h"

namespace touchstone::shards {

enum class ShardEnd : std::uint8_t { done, was_done, interrupted };

// Does what is missing of a shard, with `workers` processes where the work is not timed. Another
// process may have been killed in it, at any moment. An interrupt (SIGINT, SIGTERM) ends it where
// nothing is lost. Every attempt and its end is noted in the shard's folder. Throws InputError if
// another process does the shard, or if program, campaign or scenes differ from the planned ones.
// The caller is the only thread of its process.
ShardEnd run_shard(const std::filesystem::path& plan, std::int64_t shard, int workers);

// Returns the parts of a shard.
std::vector<base::UnitRange> parts_of(const Work& work, base::UnitRange units);
// The facts that the folder of each part of a shard has.
record::Facts part_facts(const std::string& plan, std::int64_t shard);
inline constexpr const char* host_fact = "host";
// Returns the facts of a folder of results; none if it has no machine.csv.
record::Facts facts_of(const std::filesystem::path& folder);

}  // namespace touchstone::shards
