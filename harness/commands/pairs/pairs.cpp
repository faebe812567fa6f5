// touchstone pairs: runs broad phases on the boxes of a file, frame by frame.
// It writes a row for each frame and algorithm.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/hash.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/pairs/contender.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/kinds/selection.h"
#include "harness/scene/box_frames.h"

namespace touchstone::commands {
namespace {

void write_row(files::CsvWriter& csv, const scene::BoxFrame& frame, const Contender& contender,
               const PairsResult& result, int threads) {
  csv.field(frame.number).field(contender.name()).field(threads).field(to_string(result.status));
  if (result.known) {
    csv.field(result.pairs).field(base::to_hex(result.hash)).field(result.seconds);
  } else {
    csv.field("").field("").field("");
  }
  csv.end_row();
}

void print_summary(std::span<const std::unique_ptr<Contender>> contenders, std::size_t frames) {
  fmt::print("{:<28} {:>7} {:>12} {:>12}  {}\n", "algorithm", "frames", "pairs", "seconds",
             "frames that differ from the first's");
  for (const auto& contender : contenders) {
    std::size_t done = 0, pairs = 0, differing = 0;
    double seconds = 0;
    for (std::size_t i = 0; i < frames; ++i) {
      const PairsResult& result = contender->result(i);
      const PairsResult& first = contenders.front()->result(i);
      done += result.known ? 1 : 0;
      pairs += result.pairs;
      seconds += result.seconds;
      differing += result.known && first.known && result.hash != first.hash ? 1 : 0;
    }
    fmt::print("{:<28} {:>7} {:>12} {:>12.6f}  {}\n", contender->name(), done, pairs, seconds,
               differing);
  }
}

// Writes the pairs of each frame and algorithm that `pairs_of` returns.
template <class PairsOf>
void write_pairs(const std::string& file, const std::vector<scene::BoxFrame>& frames,
                 std::span<const std::unique_ptr<Contender>> contenders, const PairsOf& pairs_of) {
  files::CsvWriter csv(file, {"frame", "algorithm", "a", "b"});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const auto& contender : contenders) {
      for (const IndexPair& pair : pairs_of(*contender, i)) {
        csv.field(frames[i].number).field(contender->name());
        csv.field(std::int64_t{pair.a}).field(std::int64_t{pair.b}).end_row();
      }
    }
  }
  csv.close();
}

void write_changes(const std::string& file, const std::vector<scene::BoxFrame>& frames,
                   std::span<const std::unique_ptr<Contender>> contenders) {
  files::CsvWriter csv(file, {"frame", "algorithm", "a", "b", "change"});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const auto& contender : contenders) {
      for (const bool have_begun : {true, false}) {
        for (const IndexPair& pair : contender->kept_changes(i, have_begun)) {
          csv.field(frames[i].number).field(contender->name());
          csv.field(std::int64_t{pair.a}).field(std::int64_t{pair.b});
          csv.field(have_begun ? "began" : "ended").end_row();
        }
      }
    }
  }
  csv.close();
}

// Reads the ids of the bodies at rest, and marks them.
std::vector<char> read_resting(const std::string& file,
                               const std::vector<scene::BoxFrame>& frames) {
  std::size_t slots = 0;
  for (const scene::BoxFrame& frame : frames) slots = std::max(slots, frame.boxes.size());
  std::vector<char> is_resting(slots, 0);
  files::CsvReader(file, {"id"}).read([&](const files::CsvReader::Row& row) {
    const std::int64_t id = row.integer(0);
    if (id < 0 || id >= static_cast<std::int64_t>(slots)) {
      row.fail(fmt::format("column id: found {}; expected the id of a box, 0 to {}", id,
                           slots - std::size_t{1}));
    }
    is_resting[static_cast<std::size_t>(id)] = 1;
  });
  return is_resting;
}

void pairs(const PairsOptions& options) {
  const auto entries = kinds::select(registry::entries<BroadPhaseEntry>(),
                                     kinds::split_names(options.broad), "broad phase");
  const std::vector<scene::BoxFrame> frames = scene::read_box_frames(options.file);
  const std::vector<char> is_resting =
      options.resting.empty() ? std::vector<char>{} : read_resting(options.resting, frames);
  files::check_outputs({{"FILE", options.file}, {"--resting", options.resting}},
                       {{"--out", options.out},
                        {"--pairs", options.pairs},
                        {"--changes", options.changes},
                        {"--moved", options.moved}});
  std::size_t rounded = 0;
  for (const scene::BoxFrame& frame : frames) rounded += frame.rounded;
  if (rounded > 0) {
    fmt::print(stderr, "{} coordinates are not floats, and were rounded outwards\n", rounded);
  }
  std::vector<std::unique_ptr<Contender>> contenders;
  contenders.reserve(entries.size());
  for (const BroadPhaseEntry* entry : entries) {
    contenders.push_back(std::make_unique<Contender>(*entry, frames, options, is_resting));
    contenders.back()->run();
  }
  files::CsvWriter csv(options.out, {"frame", "algorithm", "threads", "status", "pair_count",
                                     "pair_hash", "seconds"});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const auto& contender : contenders) {
      write_row(csv, frames[i], *contender, contender->result(i), options.threads);
    }
  }
  csv.flush();  // reveals a full disk before any file is there
  const auto of_frame = [](Contender& of, std::size_t frame) { return of.kept_pairs(frame); };
  const auto of_moved = [](Contender& of, std::size_t frame) { return of.kept_moved_pairs(frame); };
  if (!options.pairs.empty()) write_pairs(options.pairs, frames, contenders, of_frame);
  if (!options.moved.empty()) write_pairs(options.moved, frames, contenders, of_moved);
  if (!options.changes.empty()) write_changes(options.changes, frames, contenders);
  csv.close();
  print_summary(contenders, frames.size());
}

}  // namespace

void add_pairs(Arguments command) {
  const auto options = std::make_shared<PairsOptions>();
  command
      .text("FILE", options->file,
            "Boxes: CSV (frame,id,min_x,min_y,min_z,max_x,max_y,max_z), or a Broadmark "
            "recording (.aabbs); a coordinate that is no float is rounded outwards to one")
      .required();
  command.text("--broad", options->broad, "Broad phases: names joined by commas, or all")
      .required();
  add_threads(command, options->threads, "Width of the executor");
  command.one_of("--executor", options->executor, executor_choices(),
                 "Whose threads: ours (crew, the default) or oneTBB's");
  add_time_limit(command, options->time_limit, "Seconds that a frame may take")
      .show_default("none");
  command.flag("--rebuild", options->rebuild, "Build each frame anew; no updates");
  command.text("--out", options->out, "The CSV file to write").required();
  command.text("--pairs", options->pairs, "Where to write the pairs themselves, as CSV");
  command.text("--changes", options->changes,
               "Where to write the pairs that began and those that ended in each frame, as CSV; "
               "after a frame that is lost, all pairs begin");
  command.text(
      "--moved", options->moved,
      "Where to write the pairs of which one body, or both, moved or came in the frame, as "
      "CSV; of a frame that is built, all pairs");
  command.text("--resting", options->resting,
               "Bodies that are static or asleep: CSV (id). Two of them are no pair, neither in "
               "--out nor in --pairs and --changes");
  command.job([options] {
    pairs(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
