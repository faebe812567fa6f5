// Solves every pair in child processes and compares the outcomes with the oracle's.
#include "harness/campaign/check_narrow.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "harness/campaign/check_pass.h"
#include "harness/files/cases.h"
#include "harness/files/text_file.h"
#include "harness/measure/narrow_sampler.h"

namespace touchstone::campaign {
namespace {

constexpr std::size_t outcomes_at_once = 250'000;  // a number that takes about 50 MB
// seconds of a batch; a slower one counts no allocations
constexpr double longest_batch_to_count = 10;

// The child's sums over one piece; the outcomes themselves are in shared memory.
struct NarrowAnswer {
  double seconds = 0;
  std::uint64_t outcome_hash = 0;
  std::int64_t contacts = 0, part_pairs = -1, iterations = -1, support_calls = -1;
};

// The task by which numbers are graded.
Task number_of(record::QueryTask task) {
  return record::narrow_task(task).value_or(Task::intersect);
}

Status status_of(const grade::OutcomeFaults& faults, Origin origin) {
  if (faults.failed > 0) return Status::not_converged;
  return is_answerable(origin) ? Status::ok : Status::not_reported;
}

}  // namespace

measure::SampleRequest NarrowCheck::request(const Piece& piece) {
  return {.set = static_cast<std::uint32_t>(piece.set),
          .frame = static_cast<std::uint32_t>(piece.frame)};
}

NarrowCheck::NarrowCheck(const RunContext& context, const measure::BlockInput& input,
                         std::span<const measure::NarrowSet> sets)
    : context_(&context), input_(&input), sets_(sets) {}

void NarrowCheck::run() {
  ExactAnswers oracle(*input_);
  Batch batch;
  const auto flush = [&] {
    for (const auto* choice : context_->block->group->choices()) run(batch, *choice);
    batch = {};
  };
  for (std::size_t frame = 0; frame < input_->frames.size(); ++frame) {
    // Sets with the same exact answers share them.
    std::map<std::string, std::size_t> known;
    for (std::size_t set = 0; set < sets_.size(); ++set) {
      const grade::PairGroup& pairs = sets_[set].frames[frame];
      if (pairs.size() == 0) continue;
      const auto [at, is_new] =
          known.try_emplace(ExactAnswers::key(sets_[set]), batch.references.size());
      if (is_new) batch.references.push_back(oracle.solve(sets_[set], frame));
      batch.pieces.push_back({set, frame, batch.outcomes, at->second});
      batch.outcomes += pairs.size();
    }
    if (batch.outcomes >= outcomes_at_once) flush();
  }
  flush();
}

record::RawRow NarrowCheck::row(const Piece& piece, const measure::NarrowChoice& choice) const {
  const measure::NarrowSet& set = sets_[piece.set];
  record::RawRow result = context_->row(piece.frame, choice);
  result.broad = set.broad;
  result.task = set.task;
  result.pair_kind = set.kind_name();
  return result;
}

void NarrowCheck::run(const Batch& batch, const measure::NarrowChoice& choice) {
  std::vector<Piece> pieces;
  for (const Piece& piece : batch.pieces) {
    const measure::NarrowSet& set = sets_[piece.set];
    const measure::Offer offered = offer(choice, set, *input_);
    if (offered == measure::Offer::none || out_.contains({&choice, piece.set}) ||
        !context_->admits(choice, set.broad, set.task, set.kind_name()))
      continue;
    if (offered == measure::Offer::taken) {
      pieces.push_back(piece);
      continue;
    }
    record::RawRow unsupported = row(piece, choice);
    unsupported.pair_count = static_cast<std::int64_t>(group(piece).size());
    unsupported.status = record::RowStatus::unsupported;
    context_->findings->add(std::move(unsupported));
  }
  if (pieces.empty()) return;

  const CampaignGroup& settings = *context_->block->group;
  process::SharedArray<Outcome> outcomes(batch.outcomes);
  process::SharedArray<grade::PartList> lists(batch.outcomes);
  process::SharedArray<NarrowAnswer> answers(pieces.size());
  process::SharedArray<char> lost(
      sets_.size());  // 1 while the set is being solved; it stays if that kills the child
  const process::IsolationLimits limits = {.item_seconds = settings.time_limit,
                                           .memory = settings.memory_limit};
  const process::IsolationReport report =
      process::isolate(pieces.size(), limits, [&]() -> process::ItemWork {
        const auto executor = std::make_shared<Executor>(1);
        const auto sampler =
            std::make_shared<measure::NarrowSampler>(choice, *input_, sets_, *executor);
        return [&, executor, sampler](std::size_t item) {
          const Piece& piece = pieces[item];
          if (lost[piece.set] != 0) return;
          lost[piece.set] = 1;
          const measure::SampleReply reply = sampler->sample(request(piece));
          answers[item] = {reply.durations.sum(), reply.outcome_hash, reply.contacts,
                           reply.part_pairs,      reply.iterations,   reply.support_calls};
          std::ranges::copy(sampler->outcomes(),
                            outcomes.span().begin() + static_cast<std::ptrdiff_t>(piece.first));
          std::ranges::copy(sampler->lists(),
                            lists.span().begin() + static_cast<std::ptrdiff_t>(piece.first));
          lost[piece.set] = 0;
        };
      });

  double seconds = 0;
  for (const NarrowAnswer& answer : answers.span()) seconds += answer.seconds;
  std::vector<measure::Allocations> allocations(pieces.size());
  if (context_->counts_allocations && is_timed(choice.info()) && report.failures.empty() &&
      seconds < longest_batch_to_count) {
    allocations = count_allocations(pieces, choice, limits);
  }
  auto failure = report.failures.begin();
  for (std::size_t item = 0; item < pieces.size(); ++item) {
    const Piece& piece = pieces[item];
    const Key key{&choice, piece.set};
    if (out_.contains(key)) continue;
    const auto& reference = batch.references[piece.reference];
    if (report.states[item] != process::ItemState::done) {
      // A child whose setup failed reports one failure for all remaining pieces.
      while (failure + 1 < report.failures.end() && failure->item < item) ++failure;
      out_.insert(key);
      lose(piece, choice, reference, status_of(report.states[item]), failure->words);
      continue;
    }
    const NarrowAnswer& answer = answers[item];
    record::RawRow result = row(piece, choice);
    if (is_timed(choice.info())) result.seconds = answer.seconds;
    result.contact_count = answer.contacts;
    result.outcome_hash = base::to_hex(answer.outcome_hash);
    result.part_pairs = answer.part_pairs;
    result.iterations = answer.iterations;
    result.support_calls = answer.support_calls;
    result.allocations = allocations[item].calls;
    result.allocated_bytes = allocations[item].bytes;
    const std::size_t size = group(piece).size();
    const bool listed = sets_[piece.set].task == record::QueryTask::contacts;
    take(piece, choice, outcomes.span().subspan(piece.first, size),
         lists.span().subspan(piece.first, listed ? size : 0), reference, std::move(result));
  }
}

std::vector<measure::Allocations> NarrowCheck::count_allocations(
    std::span<const Piece> pieces, const measure::NarrowChoice& choice,
    process::IsolationLimits limits) const {
  limits.failures = 1;
  process::SharedArray<measure::Allocations> counts(pieces.size());
  if (measure::can_count_allocations()) {
    process::isolate(pieces.size(), limits, [&]() -> process::ItemWork {
      const auto executor = std::make_shared<Executor>(1);
      const auto sampler =
          std::make_shared<measure::NarrowSampler>(choice, *input_, sets_, *executor);
      return [&, executor, sampler](std::size_t item) {
        sampler->sample(request(pieces[item]));
        counts[item] = sampler->count_allocations(request(pieces[item]));
      };
    });
  }
  return {counts.span().begin(), counts.span().end()};
}

void NarrowCheck::take(const Piece& piece, const measure::NarrowChoice& choice,
                       std::span<const Outcome> outcomes, std::span<const grade::PartList> lists,
                       const std::vector<grade::ReferenceOutcome>& reference,
                       record::RawRow result) {
  const grade::OutcomeFaults faults = grade::check_outcomes(
      outcomes, reference, number_of(sets_[piece.set].task), choice.settings.scalar, lists);
  result.pair_count = static_cast<std::int64_t>(outcomes.size());
  result.pair_hash = base::to_hex(measure::group_hash(group(piece)));
  if (result.iterations >= 0) {
    result.iterations_squared = 0;
    for (const Outcome& outcome : outcomes) {
      const std::int64_t n = std::max(outcome.iterations, 0);
      result.iterations_squared += n * n;
    }
  }
  result.compared = faults.compared;
  result.disagreements = faults.disagree;
  result.worst_disagreement = faults.worst;
  if (faults.values > 0) result.worst_error = faults.worst_value_error;
  result.failures = faults.failed + faults.unanswered;
  result.status = record::row_status(status_of(faults, choice.info().origin));
  context_->findings->add(std::move(result));
  if (faults.disagree > 0) report(piece, choice, faults);
}

process::SolveBatch NarrowCheck::solver(const measure::NarrowChoice& choice,
                                        const measure::NarrowSet& set) const {
  if (!set.is_concave()) {
    const std::shared_ptr<NarrowPhase> algorithm = choice.entry->make(choice.settings);
    algorithm->bind(input_->shapes);
    return [algorithm, task = *record::narrow_task(set.task)](const PairBatch& batch,
                                                              std::span<Outcome> outcomes) {
      algorithm->solve(task, batch, outcomes);
    };
  }
  const std::shared_ptr<ConcavePhase> algorithm = choice.make_concave(input_->bodies);
  return [this, algorithm, task = *record::concave_task(set.task)](const PairBatch& batch,
                                                                   std::span<Outcome> outcomes) {
    std::vector<IndexPair> pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = batch.pairs.first[i], b = batch.pairs.second[i];
      pairs.clear();
      algorithm->solve(task, {input_->shape_of[a], batch.pairs.poses[a]},
                       {input_->shape_of[b], batch.pairs.poses[b]}, outcomes[i], pairs);
    }
  };
}

