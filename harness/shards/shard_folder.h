// The folder of a shard: who does it, how earlier attempts ended, and its parts.
//
// It holds
// - lock: held by the process that does the shard, on whatever machine;
// - attempts.csv: a row at the begin of each attempt, and one at its end if there was time for one;
// - part-FIRST-END: the results of a part, a folder that can be resumed (harness/record).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/unit_range.h"
#include "harness/record/row.h"
#include "harness/shards/work.h"

namespace touchstone::shards {

enum class Event : std::uint8_t {
  begun,
  done,         // all parts are there
  interrupted,  // by a signal: what was done is kept
  failed,       // by an error, which `words` has
};
std::string_view to_string(Event event);

// A row of attempts.csv.
struct Attempt {
  std::int64_t attempt = 0;
  Event event = Event::begun;
  std::string time, host;
  std::int64_t process = 0;
  std::string job, log, words;
};

template <record::row_of<Attempt> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("attempt", row.attempt, "Number of the attempt, from 0.");
  visit("event", row.event, "`begun`, or how it ended. An attempt that was killed has no end.");
  visit("time", row.time, "Date and time, UTC.");
  visit("host", row.host, "Name of the machine.");
  visit("process", row.process, "Number of the process there.");
  visit("job", row.job, "The scheduler's name of the job; empty without one.");
  visit("log", row.log, "The file that has its output; empty where that is not known.");
  visit("words", row.words, "The error, or what there is to say.");
}

// Returns DIR/shards/N/M for shard M, N = M / 1000.
std::filesystem::path shard_path(const std::filesystem::path& plan, std::int64_t shard);
// Returns the folder of a part in it.
std::filesystem::path part_path(const std::filesystem::path& shard, base::UnitRange part);
// Returns the rows of attempts.csv; none if the shard was never begun. A line that was cut by a kill
// is left out.
std::vector<Attempt> read_attempts(const std::filesystem::path& shard);

// Holds the lock of a shard and notes an attempt.
class ShardLock {
 public:
  // Makes the folder if it is not there. Throws InputError if another process does the shard, with
  // its name, or if the file system has no locks: then two processes could mix their rows.
  ShardLock(std::filesystem::path shard, std::int64_t number);
  ~ShardLock();
  ShardLock(const ShardLock&) = delete;
  ShardLock& operator=(const ShardLock&) = delete;

  // Notes the begin of an attempt, and its end.
  void begin();
  void end(Event event, const std::string& words);

 private:
  void append(Event event, const std::string& words);

  std::filesystem::path folder_;
  std::int64_t attempt_ = 0;
  int descriptor_ = -1;
};

// Returns whether some process holds the lock of the shard.
bool is_locked(const std::filesystem::path& shard);

// Returns the name of this machine.
std::string host_name();

// Does a shard of a plan.

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
