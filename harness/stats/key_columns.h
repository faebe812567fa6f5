// The columns of a set's key, which open the rows of all tables.
#pragma once

#include "harness/record/row.h"
#include "harness/stats/samples.h"

namespace touchstone::stats {

template <record::row_of<SetKey> Key, class Visit>
void key_columns(Key& key, Visit& visit) {
  visit("scene", key.scene, "The scene's name.");
  visit("scene_hash", key.scene_hash, "The scene's hash, as in raw.csv.");
  visit("bodies", record::nonzero(key.bodies), "Number of bodies; empty for a row over several.");
  visit("seed", key.seed, "The scene's seed, where the campaign sets one.");
  visit("boxes", key.boxes, "Kind of boxes: tight or loose.");
  visit("threads", key.threads, "Width of the executor.");
  visit("task", key.task, "Task of the narrow phases; empty for broad phases.");
  visit("pair_kind", key.pair_kind, "The kinds of the two shapes; empty for broad phases.");
  visit("pairs_of", key.pairs_of,
        "The broad phase that found the pairs of a narrow phase; empty: the true pairs.");
  visit("rebuild", record::newer(key.rebuild), "1 where broad phases build every frame anew.");
  visit("isa_limit", record::newer(key.isa_limit),
        "The most vector instructions that the campaign allows; empty: no limit.");
}

// Visits a number with its interval: `name`, `name_low` and `name_high`.
template <class Interval, class Visit>
void interval_columns(const std::string& name, Interval& interval, const std::string& what,
                      Visit& visit) {
  visit(name, interval.median, what);
  visit(name + "_low", interval.low, "Lower end of its 95 % interval.");
  visit(name + "_high", interval.high, "Upper end of its 95 % interval.");
}

}  // namespace touchstone::stats
