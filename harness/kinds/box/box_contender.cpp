// Runs a broad phase in a child process, and keeps its pairs in a temporary file.
#include "harness/kinds/box/box_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <numeric>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/hash.h"

namespace touchstone::kinds {
namespace {

[[noreturn]] void keeping_pairs_failed(int error) {
  throw base::InputError(
      fmt::format("the pairs cannot be kept in a temporary file: {}", std::strerror(error)));
}

// Lists the bodies that moved or came since the last frame; after a build, all have come.
void list_fresh(const scene::BoxFrame& frame, bool is_update, std::vector<std::uint32_t>& fresh) {
  fresh.clear();
  if (is_update) {
    std::ranges::merge(frame.moved, frame.inserted, std::back_inserter(fresh));
  } else {
    fresh.resize(frame.count);
    std::iota(fresh.begin(), fresh.end(), 0U);
  }
}

// Counts the known pairs that were not found.
void count_missing(const scene::BoxFrame& frame, const PairSink& found, FrameResult& result) {
  const std::vector<IndexPair>& known = frame.known_pairs;
  std::vector<char> is_found(known.size(), 0);
  for (const PairBuffer& chunk : found.chunks()) {
    if (known.empty()) break;
    for (const IndexPair& pair : chunk.pairs()) {
      const auto at = std::ranges::lower_bound(known, pair);
      if (at != known.end() && *at == pair)
        is_found[static_cast<std::size_t>(at - known.begin())] = 1;
    }
  }
  result.missing = static_cast<std::size_t>(std::ranges::count(is_found, 0));
  if (result.missing > 0) {
    result.first_missing =
        known[static_cast<std::size_t>(std::ranges::find(is_found, 0) - is_found.begin())];
  }
}

}  // namespace

// The state of the child process, which has threads of its own.
struct BoxContender::Worker {
  Executor executor;
  std::unique_ptr<BroadPhase> broad_phase;
  PairSink sink, began, ended, moved;
  std::vector<std::uint32_t> awake, fresh;
  bool built = false;

  Worker(const BroadPhaseEntry& entry, int threads, ExecutorKind kind)
      : executor(threads, Pinning::one_a_thread, kind), broad_phase(entry.make(executor)) {}
};

BoxContender::BoxContender(const BroadPhaseEntry& entry, const std::vector<scene::BoxFrame>& frames,
                           const BoxOptions& options, const std::vector<char>& is_resting)
    : entry_(entry),
      frames_(frames),
      options_(options),
      is_resting_(is_resting),
      results_(frames.size()) {
  if (options.pairs.empty() && options.changes.empty() && options.moved.empty()) return;
  kept_.reset(std::tmpfile());
  if (!kept_) keeping_pairs_failed(errno);
}

std::vector<AskFailure> BoxContender::run() {
  const process::IsolationLimits limits = {.item_seconds = options_.time_limit,
                                           .memory = process::IsolationLimits::no_limit};
  const process::IsolationReport report = process::isolate(frames_.size(), limits, [this] {
    const auto worker = std::make_shared<Worker>(entry_, options_.threads, options_.executor);
    return [this, worker](std::size_t i) { find_pairs(*worker, frames_[i], results_[i]); };
  });
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    FrameResult& result = results_[i];
    if (report.states[i] != process::ItemState::done)
      result = {.status = process::status_of(report.states[i])};
    if (result.error != 0) keeping_pairs_failed(result.error);
  }
  std::vector<AskFailure> failures;
  for (const process::IsolationFailure& failure : report.failures) {
    failures.push_back({fmt::format("frame {}", frames_[failure.item].number), failure.reason()});
  }
  return failures;
}

