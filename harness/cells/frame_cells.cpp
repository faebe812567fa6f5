// Frames of broad phases of which most bodies rest: what a frame costs that asks for all pairs, for
// those that began and ended, or for those of the bodies that moved; and for all pairs of boxes that are built anew.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "algorithms/registry.h"
#include "harness/base/hash.h"
#include "harness/cells/read_cells.h"
#include "harness/grade/answer_check.h"
#include "harness/kinds/box/broad_check.h"
#include "harness/kinds/set_keys.h"
#include "harness/measure/block_input.h"

namespace touchstone::cells {
namespace {

enum class Question : std::uint8_t { pairs, changes, moved, built };
constexpr std::array<std::string_view, 4> question_names = {"pairs", "changes", "moved", "built"};

using kinds::Pairs;

// A frame, and how it differs from the frame that is played before it.
struct Frame {
  std::size_t boxes = 0;  // place of its boxes in FrameLoop::boxes
  std::vector<std::uint32_t> moved, inserted, removed, fresh;  // fresh: moved or inserted
};

// The frames of a scene, forward and back again to the first. Each is an update of the one before,
// and the loop can be played as often as one likes.
struct FrameLoop {
  std::vector<std::vector<Aabb>> boxes;
  std::vector<Pairs> truth;  // of the boxes
  std::vector<Frame> frames;

  FrameChange change(const Frame& frame) const {
    return {boxes[frame.boxes], frame.moved, frame.inserted, frame.removed};
  }
  std::span<const Aabb> boxes_before(std::size_t frame) const {
    return boxes[frames[(frame + frames.size() - 1) % frames.size()].boxes];
  }
  const Pairs& truth_of(std::size_t frame) const { return truth[frames[frame].boxes]; }
  const Pairs& truth_before(std::size_t frame) const {
    return truth_of((frame + frames.size() - 1) % frames.size());
  }
};

void add_frame(std::size_t boxes, const measure::BlockFrame& change, bool is_back,
               FrameLoop& loop) {
  Frame& frame = loop.frames.emplace_back();
  frame.boxes = boxes;
  frame.moved = change.moved;
  frame.inserted = is_back ? change.removed : change.inserted;
  frame.removed = is_back ? change.inserted : change.removed;
  std::ranges::merge(frame.moved, frame.inserted, std::back_inserter(frame.fresh));
}

FrameLoop make_loop(const scene::Scene& scene) {
  measure::BlockInput played(scene, scene::BoxKind::tight, false);
  FrameLoop loop;
  // An array of boxes never shrinks: on the way back those that have not come yet are empty.
  const std::size_t slots = played.frames.back().boxes.size();
  for (measure::BlockFrame& frame : played.frames) {
    loop.boxes.push_back(std::move(frame.boxes));
    loop.boxes.back().resize(slots, Aabb::empty());
    loop.truth.push_back(std::move(frame.truth));
  }
  for (std::size_t i = 1; i < played.frames.size(); ++i)
    add_frame(i, played.frames[i], false, loop);
  for (std::size_t i = played.frames.size(); i-- > 1;)
    add_frame(i - 1, played.frames[i], true, loop);
  return loop;
}

// A broad phase on a loop. It is made in the process that plays it, since threads do not survive
// a fork.
class LoopPlayer {
 public:
  LoopPlayer(const BroadPhaseEntry& entry, std::shared_ptr<const FrameLoop> loop, Question question,
             int threads)
      : entry_(&entry), loop_(std::move(loop)), question_(question), threads_(threads) {}

  void prepare() {
    algorithm_.reset();
    executor_ = std::make_unique<Executor>(threads_, Pinning::one_a_thread);
    algorithm_ = entry_->make(*executor_);
    algorithm_->build(loop_->boxes.front());
    // The first call of find_changes tells all pairs.
    ask(loop_->frames.back());
  }

  // Calls `visit(frame, status)` after each frame; sinks hold its answer.
  template <class Visit>
  void play(const Visit& visit) {
    for (std::size_t i = 0; i < loop_->frames.size(); ++i) {
      if (question_ == Question::built) {
        algorithm_->build(loop_->boxes[loop_->frames[i].boxes]);
      } else {
        algorithm_->update(loop_->change(loop_->frames[i]));
      }
      visit(i, ask(loop_->frames[i]));
    }
  }

  // Of the last frame's answer; it does not depend on the order of the pairs.
  std::uint64_t hash() const {
    const std::uint64_t pairs = base::pair_hash(pairs_.gather());
    return question_ == Question::changes ? pairs + base::mix(base::pair_hash(ended_.gather()))
                                          : pairs;
  }

  // Plays the loop once more, and holds every answer against the true pairs.
  kinds::TimedGrade grade() {
    kinds::TimedGrade grade;
    grade.hits = grade.true_hits = 0;
    play([&](std::size_t i, Status status) {
      if (status != Status::ok) {
        ++grade.gave_up;
        return;
      }
      const Pairs &now = loop_->truth_of(i), &before = loop_->truth_before(i);
      if (question_ == Question::changes) {
        add_faults(i, pairs_, kinds::without(now, before), grade);
        add_faults(i, ended_, kinds::without(before, now), grade);
      } else {
        add_faults(
            i, pairs_,
            question_ == Question::moved ? kinds::pairs_of(loop_->frames[i].fresh, now) : now,
            grade);
      }
    });
    return grade;
  }

 private:
  Status ask(const Frame& frame) {
    switch (question_) {
      case Question::pairs:
      case Question::built: return algorithm_->find_pairs(pairs_);
      case Question::changes: return algorithm_->find_changes(pairs_, ended_);
      case Question::moved: return algorithm_->find_pairs_of(frame.fresh, pairs_);
    }
    return Status::unsupported;
  }