void NarrowCheck::lose(const Piece& piece, const measure::NarrowChoice& choice,
                       const std::vector<grade::ReferenceOutcome>& reference, Status status,
                       const std::string& words) {
  const measure::NarrowSet& set = sets_[piece.set];
  std::vector<Outcome> outcomes(group(piece).size());
  const CampaignGroup& settings = *context_->block->group;
  process::solve_guarded([&] { return solver(choice, set); },
                         group(piece).batch(input_->shape_of, input_->frames[piece.frame].poses, 0,
                                            group(piece).size()),
                         outcomes, settings.time_limit, settings.memory_limit);
  grade::OutcomeFaults faults =
      grade::check_outcomes(outcomes, reference, number_of(set.task), choice.settings.scalar);
  const auto at = std::ranges::find_if(
      outcomes, [](const Outcome& outcome) { return process::is_lost(outcome.status); });
  if (at != outcomes.end()) {
    faults.worst_pair = static_cast<std::size_t>(at - outcomes.begin());
  } else {
    // Each pair alone is solved; only all of them together fail.
    (status == Status::crashed ? faults.crashed : faults.timed_out) =
        static_cast<std::int64_t>(outcomes.size());
    faults.worst_pair.reset();
  }
  record::RawRow result = row(piece, choice);
  result.pair_count = static_cast<std::int64_t>(outcomes.size());
  result.failures = faults.crashed + faults.timed_out;
  result.status = record::row_status(status);
  result.words = record::one_line(words);
  context_->findings->add(std::move(result));
  report(piece, choice, faults);
}

