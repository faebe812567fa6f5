// Runs broad phases in child processes and compares their pairs with all pairs.
#include "harness/check/broad/broad_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>

#include "algorithms/core/executor/executor.h"
#include "harness/process/isolate.h"

namespace touchstone::check {
namespace {

constexpr std::size_t most_frames = 16;
constexpr int threads = 2;

// The findings of a child about one scene.
struct Found {
  Status status = Status::ok;
  std::size_t frames = 0;
  std::array<grade::PairFaults, most_frames> faults{};
};

std::vector<IndexPair> true_pairs(std::span<const Aabb> boxes) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      if (overlap(boxes[a], boxes[b])) pairs.push_back({a, b});
    }
  }
  return pairs;
}

// Returns the bits of the coordinates; as numbers, 0 and -0 would be equal.
std::array<std::uint32_t, 6> bits(const Aabb& box) {
  return std::bit_cast<std::array<std::uint32_t, 6>>(box);
}

struct Change {
  std::vector<std::uint32_t> moved, inserted, removed;

  Change(std::span<const Aabb> before, std::span<const Aabb> now) {
    for (std::uint32_t id = 0; id < now.size(); ++id) {
      const bool was = id < before.size() && !before[id].is_empty();
      const bool is = !now[id].is_empty();
      if (was && !is) removed.push_back(id);
      if (!was && is) inserted.push_back(id);
      if (was && is && bits(before[id]) != bits(now[id])) moved.push_back(id);
    }
  }
};

Found play(const BroadPhaseEntry& entry, const BoxScene& scene) {
  Executor executor(threads);
  const std::unique_ptr<BroadPhase> algorithm = entry.make(executor);
  PairSink sink;
  Found found;
  std::span<const Aabb> before;
  for (const std::vector<Aabb>& boxes : scene.frames) {
    if (before.empty()) {
      algorithm->build(boxes);
    } else {
      const Change change(before, boxes);
      algorithm->update({boxes, change.moved, change.inserted, change.removed});
    }
    const Status status = algorithm->find_pairs(sink);
    if (status != Status::ok) {
      found.status = status;
      return found;
    }
    std::vector<IndexPair> pairs = sink.gather();
    found.faults[found.frames++] = grade::check_pairs(pairs, true_pairs(boxes), before);
    before = boxes;
  }
  return found;
}

}  // namespace

bool BroadCheck::good() const {
  return status == Status::ok &&
         std::ranges::all_of(frames, [](const grade::PairFaults& f) { return f.none(); });
}

std::string BroadCheck::faults() const {
  if (status != Status::ok) return failure.empty() ? std::string(to_string(status)) : failure;
  std::string text;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].none()) continue;
    text += fmt::format("{}frame {}: {}", text.empty() ? "" : "; ", i, to_string(frames[i]));
  }
  return text;
}

std::vector<BroadCheck> check_broad_phases(std::span<const BroadPhaseEntry* const> entries,
                                           std::span<const BoxScene> scenes, double time_limit) {
  std::vector<BroadCheck> checks;
  for (const BroadPhaseEntry* entry : entries) {
    const auto played = process::isolated_answers<Found>(
        scenes.size(), {.item_seconds = time_limit},
        [&] { return [&](std::size_t i) { return play(*entry, scenes[i]); }; });
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      BroadCheck check;
      check.entry = entry;
      check.scene = &scenes[i];
      for (const std::vector<Aabb>& boxes : scenes[i].frames) {
        check.pairs += static_cast<std::int64_t>(true_pairs(boxes).size());
      }
      const Found& found = played.answers[i];
      check.status = found.status;
      const auto faults = std::span(found.faults).first(found.frames);
      check.frames.assign(faults.begin(), faults.end());
      const auto at = std::ranges::find(played.failures, i, &process::IsolationFailure::item);
      if (at != played.failures.end()) check.failure = at->reason();
      checks.push_back(std::move(check));
    }
  }
  return checks;
}

}  // namespace touchstone::check
