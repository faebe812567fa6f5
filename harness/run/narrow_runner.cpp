#include "harness/run/narrow_runner.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

#include "harness/error.h"
#include "harness/io/cases.h"
#include "harness/run/clock.h"
#include "harness/run/guarded_solve.h"
#include "harness/run/pair_hash.h"

namespace touchstone {
namespace {

// Pairs that one task of the executor answers: enough to hide the cost of handing it out, few
// enough to share a small group between two threads.
constexpr std::size_t pairs_a_task = 256;

// The same for every order of the pairs and every number of threads.
std::uint64_t outcome_hash(const PairGroup& group, std::span<const Outcome> outcomes) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    std::uint64_t hash = mix((std::uint64_t{group.first[i]} << 32) + group.second[i]);
    hash = mix(hash ^ (static_cast<std::uint64_t>(outcome.answer) << 8) ^
               static_cast<std::uint64_t>(outcome.status));
    // Every NaN counts as the same: it says that there is no number.
    if (!std::isnan(outcome.distance))
      hash = mix(hash ^ std::bit_cast<std::uint64_t>(outcome.distance));
    sum += hash;
  }
  return sum;
}

Status status_of(const OutcomeFaults& faults, Origin origin) {
  if (faults.failed > 0) return Status::not_converged;
  return origin == Origin::ours ? Status::ok : Status::not_reported;
}

}  // namespace

NarrowRunner::NarrowRunner(const RunContext& context, Executor& executor)
    : context_(context), executor_(&executor), reference_(context.scene->shapes, executor) {
  for (const Body& body : context.scene->bodies) shape_of_.push_back(body.shape);
  for (const NarrowChoice& choice : context.block->group->narrow) {
    Contestant contestant{choice,
                          narrow_label(choice.entry->info.name, to_string(choice.settings.scalar),
                                       choice.settings.tolerance.value_or(Outcome::none)),
                          {}};
    for (int worker = 0; worker < executor.width(); ++worker) {
      contestant.instances.push_back(choice.entry->make(choice.settings));
      contestant.instances.back()->bind(context.scene->shapes);
    }
    contestants_.push_back(std::move(contestant));
  }
}

void NarrowRunner::compare(int frame, std::span<const Pose> poses,
                           std::span<const IndexPair> pairs) {
  faults_.clear();
  for (const PairGroup& group : group_by_kind(pairs, context_.scene->shapes, shape_of_)) {
    const std::vector<ReferenceOutcome> reference = reference_.solve(group, shape_of_, poses);
    for (Contestant& contestant : contestants_) {
      for (const Task task : context_.block->group->tasks) {
        const Key key{contestant.label, task, group.name()};
        if (out_.contains(key) ||
            !offers(*contestant.choice.entry, group.kind_a, group.kind_b, task)) {
          continue;
        }
        const OutcomeFaults faults = compare(contestant, task, group, reference, frame, poses);
        faults_[key] = faults;
        context_.findings->add(contestant.label, task, group.name(), faults);
        if ((faults.disagree > 0 || faults.lost()) && reported_.insert(key).second) {
          report(contestant, task, group, faults, frame, poses);
        }
      }
    }
  }
}

OutcomeFaults NarrowRunner::compare(Contestant& contestant, Task task, const PairGroup& group,
                                    std::span<const ReferenceOutcome> reference, int frame,
                                    std::span<const Pose> poses) {
  const double limit = context_.block->group->time_limit;
  std::vector<Outcome> outcomes(group.size());
  const PairBatch batch = group.batch(task, shape_of_, poses, 0, group.size());
  NarrowPhase& algorithm = *contestant.instances.front();
  const Stopwatch watch;
  if (contestant.info().origin == Origin::peer) {
    solve_guarded(algorithm, batch, outcomes, limit);
  } else {
    algorithm.solve(batch, outcomes);
  }
  OutcomeFaults faults =
      check_outcomes(outcomes, reference, task, contestant.choice.settings.scalar);
  if (faults.lost() || watch.seconds() > limit) {
    out_.insert({contestant.label, task, group.name()});
    RawRow row = context_.row(frame);
    row.narrow = contestant.info().name;
    row.scalar = to_string(contestant.choice.settings.scalar);
    row.task = to_string(task);
    row.pair_kind = group.name();
    row.phase = Phase::narrow;
    row.status = to_string(faults.crashed > 0 ? Status::crashed : Status::timed_out);
    context_.findings->add(std::move(row));
    if (faults.lost() && !faults.worst_pair) {
      const auto lost = std::ranges::find_if(outcomes, [](const Outcome& outcome) {
        return outcome.status == Status::crashed || outcome.status == Status::timed_out;
      });
      faults.worst_pair = static_cast<std::size_t>(lost - outcomes.begin());
    }
  }
  return faults;
}

void NarrowRunner::report(const Contestant& contestant, Task task, const PairGroup& group,
                          const OutcomeFaults& faults, int frame, std::span<const Pose> poses) {
  Departure departure{
      .algorithm = contestant.label,
      .ours = contestant.info().origin == Origin::ours,
      .known = contestant.choice.entry->approximate || !contestant.info().known_defect.empty(),
      .where = fmt::format("{}, {}, {}", context_.place(frame), group.name(), to_string(task)),
      .what = "",
      .reproduction = ""};
  if (faults.crashed > 0) {
    departure.what = fmt::format("{} of {} queries crashed", faults.crashed, group.size());
  } else if (faults.timed_out > 0) {
    departure.what = fmt::format("{} of {} queries were not answered within {:g} s",
                                 faults.timed_out, group.size(), context_.block->group->time_limit);
  } else {
    const std::size_t i = *faults.worst_pair;
    departure.what = fmt::format(
        "{} of {} answers differ from {}'s, by up to {:.3g} m (bodies {} and {})", faults.disagree,
        faults.compared, Reference::name(), faults.worst, group.first[i], group.second[i]);
  }
  if (contestant.choice.entry->approximate) departure.what += "; approximate by design";
  if (!contestant.info().known_defect.empty()) {
    departure.what += "; known defect: " + contestant.info().known_defect;
  }
  if (faults.worst_pair) {
    departure.reproduction = write_case(contestant, task, group, *faults.worst_pair, frame, poses);
  }
  context_.findings->add(std::move(departure));
}

