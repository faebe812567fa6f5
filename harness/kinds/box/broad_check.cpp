// Runs broad phases in child processes and compares their pairs with all pairs.
#include "harness/kinds/box/broad_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <memory>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "algorithms/core/executor/executor.h"
#include "harness/base/table.h"
#include "harness/kinds/kind.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {
namespace {

constexpr std::size_t most_frames = 16;
constexpr int threads = 2;

// The findings of a child about one scene.
struct FoundInScene {
  Status status = Status::ok;
  std::size_t frames = 0;
  std::array<FrameFaults, most_frames> faults{};
};

Pairs true_pairs(std::span<const Aabb> boxes) {
  Pairs pairs;
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

// Asks a broad phase, frame by frame, and grades its answers.
class Asked {
 public:
  explicit Asked(BroadPhase& algorithm) : algorithm_(&algorithm) {}

  // `before` has the boxes of the frame before, `fresh` the bodies that moved or came since.
  // Returns the first status that is not ok.
  Status ask(std::span<const Aabb> boxes, std::span<const Aabb> before,
             const std::vector<std::uint32_t>& fresh, FrameFaults& faults) {
    before_ = before;
    const Pairs truth = true_pairs(boxes);
    // The bodies that are awake change from frame to frame.
    std::vector<std::uint32_t> awake;
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if ((id + id / 7 + frame_ / 2) % 3 == 0) awake.push_back(id);
    }
    ++frame_;
    const Pairs awake_truth = pairs_of(awake, truth);
    grade(algorithm_->find_pairs(sink_), faults.pairs, truth);
    grade(algorithm_->find_pairs_of(fresh, sink_), faults.moved, pairs_of(fresh, truth));
    grade(algorithm_->find_pairs_of(awake, sink_), faults.awake, awake_truth);
    PairSink ended;
    const auto grade_changes = [&](Status status, grade::PairFaults& began_faults,
                                   grade::PairFaults& ended_faults, Pairs& told, const Pairs& now) {
      grade(status, began_faults, without(now, told));
      std::swap(sink_, ended);
      grade(status, ended_faults, without(told, now));
      told = now;
    };
    grade_changes(algorithm_->find_changes(sink_, ended), faults.began, faults.ended, told_, truth);
    grade_changes(algorithm_->find_changes_of(awake, sink_, ended), faults.awake_began,
                  faults.awake_ended, told_awake_, awake_truth);
    return status_;
  }

 private:
  void grade(Status status, grade::PairFaults& faults, const Pairs& truth) {
    if (status_ == Status::ok) status_ = status;
    Pairs found = sink_.gather();
    faults = grade::check_pairs(found, truth, before_);
  }

  BroadPhase* algorithm_;
  PairSink sink_;
  Pairs told_, told_awake_;
  std::span<const Aabb> before_;
  std::uint32_t frame_ = 0;
  Status status_ = Status::ok;
};

FoundInScene play(const BroadPhaseEntry& entry, const BoxScene& scene) {
  Executor executor(threads);
  const std::unique_ptr<BroadPhase> algorithm = entry.make(executor);
  Asked asked(*algorithm);
  FoundInScene found;
  std::span<const Aabb> before;
  for (const std::vector<Aabb>& boxes : scene.frames) {
    const Change change(before, boxes);
    std::vector<std::uint32_t> fresh;
    std::ranges::merge(change.moved, change.inserted, std::back_inserter(fresh));
    if (before.empty()) {
      algorithm->build(boxes);
    } else {
      algorithm->update({boxes, change.moved, change.inserted, change.removed});
    }
    found.status = asked.ask(boxes, before, fresh, found.faults[found.frames]);
    if (found.status != Status::ok) return found;
    ++found.frames;
    before = boxes;
  }
  return found;
}

}  // namespace

Pairs pairs_of(std::span<const std::uint32_t> bodies, const Pairs& pairs) {
  Pairs some;
  std::ranges::copy_if(pairs, std::back_inserter(some), [&](const IndexPair& pair) {
    return std::ranges::binary_search(bodies, pair.a) || std::ranges::binary_search(bodies, pair.b);
  });
  return some;
}

Pairs without(const Pairs& from, const Pairs& what) {
  Pairs rest;
  std::ranges::set_difference(from, what, std::back_inserter(rest));
  return rest;
}

bool FrameFaults::none() const { return words().empty(); }

std::string FrameFaults::words() const {
  std::string text;
  const auto add = [&](std::string_view question, const grade::PairFaults& faults) {
    if (faults.none()) return;
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", question, to_string(faults));
  };
  add("", pairs);
  add("of the moved: ", moved);
  add("of the awake: ", awake);
  add("began: ", began);
  add("ended: ", ended);
  add("began of the awake: ", awake_began);
  add("ended of the awake: ", awake_ended);
  return text;
}

