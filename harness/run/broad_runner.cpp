#include "harness/run/broad_runner.h"

#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <numeric>

#include "harness/io/box_frames.h"
#include "harness/run/clock.h"
#include "harness/run/pair_hash.h"

namespace touchstone {

std::string RunContext::place(int frame) const {
  return fmt::format("{}, {} bodies, frame {}", scene->name, scene->size(), frame);
}

BroadRunner::BroadRunner(const RunContext& context, Executor& executor) : context_(context) {
  reference_ = find_broad_phase("naive")->make(executor);
  for (const BroadPhaseEntry* entry : context.block->group->broad) {
    contestants_.push_back({entry, entry->make(executor), {}, false});
  }
}

std::vector<IndexPair> BroadRunner::truth(std::span<const Aabb> boxes) {
  PairSink sink;
  reference_->build(boxes);
  reference_->find_pairs(sink);
  std::vector<IndexPair> pairs = sink.gather();
  std::ranges::sort(pairs);
  return pairs;
}

void BroadRunner::run_frame(const ScenePlayer& player, std::span<const IndexPair> truth,
                            std::span<const Aabb> before, std::mt19937_64& shuffle) {
  std::vector<std::size_t> order(contestants_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::shuffle(order, shuffle);
  found_.clear();
  for (const std::size_t i : order) {
    if (!contestants_[i].out) run(contestants_[i], player, truth, before);
  }
}

void BroadRunner::run(Contestant& contestant, const ScenePlayer& player,
                      std::span<const IndexPair> truth, std::span<const Aabb> before) {
  const bool build = before.empty() || context_.block->group->rebuild;
  RawRow prepare = context_.row(player.frame());
  prepare.broad = contestant.entry->info.name;
  prepare.phase = build ? Phase::build : Phase::update;
  prepare.status = to_string(Status::ok);
  RawRow query = prepare;
  query.phase = Phase::find_pairs;

  const auto leave = [&](const std::string& why, bool too_slow) {
    contestant.out = true;
    context_.findings->add(Departure{.algorithm = contestant.entry->info.name,
                                     .ours = contestant.entry->info.origin == Origin::ours,
                                     .known = too_slow,
                                     .where = context_.place(player.frame()),
                                     .what = why + "; left out from here on",
                                     .reproduction = ""});
  };
  try {
    const Stopwatch preparing;
    if (build) {
      contestant.algorithm->build(player.boxes());
    } else {
      contestant.algorithm->update(player.change());
    }
    prepare.seconds = preparing.seconds();
    const Stopwatch finding;
    const Status status = contestant.algorithm->find_pairs(contestant.sink);
    query.seconds = finding.seconds();
    query.status = to_string(status);
  } catch (const std::exception& error) {
    query.status = to_string(Status::crashed);
    context_.findings->add(query);
    leave(fmt::format("threw: {}", error.what()), false);
    return;
  }
  std::vector<IndexPair> pairs = contestant.sink.gather();
  query.pair_count = static_cast<std::int64_t>(pairs.size());
  query.pair_hash = to_hex(pair_hash(pairs));
  check(contestant, player, pairs, truth, before);
  const double seconds = prepare.seconds + query.seconds;
  context_.findings->add(std::move(prepare));
  context_.findings->add(std::move(query));
  found_.push_back({contestant.entry, std::move(pairs)});
  if (seconds > context_.block->group->time_limit) {
    RawRow row = context_.row(player.frame());
    row.broad = contestant.entry->info.name;
    row.phase = Phase::find_pairs;
    row.status = to_string(Status::timed_out);
    context_.findings->add(std::move(row));
    leave(fmt::format("{:.1f} s for a frame, over the limit of {:g} s", seconds,
                      context_.block->group->time_limit),
          true);
  }
}

void BroadRunner::check(const Contestant& contestant, const ScenePlayer& player,
                        std::vector<IndexPair> pairs, std::span<const IndexPair> truth,
                        std::span<const Aabb> before) {
  const AlgorithmInfo& info = contestant.entry->info;
  const std::string hash = to_hex(pair_hash(pairs));
  const PairFaults faults = check_pairs(pairs, truth, before);
  Departure departure{.algorithm = info.name,
                      .ours = info.origin == Origin::ours,
                      .known = !info.known_defect.empty(),
                      .where = context_.place(player.frame()),
                      .what = "",
                      .reproduction = ""};
  if (!faults.none()) {
    departure.what = to_string(faults);
    if (departure.known) departure.what += "; known defect: " + info.known_defect;
    const std::filesystem::path file =
        context_.reproductions / fmt::format("{}-{}-{}-frame-{}.csv", info.name,
                                             context_.scene->name, context_.scene->size(),
                                             player.frame());
    // The frame before comes too: an update may be what went wrong.
    std::vector<std::vector<Aabb>> frames;
    if (!before.empty()) frames.emplace_back(before.begin(), before.end());
    frames.emplace_back(player.boxes().begin(), player.boxes().end());
    std::filesystem::create_directories(context_.reproductions);
    write_box_frames(frames, file);
    departure.reproduction = file.string();
    context_.findings->add(departure);
  }
  const std::string key =
      fmt::format("{}|{}|{}|{}|{}", info.name, context_.scene_hash, context_.block->group->rebuild,
                  to_string(context_.block->boxes), player.frame());
  if (!context_.findings->same_at_every_width(key, hash)) {
    departure.known = false;
    departure.what = "another pair set than at another number of threads";
    context_.findings->add(departure);
  }
}

}  // namespace touchstone
