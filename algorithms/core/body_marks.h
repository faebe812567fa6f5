// Marks of chosen bodies, and the pairs of which one is chosen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/pair_sink.h"

namespace touchstone {

// A set of bodies by their ids. A change costs in proportion to the bodies, and not to their ids.
class BodyMarks {
 public:
  // Marks these bodies, in any order, and no others.
  void set(std::span<const std::uint32_t> bodies) {
    for (const std::uint32_t id : marked_) marks_[id] = 0;
    marked_.assign(bodies.begin(), bodies.end());
    for (const std::uint32_t id : bodies) {
      if (id >= marks_.size()) marks_.resize(std::size_t{id} + 1, 0);
      marks_[id] = 1;
    }
  }
  bool has(std::uint32_t id) const { return id < marks_.size() && marks_[id] != 0; }

  // Drops the pairs of two bodies that are not marked; the others keep their order.
  void keep_pairs_of_marked(PairSink& sink) const {
    for (std::size_t i = 0; i < sink.chunks().size(); ++i) {
      PairBuffer& chunk = sink.chunk(i);
      const std::span<const IndexPair> pairs = chunk.pairs();
      chunk.clear();
      for (const IndexPair pair : pairs) {
        if (has(pair.a) || has(pair.b)) chunk.push(pair.a, pair.b);
      }
    }
  }

 private:
  std::vector<std::uint8_t> marks_;  // indexed by id; 1 for a marked body
  std::vector<std::uint32_t> marked_;
};

}  // namespace touchstone
