// Plays a broad phase in a child process and compares its pairs with the true ones.
#include "harness/campaign/check_broad.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "harness/base/hash.h"
#include "harness/campaign/check_pass.h"
#include "harness/grade/answer_check.h"
#include "harness/measure/noise.h"
#include "harness/measure/phase_samplers.h"
#include "harness/process/isolate.h"
#include "harness/scene/box_frames.h"

namespace touchstone::campaign {
namespace {

// An upper bound for a box or a pair: the frame's pairs are sorted and compared, its work is
// counted.
constexpr double seconds_to_verify = 5e-6;
constexpr double longest_grace = 2;  // seconds that other processes may take the processor for
// seconds of all frames; a slower pass counts no allocations
constexpr double longest_frame_to_count = 3;

// The child's result of one frame.
struct BroadAnswer {
  measure::SampleReply reply;
  grade::PairFaults faults;
  std::size_t pairs_at = 0;  // an index into the array of all pairs, if pairs are kept
};

std::span<const Aabb> boxes_before(const measure::BlockInput& input, std::size_t frame) {
  return frame == 0 ? std::span<const Aabb>()
                    : std::span<const Aabb>(input.frames[frame - 1].boxes);
}

// Counts in a pass of its own, in a child of its own: the frames are played once to warm the
// algorithm up, and counted the second time, when its data from frame to frame exist. A failure
// here leaves counts out; the check reports failures.
std::vector<measure::BroadSampler::FrameAllocations> count_allocations(
    const measure::BlockInput& input, const BroadPhaseEntry& entry, bool rebuild,
    const process::IsolationLimits& limits) {
  const std::size_t count = input.frames.size();
  process::SharedArray<measure::BroadSampler::FrameAllocations> counts(count);
  if (measure::can_count_allocations()) {
    process::isolate(2 * count, limits, [&]() -> process::ItemWork {
      const auto executor = std::make_shared<Executor>(1);
      const auto sampler =
          std::make_shared<measure::BroadSampler>(entry, input, rebuild, *executor);
      return [&, executor, sampler](std::size_t item) {
        if (item < count) {
          sampler->play(item);
        } else {
          counts[item - count] = sampler->count_allocations(item - count);
        }
      };
    });
  }
  return {counts.span().begin(), counts.span().end()};
}

// Returns the reason to skip a broad phase, or an empty text. The time of a broad phase grows at
// least in proportion to the number of boxes, so one that was over its limit with fewer boxes of
// the same scene is over this limit too.
std::string already_too_slow(const RunContext& context, const BroadPhaseEntry& entry) {
  const record::RawRow here = context.row(0, entry, record::Phase::find_pairs);
  for (const record::RawRow& row : context.findings->rows()) {
    if (row.block < 0 || row.block >= context.number ||
        std::cmp_greater_equal(row.block, context.blocks.size()) ||
        row.kind != record::RowKind::check || row.process >= 0 || row.broad != here.broad ||
        !row.narrow.empty() || row.status != record::RowStatus::timed_out) {
      continue;
    }
    const Block& before = context.blocks[static_cast<std::size_t>(row.block)];
    if (before.scene_file != context.block->scene_file || row.boxes != here.boxes ||
        row.rebuild != here.rebuild || row.isa_limit != here.isa_limit ||
        row.bodies > here.bodies) {
      continue;
    }
    const double limit = before.group->time_limit;
    const double growth = static_cast<double>(here.bodies) / static_cast<double>(row.bodies);
    if (limit * growth < context.block->group->time_limit) continue;
    return fmt::format("not tried: over the limit of {:g} s with {} bodies", limit, row.bodies);
  }
  return "";
}

void write_frames(const RunContext& context, const measure::BlockInput& input,
                  const std::string& name, std::size_t frame, record::Departure& departure) {
  // The frame before is included, because an update may be the cause of the error.
  std::vector<std::vector<Aabb>> frames;
  if (frame > 0) frames.push_back(input.frames[frame - 1].boxes);
  frames.push_back(input.frames[frame].boxes);
  // The scene's name comes last, because it may be cut.
  write_reproduction(
      context,
      fmt::format("{}-{}-frame-{}-{}", name, context.scene->size(), frame, context.scene->name),
      ".csv", [&](const std::filesystem::path& file) { scene::write_box_frames(frames, file); },
      departure);
}

// Returns the seconds of a frame; a conversion that is timed again by itself is a part of the
// others.
double frame_seconds(const measure::SampleReply& reply) {
  const double conversion = reply.durations.of(to_string(record::Phase::convert));
  return reply.durations.sum() - (conversion >= 0 ? conversion : 0);
}

}  // namespace

CheckedBroad check_broad(const RunContext& context, const measure::BlockInput& input,
                         const BroadPhaseEntry& entry, bool with_pairs) {
  const CampaignGroup& group = *context.block->group;
  const std::size_t count = input.frames.size();
  CheckedBroad result;
  result.whole = result.right = true;
  const auto leave = [&](std::size_t frame, Status status, const std::string& why,
                         const std::string& words) {
    record::RawRow row = context.row(frame, entry, record::Phase::find_pairs);
    row.status = record::row_status(status);
    row.words = record::one_line(words);
    context.findings->add(std::move(row));
    record::Departure departure =
        context.departure(entry.info, entry.info.name, context.place(frame));
    departure.known = departure.known || status == Status::timed_out;
    departure.what = why + "; left out from here on";
    context.findings->add(std::move(departure));
    result.whole = result.right = false;
  };
  if (const std::string why = already_too_slow(context, entry); !why.empty()) {
    leave(0, Status::timed_out, why, why);
    return result;
  }
  std::size_t room = 0;  // far more than needed: memory that is not written to costs nothing
  for (const measure::BlockFrame& frame : input.frames) room += 4 * frame.truth.size() + 4096;
  process::SharedArray<BroadAnswer> answers(count);
  process::SharedArray<IndexPair> kept(with_pairs ? room : 0);
  process::SharedArray<std::size_t> too_slow(
      1);                    // 0: no frame is too slow, else the frame's number plus one
  std::size_t greatest = 0;  // the largest number of boxes and pairs of a frame
  for (const measure::BlockFrame& frame : input.frames) {
    greatest = std::max(greatest, frame.boxes.size() + frame.truth.size());
  }
  const double patience = group.time_limit + std::min(3 * group.time_limit, longest_grace) +
                          seconds_to_verify * static_cast<double>(greatest);
  const process::IsolationLimits limits = {
      .item_seconds = patience, .failures = 1, .memory = group.memory_limit};
  const process::IsolationReport report =
      process::isolate(count, limits, [&]() -> process::ItemWork {
        const auto executor = std::make_shared<Executor>(1);
        const auto sampler =
            std::make_shared<measure::BroadSampler>(entry, input, group.rebuild, *executor);

        return [&, executor, sampler](std::size_t frame) {
          if (too_slow[0] > 0) return;
          BroadAnswer& answer = answers[frame];
          const double waited_before = measure::run_delay().value_or(0);
          answer.reply = sampler->play(frame);
          const double waited = measure::run_delay().value_or(0) - waited_before;
          std::vector<IndexPair> pairs = sampler->sink().gather();
          if (with_pairs) {
            answer.pairs_at = frame == 0
                                  ? 0
                                  : answers[frame - 1].pairs_at +
                                        static_cast<std::size_t>(answers[frame - 1].reply.pairs);
            if (answer.pairs_at + pairs.size() > kept.size()) {
              throw std::runtime_error("more than four times as many pairs as there are");
            }
            std::ranges::copy(pairs,
                              kept.span().begin() + static_cast<std::ptrdiff_t>(answer.pairs_at));
          }
          answer.faults =
              grade::check_pairs(pairs, input.frames[frame].truth, boxes_before(input, frame));
          // Time in which other processes had the processor does not count.
          if (frame_seconds(answer.reply) - waited > group.time_limit) {
            too_slow[0] = frame + 1;
          }
        };
      });

  const bool to_the_end = report.failures.empty() && too_slow[0] == 0;
  double seconds = 0;
  for (const BroadAnswer& answer : answers.span()) {
    seconds += frame_seconds(answer.reply);
  }
  std::vector<measure::BroadSampler::FrameAllocations> allocations(count);
  if (context.counts_allocations && to_the_end && seconds < longest_frame_to_count) {
    allocations = count_allocations(input, entry, group.rebuild, limits);
  }
  for (std::size_t frame = 0; frame < count; ++frame) {
    if (report.states[frame] != process::ItemState::done) {
      const process::IsolationFailure& failure = report.failures.front();
      const bool late = failure.state == process::ItemState::timed_out;
      leave(frame, late ? Status::timed_out : Status::crashed,
            late ? fmt::format("no answer to a frame within the limit of {:g} s, over the limit",
                               group.time_limit)
                 : failure.reason(),
            failure.words);
      break;
    }
    const BroadAnswer& answer = answers[frame];
    const bool build = group.rebuild || frame == 0;
    const record::Phase phase = build ? record::Phase::build : record::Phase::update;
    record::RawRow prepare = context.row(frame, entry, phase);
    prepare.seconds = answer.reply.durations.of(to_string(phase));
    prepare.allocations = allocations[frame].prepare.calls;
    prepare.allocated_bytes = allocations[frame].prepare.bytes;
    record::RawRow query = context.row(frame, entry, record::Phase::find_pairs);
    query.seconds = answer.reply.durations.of(to_string(record::Phase::find_pairs));
    query.status = record::row_status(answer.reply.status);
    query.pair_count = answer.reply.pairs;
    query.pair_hash = base::to_hex(answer.reply.pair_hash);
    query.take(answer.reply.work);
    query.allocations = allocations[frame].query.calls;
    query.allocated_bytes = allocations[frame].query.bytes;
    if (!answer.faults.none() && entry.info.known_defect.empty())
      query.status = record::RowStatus::wrong;
    context.findings->add(std::move(prepare));
    const double conversion = answer.reply.durations.of(to_string(record::Phase::convert));
    if (conversion >= 0) {
      record::RawRow convert = context.row(frame, entry, record::Phase::convert);
      convert.seconds = conversion;
      context.findings->add(std::move(convert));
    }
    context.findings->add(std::move(query));
    if (!answer.faults.none()) {
      result.right = false;
      record::Departure departure =
          context.departure(entry.info, entry.info.name, context.place(frame));
      departure.what = to_string(answer.faults);
      if (departure.known) departure.what += "; known defect: " + entry.info.known_defect;
      write_frames(context, input, entry.info.name, frame, departure);
      context.findings->add(std::move(departure));
    }
    if (with_pairs) {
      const auto found =
          kept.span().subspan(answer.pairs_at, static_cast<std::size_t>(answer.reply.pairs));
      result.pairs.emplace_back(found.begin(), found.end());
    }
    if (too_slow[0] == frame + 1) {
      leave(frame, Status::timed_out,
            fmt::format("{:.1f} s for a frame, over the limit of {:g} s",
                        frame_seconds(answer.reply), group.time_limit),
            "");
      break;
    }
  }
  return result;
}

}  // namespace touchstone::campaign
