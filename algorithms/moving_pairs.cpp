// Pairs of moving boxes: cuts of the step, and the tests behind the broad phase.
#include "algorithms/moving_pairs.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <limits>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/kernels/boxes/aabb_scan.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/motion/moving_boxes.h"
#include "algorithms/kernels/motion/swept_box.h"

namespace touchstone {
namespace {

// Small, so that two workers share what a scene of a few hundred bodies has.
constexpr std::size_t bodies_a_block = 64;
constexpr std::size_t pairs_a_block = 64;
// Bodies of the sample, each of which is tested against so many others at least, or a part of them.
constexpr std::size_t sampled = 16;
constexpr std::size_t sampled_a_block = 2;
constexpr std::size_t least_others = 512;
constexpr std::size_t others_part = 32;

// Writes the bodies i * count / others of a sample to `ids`, for first <= i < last, and returns them.
// A division for each would cost more than the rest.
std::span<const std::uint32_t> sampled_ids(std::size_t first, std::size_t last, std::size_t count,
                                           std::size_t others,
                                           std::array<std::uint32_t, bodies_a_block>& ids) {
  const std::size_t step = count / others, step_rest = count % others;
  std::size_t body = first * count / others, rest = first * count % others;
  for (std::size_t i = first; i < last; ++i) {
    ids[i - first] = static_cast<std::uint32_t>(body);
    body += step;
    rest += step_rest;
    if (rest >= others) {
      rest -= others;
      ++body;
    }
  }
  return std::span(ids).first(last - first);
}

}  // namespace

struct MovingPairs::Sample {
  AabbSoA boxes;
  PairSink overlaps;  // of the sampled bodies, each with all others of the sample
};

MovingPairs::MovingPairs(const BroadPhaseEntry& broad_phase, Executor& executor, int parts)
    : broad_phase_(&broad_phase),
      executor_(&executor),
      asked_parts_(parts),
      sample_(std::make_unique<Sample>()) {
  searches_.emplace_back().broad_phase = broad_phase.make(executor);
}

MovingPairs::~MovingPairs() = default;

MovingBox moving_box(const Shape& shape, const Pose& pose, const Motion& motion) {
  return moving_box_of(shape, pose, motion);
}

Aabb swept_box(const MovingBox& body) { return swept_box_of(body, 0, 1); }

// The number of pairs that a search on the boxes swept in the middle one of so many parts finds, as
// a sample has it.
double MovingPairs::expected_candidates(std::span<const MovingBox> bodies,
                                        std::span<const Aabb> swept, int parts) {
  const std::size_t count = bodies.size();
  const std::size_t others = std::min(count, std::max(least_others, count / others_part));
  const std::size_t own = std::min(sampled, others);
  const double begin = static_cast<double>(parts / 2) / parts;
  const double end = begin + 1.0 / parts;
  AabbSoA& boxes = sample_->boxes;
  boxes.resize(others);
  // Two loops, so that the executor knows what each takes.
  if (parts == 1) {
    for_each_block(*executor_, others, bodies_a_block,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     std::array<std::uint32_t, bodies_a_block> ids;
                     boxes.set(first, swept, sampled_ids(first, last, count, others, ids));
                   });
  } else {
    for_each_block(*executor_, others, bodies_a_block,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     std::array<std::uint32_t, bodies_a_block> ids;
                     std::size_t i = first;
                     for (const std::uint32_t id : sampled_ids(first, last, count, others, ids))
                       boxes.set(i++, swept_box_of(bodies[id], begin, end), id);
                   });
  }
  PairSink& overlaps = sample_->overlaps;
  overlaps.start(block_count(own, sampled_a_block));
  for_each_block(
      *executor_, own, sampled_a_block,
      [&](std::size_t block, std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
          const std::size_t i = k * others / own;
          const IndexRange before = {0, i}, after = {i, others};
          scan_boxes(boxes, {i, i + 1}, std::array{before, after}, overlaps.chunk(block));
        }
      });
  const double all = static_cast<double>(count);
  return static_cast<double>(overlaps.size()) / 2 * (all / static_cast<double>(own)) *
         (all / static_cast<double>(others));
}

int MovingPairs::cheapest_parts(std::span<const MovingBox> bodies, std::span<const Aabb> swept) {
  if (bodies.empty()) return 1;
  const double boxes = box_cost * static_cast<double>(bodies.size());
  int best = 1;
  double least = std::numeric_limits<double>::infinity();
  // As soon as the boxes alone cost more than the best so far, no further cut can pay.
  for (int parts = 1; parts <= most_parts && parts * boxes < least; parts *= 2) {
    const double cost = parts * (boxes + expected_candidates(bodies, swept, parts));
    if (!(cost < least)) break;
    least = cost;
    best = parts;
  }
  return best;
}

