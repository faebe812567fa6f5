// What the programs behind pipes took: how often they were started, their memory, and the times that they measured
// themselves.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "algorithms/core/outcome.h"
#include "harness/process/child_process.h"
#include "harness/record/row.h"

namespace touchstone::peer {

// A row of peers.csv.
struct PeerRow {
  std::string peer;
  std::int64_t starts = 0, peak_memory = 0, repeat = 0, repeated = 0;
  double median_seconds = Outcome::none, least_seconds = Outcome::none,
         greatest_seconds = Outcome::none;
};

template <record::row_of<PeerRow> Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("peer", row.peer, "Name of the peer, with its version.");
  visit("starts", row.starts, "How often its program was started.");
  visit("peak_memory", row.peak_memory,
        "Most memory of its processes together that no file backs, bytes; sampled every 50 ms and "
        "when they are ended.");
  visit("repeat", row.repeat, "How often each question was to be repeated; 0: once.");
  visit("repeated", row.repeated, "Answers with a time that the peer measured itself.");
  visit("median_seconds", row.median_seconds,
        "Median of these times, of one repeat. Not to be compared with times that are measured "
        "here.");
  visit("least_seconds", row.least_seconds, "Least of them.");
  visit("greatest_seconds", row.greatest_seconds, "Greatest of them.");
}

// Counts of one peer, which all processes share that ask it.
class Use {
 public:
  explicit Use(std::int64_t repeat);

  std::int64_t repeat() const { return repeat_; }
  void add_start() { ++counts_[0].starts; }
  void add_memory(std::size_t bytes);
  // Of one repeat. The first million of times is kept.
  void add_seconds(double seconds);
  PeerRow row(std::string_view name) const;

 private:
  struct Counts {
    std::atomic<std::int64_t> starts, memory, times;
  };

  std::int64_t repeat_;
  process::SharedArray<Counts> counts_{1};
  process::SharedArray<double> seconds_;
};

}  // namespace touchstone::peer
