// Joins the shards of a plan.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/row.h"
#include "harness/shards/work.h"

namespace touchstone::shards {

// A row of shards.csv of the results.
struct JoinedShard {
  std::int64_t shard = 0;
  base::UnitRange units;
  std::string machine;
  std::int64_t attempts = 0;
  std::string begun, ended;
};

template <record::row_of<JoinedShard> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("shard", row.shard, "Number of the shard.");
  visit("first", row.units.first, "Its first unit: a block, a job, a cell or a scene.");
  visit("end", row.units.end, "The unit after its last one.");
  visit("machine", row.machine, "The machine that did its last part.");
  visit("attempts", row.attempts, "Number of times that it was begun.");
  visit("begun", row.begun, "When its last attempt was begun, UTC.");
  visit("ended", row.ended, "When it was done, UTC.");
}

struct MergeSetting {
  bool zstd = false;       // files of rows are packed, as NAME.csv.zst
  bool overwrite = false;  // replaces results that are not of this plan
  bool partial = false;    // joins the shards that are done, if there is one
};

struct MergeResult {
  // A line for each shard that is not done: why, and its last words.
  std::vector<std::string> missing;
  std::string missing_list;  // such as "3,17-19"
  bool written = false;      // false if a shard is missing, unless the setting allows it
  Merged merged;
};

// Joins the shards into the folder `out`, which is there as a whole or not at all; results of the
// same plan are replaced. Partial results say in machine.csv that they are not finished, and which
// shards are `missing`. Rows are streamed and come in the order of one undisturbed run. Beside
// them are machine.csv, with the facts that all machines share, machines/NAME/machine.csv with all
// facts of each, shards.csv: who did what, and how long, and files.txt, which lists them. Files of
// others in `out` stay. Throws InputError if a shard is of another plan, program or scene, if rows are
// not those of which the shard's progress.csv has the hash, or if `out` holds other results.
MergeResult merge_plan(const std::filesystem::path& plan, const std::filesystem::path& out,
                       const MergeSetting& setting);

}  // namespace touchstone::shards