std::vector<IndexPair> BoxContender::kept_pairs(std::size_t frame) const {
  std::vector<IndexPair> all = kept(frame, 0, results_[frame].pairs);
  std::ranges::sort(all);
  return all;
}
std::vector<IndexPair> BoxContender::kept_moved_pairs(std::size_t frame) const {
  const FrameResult& result = results_[frame];
  std::vector<IndexPair> all =
      kept(frame, result.pairs + result.began + result.ended, result.moved);
  std::ranges::sort(all);
  return all;
}
std::vector<IndexPair> BoxContender::kept_changes(std::size_t frame, bool have_begun) const {
  const FrameResult& result = results_[frame];
  return have_begun ? kept(frame, result.pairs, result.began)
                    : kept(frame, result.pairs + result.began, result.ended);
}

void BoxContender::find_pairs(Worker& worker, const scene::BoxFrame& frame, FrameResult& result) {
  const bool is_update = worker.built && !options_.rebuild;
  const std::size_t slots = is_update ? frame.boxes.size() : frame.count;
  list_awake(slots, worker.awake);
  const base::Stopwatch stopwatch;
  if (is_update) {
    worker.broad_phase->update(frame.change());
  } else {
    worker.broad_phase->build(frame.own_boxes());
  }
  result.status = options_.resting.empty()
                      ? worker.broad_phase->find_pairs(worker.sink)
                      : worker.broad_phase->find_pairs_of(worker.awake, worker.sink);
  result.seconds = stopwatch.seconds();
  worker.built = true;
  count_missing(frame, worker.sink, result);
  result.pairs = worker.sink.size();
  for (const PairBuffer& chunk : worker.sink.chunks())
    result.hash += base::pair_hash(chunk.pairs());
  if (!options_.changes.empty()) {
    const Status status =
        options_.resting.empty()
            ? worker.broad_phase->find_changes(worker.began, worker.ended)
            : worker.broad_phase->find_changes_of(worker.awake, worker.began, worker.ended);
    if (result.status == Status::ok) result.status = status;
    result.began = worker.began.size();
    result.ended = worker.ended.size();
  }
  if (!options_.moved.empty()) {
    list_fresh(frame, is_update, worker.fresh);
    const Status status = worker.broad_phase->find_pairs_of(worker.fresh, worker.moved);
    if (result.status == Status::ok) result.status = status;
    result.moved = worker.moved.size();
  }
  if (kept_) keep(worker, result);
  result.known = true;
}

void BoxContender::list_awake(std::size_t slots, std::vector<std::uint32_t>& awake) const {
  awake.clear();
  for (std::uint32_t id = 0; id < slots && !options_.resting.empty(); ++id) {
    if (id >= is_resting_.size() || is_resting_[id] == 0) awake.push_back(id);
  }
}
void BoxContender::keep(const Worker& worker, FrameResult& result) {
  // The place is behind all data of an earlier child, even partial data.
  bool good = fseeko(kept_.get(), 0, SEEK_END) == 0;
  result.kept_at = ftello(kept_.get());
  for (const PairSink* sink : {&worker.sink, &worker.began, &worker.ended, &worker.moved}) {
    for (const PairBuffer& chunk : sink->chunks()) {
      const std::size_t count = chunk.size();
      good =
          good && std::fwrite(chunk.pairs().data(), sizeof(IndexPair), count, kept_.get()) == count;
    }
  }
  if (!good || std::fflush(kept_.get()) != 0) result.error = errno;
}
// Returns `count` of the pairs that were kept of the frame, from the `first` on.
std::vector<IndexPair> BoxContender::kept(std::size_t frame, std::size_t first,
                                          std::size_t count) const {
  std::vector<IndexPair> pairs(count);
  const auto at = results_[frame].kept_at + static_cast<off_t>(first * sizeof(IndexPair));
  if (fseeko(kept_.get(), at, SEEK_SET) != 0 ||
      std::fread(pairs.data(), sizeof(IndexPair), count, kept_.get()) != count) {
    keeping_pairs_failed(errno);
  }
  return pairs;
}
}  // namespace touchstone::kinds