// Returns the boxes that bodies sweep in a part.
std::span<const Aabb> MovingPairs::sweep(std::span<const MovingBox> bodies, int part) {
  std::vector<Aabb>& boxes = swept_[static_cast<std::size_t>(part)];
  boxes.resize(bodies.size());
  const double begin = static_cast<double>(part) / parts_;
  const double end = static_cast<double>(part + 1) / parts_;
  for_each_block(*executor_, bodies.size(), bodies_a_block,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i)
                     boxes[i] = swept_box_of(bodies[i], begin, end);
                 });
  return boxes;
}

// Two broad phases of a library may share state, so they do not search at the same time.
int MovingPairs::parts_at_once() const {
  const bool is_library = broad_phase_->info.origin == Origin::peer;
  return is_library || parts_ < executor_->width() ? 1 : executor_->width();
}

// Keeps, of what the searches found, the pairs whose moving boxes meet. One loop for all evens out that
// parts differ in what they hold.
void MovingPairs::keep_all_meeting(std::span<const MovingBox> bodies, std::span<Search> searches) {
  pieces_.clear();
  for (Search& search : searches) {
    const std::size_t first = pieces_.size();
    for (const PairBuffer& chunk : search.found.chunks()) {
      for (std::size_t i = 0; i < chunk.size(); i += pairs_a_block) {
        const std::size_t count = std::min(pairs_a_block, chunk.size() - i);
        pieces_.push_back({&search, pieces_.size() - first, chunk.pairs().subspan(i, count)});
      }
    }
    search.meeting.start(pieces_.size() - first);
  }
  const auto work = [&](std::size_t task, int) {
    const Piece& piece = pieces_[task];
    keep_meeting(bodies, piece.pairs, piece.search->meeting.chunk(piece.chunk));
  };
  executor_->run(pieces_.size(), std::cref(work));
}

// Appends the pairs that no earlier part has.
void MovingPairs::append_new(int part, const PairSink& meeting,
                             std::vector<IndexPair>& pairs) const {
  const auto is_new = [&](const IndexPair& pair) {
    for (auto k = static_cast<std::size_t>(part); k-- > 0;) {
      if (overlap(swept_[k][pair.a], swept_[k][pair.b])) return false;
    }
    return true;
  };
  for (const PairBuffer& chunk : meeting.chunks())
    std::ranges::copy_if(chunk.pairs(), std::back_inserter(pairs), is_new);
}

Status MovingPairs::find_pairs(std::span<const MovingBox> bodies, std::vector<IndexPair>& pairs) {
  // A fixed cut into several parts does not read them.
  whole_.resize(asked_parts_ > 1 ? 0 : bodies.size());
  for_each_block(*executor_, whole_.size(), bodies_a_block,
                 [&](std::size_t, std::size_t first, std::size_t last) {
                   for (std::size_t i = first; i < last; ++i) whole_[i] = swept_box(bodies[i]);
                 });
  return find_pairs(bodies, whole_, pairs);
}

Status MovingPairs::find_pairs(std::span<const MovingBox> bodies, std::span<const Aabb> swept,
                               std::vector<IndexPair>& pairs) {
  pairs.clear();
  candidates_ = 0;
  parts_ = asked_parts_ > 0 ? asked_parts_ : cheapest_parts(bodies, swept);
  swept_.resize(std::max(swept_.size(), static_cast<std::size_t>(parts_)));
  for (int first = 0; first < parts_;) {
    const auto at_once = static_cast<std::size_t>(std::min(parts_at_once(), parts_ - first));
    while (searches_.size() < at_once)
      searches_.emplace_back().broad_phase = broad_phase_->make(*executor_);
    const std::span<Search> searches = std::span(searches_).first(at_once);
    const auto work = [&](std::size_t task, int) {
      Search& search = searches[task];
      const int part = first + static_cast<int>(task);
      search.broad_phase->build(parts_ == 1 ? swept : sweep(bodies, part));
      search.status = search.broad_phase->find_pairs(search.found);
    };
    executor_->run(at_once, std::cref(work));
    for (const Search& search : searches) {
      if (search.status != Status::ok) return search.status;
    }
    keep_all_meeting(bodies, searches);
    for (const Search& search : searches) {
      candidates_ += search.found.size();
      append_new(first++, search.meeting, pairs);
    }
  }
  return Status::ok;
}

}  // namespace touchstone
