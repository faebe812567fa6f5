// The first step of a warm start: the pairs of a batch whose last separating plane still parts them
// are answered together, before a shape is read. Used by gjk, gjk-lanes, ellipsoid and smooth, whose
// PairMemory begins with a CarriedPlane. `Batch` is a narrow phase's PairBatch.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"
#include "algorithms/kernels/batch/plane_lanes.h"
#include "algorithms/kernels/gjk/carried_plane.h"

namespace touchstone {

class WarmPlanes {
 public:
  // Whether planes can answer pairs of the batch: it has memory, bounded bodies, and needs no
  // distance of bodies that are apart by more than `margin` (metres).
  template <class Batch>
  static bool may_answer(Task task, const Batch& batch, double margin = no_margin) {
    return !batch.memory.empty() && batch.kind_b != ShapeKind::halfspace &&
           (!asks_distance(task) || margin < no_margin);
  }

  // Writes the outcomes of the pairs that are parted. Returns the places of the others, which are
  // valid until the next call. `directs`: for others, `directions` is wanted.
  template <class Batch>
  std::span<const std::uint32_t> answer(Task task, const Batch& batch, bool directs,
                                        std::span<Outcome> outcomes, double margin = no_margin);

  // For the places of those others, where to look for a plane (PlaneRest).
  const std::array<float, 4>* directions() const { return directions_.data(); }

  // Does so for pair i alone, of a batch that planes may answer; false if it is not parted.
  template <class Batch>
  static bool answer_alone(Task task, const Batch& batch, std::size_t i, Outcome& outcome,
                           double margin = no_margin);

  // The batch of those others. Its pair k is the pair at place k of theirs.
  template <class Batch>
  Batch others(const Batch& batch);

  // Stores a plane at the begin of the memory of pair i.
  template <class Batch>
  static void keep(const CarriedPlane& plane, const Batch& batch, std::size_t i) {
    std::memcpy(batch.memory[batch.memory_of[i]].bytes.data(), &plane, sizeof plane);
  }

 private:
  static constexpr double no_margin = std::numeric_limits<double>::infinity();

  std::size_t left_count_ = 0;
  std::vector<std::uint32_t> left_;
  std::vector<std::array<float, 4>> directions_;
  std::vector<std::uint32_t> first_, second_, memory_of_;  // of `others`
};

template <class Batch>
std::span<const std::uint32_t> WarmPlanes::answer(Task task, const Batch& batch, bool directs,
                                                  std::span<Outcome> outcomes, double margin) {
  static_assert(sizeof batch.memory[0] == PlaneTable::memory_bytes);
  left_.resize(std::max(left_.size(), batch.size()));
  if (directs) directions_.resize(left_.size());
  const bool measured = asks_distance(task);
  const PlaneTable table{.pairs = batch.pairs,
                         .memory = batch.memory.data()->bytes.data(),
                         .memory_of = batch.memory_of,
                         .margin = measured && margin > 0 ? margin : 0};
  left_count_ = part_by_planes(table, outcomes.data(),
                               {left_.data(), directs ? directions_.data() : nullptr});
  if (measured) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (k < left_count_ && left_[k] == i) {
        ++k;
      } else {
        write_beyond(margin, outcomes[i]);
      }
    }
  }
  return {left_.data(), left_count_};
}

template <class Batch>
bool WarmPlanes::answer_alone(Task task, const Batch& batch, std::size_t i, Outcome& outcome,
                              double margin) {
  // Loads of its vectors would wait for the writes of a copy.
  const CarriedPlane& plane = carried_plane_at(batch.memory[batch.memory_of[i]].bytes.data());
  const bool measured = asks_distance(task);
  if (!plane.parts(batch.pairs.poses[batch.pairs.first[i]],
                   batch.pairs.poses[batch.pairs.second[i]], measured ? margin : 0)) {
    return false;
  }
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  if (measured) write_beyond(margin, outcome);
  outcome.iterations = outcome.support_calls = 0;
  return true;
}

template <class Batch>
Batch WarmPlanes::others(const Batch& batch) {
  first_.clear();
  second_.clear();
  memory_of_.clear();
  for (std::size_t k = 0; k < left_count_; ++k) {
    first_.push_back(batch.pairs.first[left_[k]]);
    second_.push_back(batch.pairs.second[left_[k]]);
    memory_of_.push_back(batch.memory_of[left_[k]]);
  }
  Batch others = batch;
  others.pairs.first = first_;
  others.pairs.second = second_;
  others.memory_of = memory_of_;
  return others;
}

}  // namespace touchstone