  void add_faults(std::size_t i, const PairSink& sink, const Pairs& truth,
                  kinds::TimedGrade& grade) const {
    Pairs found = sink.gather();
    grade.hits += std::ssize(found);
    grade.true_hits += std::ssize(truth);
    const grade::PairFaults faults = grade::check_pairs(found, truth, loop_->boxes_before(i));
    grade.missed += faults.missing;
    grade.false_hits += faults.extra + faults.stale;
    grade.inexact += faults.duplicate;
  }

  const BroadPhaseEntry* entry_;
  std::shared_ptr<const FrameLoop> loop_;
  Question question_;
  int threads_;
  std::unique_ptr<Executor> executor_;
  std::unique_ptr<BroadPhase> algorithm_;
  PairSink pairs_, ended_;
};

kinds::TimedSet make_frame_cell(const std::shared_ptr<const FrameLoop>& loop, Question question,
                                int threads, const std::vector<const BroadPhaseEntry*>& entries) {
  kinds::TimedSet cell;
  cell.queries = cell.graded = static_cast<std::int64_t>(loop->frames.size());
  cell.truth = "all-pairs";
  for (const BroadPhaseEntry* entry : entries) {
    const auto player = std::make_shared<LoopPlayer>(*entry, loop, question, threads);
    cell.contestants.push_back({.name = entry->info.name,
                                .origin = entry->info.origin,
                                .approximate = !entry->info.known_defect.empty(),
                                .prepare = [=] { player->prepare(); },
                                .answer = [=] { player->play([](std::size_t, Status) {}); },
                                .grade = [=] { return player->grade(); },
                                .hash = [=] { return player->hash(); }});
  }
  return cell;
}

struct LoopSource {
  std::filesystem::path file;
  scene::SceneOverrides overrides;

  // What it is called in tables.
  std::string name() const {
    std::string text = file.stem().string();
    if (overrides.count != -1) text += fmt::format(", {} bodies", overrides.count);
    if (overrides.moving) text += fmt::format(", {:.6g} % moving", 100 * *overrides.moving);
    return text;
  }
};

// The loop of the last cell, which is made once for all cells of its source.
class LastLoop {
 public:
  std::shared_ptr<const FrameLoop> of(const LoopSource& source, std::size_t number) {
    if (loop_ == nullptr || number != number_) {
      loop_.reset();
      loop_ = std::make_shared<const FrameLoop>(
          make_loop(scene::load_scene(source.file, source.overrides)));
      number_ = number;
    }
    return loop_;
  }

 private:
  std::shared_ptr<const FrameLoop> loop_;
  std::size_t number_ = 0;
};

// Checks that the file is a scene of several frames whose boxes are all that matters.
void check_source(files::TomlTable& table, const LoopSource& source) {
  const scene::Scene scene = scene::load_scene(source.file, source.overrides);
  if (!scene.pairs.empty()) {
    table.fail("scenes", fmt::format("{} lists its pairs; expected a scene whose pairs are those "
                                     "of boxes that overlap",
                                     source.file.string()));
  }
  if (scene.frames < 2) {
    table.fail("scenes", fmt::format("{} has one frame; expected two or more, or the key `frames`",
                                     source.file.string()));
  }
}

std::vector<LoopSource> read_sources(files::TomlTable& table, const std::filesystem::path& home) {
  std::vector<std::optional<double>> shares;
  for (const double share : kinds::listed_numbers(table, "moving", 0, 1, "shares of the bodies"))
    shares.emplace_back(share);
  if (shares.empty()) shares.emplace_back();
  const auto frames = static_cast<int>(table.integer("frames", 2, 1'000'000, -1));
  const std::vector<std::int64_t> counts = table.integers("counts", 1, 100'000'000, -1);
  // What is wrong with a scene is so at its least or its greatest count.
  const auto [least, most] = std::ranges::minmax(counts);
  std::vector<LoopSource> sources;
  for (const std::string& file : table.texts("scenes", {})) {
    for (const std::int64_t count : counts) {
      for (const std::optional<double> share : shares) {
        sources.push_back({home / file, {.count = count, .frames = frames, .moving = share}});
        const bool is_first = share == shares.front();
        if (count == least || (is_first && count == most)) check_source(table, sources.back());
      }
    }
  }
  if (sources.empty()) table.fail("scenes", "missing; expected files of scenes");
  return sources;
}

}  // namespace

std::vector<kinds::PlannedSet> frame_cells(files::TomlTable& table,
                                           const std::filesystem::path& home) {
  const std::vector<LoopSource> sources = read_sources(table, home);
  const std::vector<std::int64_t> threads = table.integers("threads", 1, 1024, 1);
  const std::vector<std::size_t> questions = kinds::choices(table, "asks", question_names);
  const auto entries = kinds::selected(table, registry::entries<BroadPhaseEntry>(), "broad phase");
  const auto last = std::make_shared<LastLoop>();
  std::vector<kinds::PlannedSet> cells;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (const std::size_t question : questions) {
      for (const std::int64_t width : threads) {
        const std::string name = fmt::format("{}{}", question_names[question],
                                             width > 1 ? fmt::format(", {} threads", width) : "");
        const auto make = [=, source = sources[i]] {
          return make_frame_cell(last->of(source, i), static_cast<Question>(question),
                                 static_cast<int>(width), entries);
        };
        cells.push_back(
            {sources[i].name(), name, make, width != threads.front(), static_cast<int>(width)});
      }
    }
  }
  return cells;
}

}  // namespace touchstone::cells