void NarrowCheck::report(const Piece& piece, const measure::NarrowChoice& choice,
                         const grade::OutcomeFaults& faults) {
  if (!reported_.insert({&choice, piece.set}).second) return;
  const AlgorithmInfo& info = choice.info();
  const measure::NarrowSet& set = sets_[piece.set];
  record::Departure departure =
      context_->departure(info, choice.label(),
                          fmt::format("{}, {}, {}", context_->place(piece.frame), set.kind_name(),
                                      to_string(set.task)));
  departure.known = departure.known || choice.is_approximate();
  if (faults.crashed > 0) {
    departure.what = fmt::format("{} of {} queries crashed", faults.crashed, group(piece).size());
  } else if (faults.timed_out > 0) {
    departure.what =
        fmt::format("{} of {} queries were not answered within {:g} s", faults.timed_out,
                    group(piece).size(), context_->block->group->time_limit);
  } else {
    const std::size_t i = *faults.worst_pair;
    departure.what =
        fmt::format("{} of {} answers differ from {}'s{} (bodies {} and {})", faults.disagree,
                    faults.compared, grade::Reference::name(),
                    set.is_concave() ? "" : fmt::format(", by up to {:.3g} m", faults.worst),
                    group(piece).first[i], group(piece).second[i]);
  }
  if (choice.is_approximate()) departure.what += "; approximate by design";
  if (choice.warm) departure.what += "; warm: the file has the bodies, not what was in memory";
  if (!info.known_defect.empty()) departure.what += "; known defect: " + info.known_defect;
  if (faults.worst_pair) write_case(piece, choice, *faults.worst_pair, departure);
  context_->findings->add(std::move(departure));
}

void NarrowCheck::write_case(const Piece& piece, const measure::NarrowChoice& choice,
                             std::size_t pair, record::Departure& departure) const {
  const std::uint32_t a = group(piece).first[pair];
  const std::uint32_t b = group(piece).second[pair];
  const std::vector<Pose>& poses = input_->frames[piece.frame].poses;
  const std::string place = fmt::format("frame-{}-{}-{}", piece.frame, a, b);
  const std::string id = fmt::format("{}-{}", context_->scene->name, place);
  const std::uint32_t shape_a = input_->shape_of[a], shape_b = input_->shape_of[b];
  const auto write = [&](const std::filesystem::path& file) {
    const std::string reproduction =
        sets_[piece.set].is_concave()
            ? files::to_json(files::ConcaveCase{id, input_->bodies[shape_a],
                                                input_->bodies[shape_b], poses[a], poses[b], false})
            : files::to_json(files::Case{id, input_->shapes[shape_a], input_->shapes[shape_b],
                                         poses[a], poses[b]});
    files::write_text(file, reproduction + "\n");
  };
  // The scene's name comes last, because it may be cut.
  write_reproduction(
      *context_,
      fmt::format("{}-{}{}-{}-{}-{}-{}", choice.name(), to_string(choice.settings.scalar),
                  choice.warm ? "-warm" : "", to_string(sets_[piece.set].task),
                  sets_[piece.set].kind_name(), place, context_->scene->name),
      ".jsonl", write, departure);
}

}  // namespace touchstone::campaign