bool BroadCheck::good() const {
  return status == Status::ok && std::ranges::all_of(frames, &FrameFaults::none);
}

std::string BroadCheck::faults() const {
  if (status != Status::ok) return failure.empty() ? std::string(to_string(status)) : failure;
  std::string text;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].none()) continue;
    text += fmt::format("{}frame {}: {}", text.empty() ? "" : "; ", i, frames[i].words());
  }
  return text;
}

std::vector<BroadCheck> check_broad_phases(std::span<const BroadPhaseEntry* const> entries,
                                           std::span<const BoxScene> scenes, double time_limit) {
  std::vector<BroadCheck> checks;
  for (const BroadPhaseEntry* entry : entries) {
    const auto played = process::isolated_answers<FoundInScene>(
        scenes.size(), {.item_seconds = time_limit},
        [&] { return [&](std::size_t i) { return play(*entry, scenes[i]); }; });
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      BroadCheck check;
      check.entry = entry;
      check.scene = &scenes[i];
      for (const std::vector<Aabb>& boxes : scenes[i].frames) {
        check.pairs += static_cast<std::int64_t>(true_pairs(boxes).size());
      }
      const FoundInScene& found = played.answers[i];
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

BoxChecker::BoxChecker(const CheckRequest& request) : mode_(request.mode), seed_(request.seed) {
  for (const Contestant& contestant : request.contestants) {
    if (contestant.kind == &box_kind()) entries_.push_back(&contestant.of<BroadPhaseEntry>());
  }
}

void BoxChecker::finish() {
  if (mode_ != CheckMode::cases || entries_.empty()) return;
  constexpr double seconds_of_a_scene = 20;
  scenes_ = box_scenes(seed_);
  checks_ = check_broad_phases(entries_, scenes_, seconds_of_a_scene);
}

std::vector<std::string> BoxChecker::ours_wrong() const {
  std::vector<std::string> lines;
  for (const BroadCheck& check : checks_) {
    if (check.good() || !is_answerable(check.entry->info.origin)) continue;
    lines.push_back(fmt::format("{} on boxes '{}', seed {}: {}", check.entry->info.name,
                                check.scene->name, seed_, check.faults()));
  }
  return lines;
}

std::string BoxChecker::text(std::size_t /*page_width*/) const {
  if (entries_.empty()) return "";
  if (mode_ != CheckMode::cases) {
    return fmt::format(
        "\nNot asked: {} of the kind box, whose scenes have no axes and are not counted; "
        "`touchstone "
        "check --kind box` checks them.\n",
        entries_.size());
  }
  std::string wrong;
  for (const BroadPhaseEntry* entry : entries_) {
    std::string scenes;
    for (const BroadCheck& check : checks_) {
      if (check.entry != entry || check.good()) continue;
      scenes += (scenes.empty() ? "" : ", ") + check.scene->name;
    }
    if (scenes.empty() || is_answerable(entry->info.origin)) continue;
    wrong += fmt::format("  {} is wrong on: {}\n", entry->info.name, scenes);
  }
  return sum() + wrong;
}

std::string BoxChecker::sum() const {
  std::int64_t pairs = 0;
  std::set<const BroadPhaseEntry*> wrong;
  for (const BroadCheck& check : checks_) {
    if (check.entry == entries_.front()) pairs += check.pairs;
    if (!check.good()) wrong.insert(check.entry);
  }
  return fmt::format("{} of {} broad phases find all pairs of all {} box scenes ({} pairs).\n",
                     entries_.size() - wrong.size(), entries_.size(), scenes_.size(), pairs);
}

std::string BoxChecker::page(const std::string& /*pictures*/) const {
  if (checks_.empty()) return "";
  base::Table table({"algorithm", "scenes", "wrong", "first fault"}, 4);
  for (const BroadPhaseEntry* entry : entries_) {
    int wrong = 0;
    std::string first;
    for (const BroadCheck& check : checks_) {
      if (check.entry != entry || check.good() || wrong++ > 0) continue;
      const std::string faults = check.faults();
      first = fmt::format("{}: {}", check.scene->name, faults.substr(0, faults.find(';')));
    }
    table.add({entry->info.name, std::to_string(scenes_.size()), std::to_string(wrong), first});
  }
  return "\n## Broad phases\n\nAgainst every pair of closed boxes, on scenes that touch, coincide, "
         "have no volume, or are huge, tiny or far away.\n\n" +
         table.markdown() + '\n' + sum();
}

}  // namespace touchstone::kinds