void NarrowRunner::time(int frame, std::span<const Pose> poses, std::span<const IndexPair> pairs,
                        const std::string& broad, std::mt19937_64& shuffle) {
  const std::vector<PairGroup> groups = group_by_kind(pairs, context_.scene->shapes, shape_of_);
  std::vector<std::pair<std::size_t, Task>> order;
  for (std::size_t i = 0; i < contestants_.size(); ++i) {
    for (const Task task : context_.block->group->tasks) {
      if (offers(*contestants_[i].choice.entry, task)) order.emplace_back(i, task);
    }
  }
  std::ranges::shuffle(order, shuffle);
  for (const auto& [i, task] : order) {
    for (const PairGroup& group : groups) {
      if (!out_.contains({contestants_[i].label, task, group.name()})) {
        time(contestants_[i], task, group, frame, poses, broad);
      }
    }
  }
}

void NarrowRunner::time(Contestant& contestant, Task task, const PairGroup& group, int frame,
                        std::span<const Pose> poses, const std::string& broad) {
  RawRow row = context_.row(frame);
  row.broad = broad;
  row.narrow = contestant.info().name;
  row.scalar = to_string(contestant.choice.settings.scalar);
  row.task = to_string(task);
  if (contestant.choice.settings.tolerance) row.tolerance = *contestant.choice.settings.tolerance;
  row.pair_kind = group.name();
  row.phase = Phase::narrow;
  row.pair_count = static_cast<std::int64_t>(group.size());
  if (!offers(*contestant.choice.entry, group.kind_a, group.kind_b, task)) {
    row.status = to_string(Status::unsupported);
    context_.findings->add(std::move(row));
    return;
  }
  outcomes_.assign(group.size(), Outcome{});
  const std::size_t tasks = (group.size() + pairs_a_task - 1) / pairs_a_task;
  const Stopwatch watch;
  executor_->run(tasks, [&](std::size_t chunk, int worker) {
    const std::size_t begin = chunk * pairs_a_task;
    const std::size_t end = std::min(begin + pairs_a_task, group.size());
    contestant.instances[static_cast<std::size_t>(worker)]->solve(
        group.batch(task, shape_of_, poses, begin, end),
        std::span(outcomes_).subspan(begin, end - begin));
  });
  row.seconds = watch.seconds();
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < group.size(); ++i) {
    pairs.push_back(
        {std::min(group.first[i], group.second[i]), std::max(group.first[i], group.second[i])});
  }
  row.pair_hash = to_hex(pair_hash(pairs));
  row.contact_count = std::ranges::count_if(outcomes_, [](const Outcome& outcome) {
    return outcome.answer == Answer::touching || outcome.answer == Answer::overlapping;
  });
  row.outcome_hash = to_hex(outcome_hash(group, outcomes_));
  const auto found = faults_.find({contestant.label, task, group.name()});
  if (found != faults_.end()) {
    const OutcomeFaults& faults = found->second;
    row.disagreements = faults.disagree;
    row.worst_disagreement = faults.worst;
    row.failures = faults.failed + faults.unanswered;
    row.status = to_string(status_of(faults, contestant.info().origin));
  }
  const std::string tolerance = std::isnan(row.tolerance) ? "" : fmt::format("{}", row.tolerance);
  const std::string key = fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}", contestant.label, tolerance,
                                      to_string(task), broad, context_.scene_hash, row.boxes,
                                      context_.block->group->rebuild, frame, group.name());
  if (!context_.findings->same_at_every_width(key, row.pair_hash + row.outcome_hash)) {
    context_.findings->add(Departure{
        .algorithm = contestant.label,
        .ours = contestant.info().origin == Origin::ours,
        .known = false,
        .where = fmt::format("{}, {}, {}", context_.place(frame), group.name(), to_string(task)),
        .what = "other outcomes than at another number of threads",
        .reproduction = ""});
  }
  context_.findings->add(std::move(row));
}

std::string NarrowRunner::write_case(const Contestant& contestant, Task task,
                                     const PairGroup& group, std::size_t pair, int frame,
                                     std::span<const Pose> poses) const {
  const std::uint32_t a = group.first[pair];
  const std::uint32_t b = group.second[pair];
  const Case reproduction{.id = fmt::format("{}-frame-{}-{}-{}", context_.scene->name, frame, a, b),
                          .shape_a = context_.scene->shapes[shape_of_[a]],
                          .shape_b = context_.scene->shapes[shape_of_[b]],
                          .pose_a = poses[a],
                          .pose_b = poses[b]};
  const std::filesystem::path file =
      context_.reproductions / fmt::format("{}-{}-{}-{}-{}.jsonl", contestant.info().name,
                                           to_string(contestant.choice.settings.scalar),
                                           to_string(task), group.name(), reproduction.id);
  std::filesystem::create_directories(context_.reproductions);
  std::ofstream stream(file);
  stream << to_json(reproduction) << '\n';
  stream.flush();
  if (!stream) throw InputError(file.string(), 0, "cannot be written");
  return file.string();
}

}  // namespace touchstone
