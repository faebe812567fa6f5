// pairs: boxes through broad phases, one frame and algorithm a row.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/commands/commands.h"
#include "harness/commands/selection.h"
#include "harness/io/box_frames.h"
#include "harness/io/csv.h"
#include "harness/run/clock.h"
#include "harness/run/pair_hash.h"

namespace touchstone {
namespace {

struct PairsOptions {
  std::string file, broad, out, pairs;
  int threads = 2;
  bool rebuild = false;
};

// One algorithm on its way through the frames.
struct Contender {
  const BroadPhaseEntry* entry;
  std::unique_ptr<BroadPhase> broad_phase;
  PairSink sink;
  std::size_t pairs = 0;
  std::size_t differing = 0;  // frames whose pairs are not the first algorithm's
  double seconds = 0;
};

std::uint64_t hash_of(const PairSink& sink) {
  std::uint64_t sum = 0;
  for (const PairBuffer& chunk : sink.chunks()) sum += pair_hash(chunk.pairs());
  return sum;
}

void write_pairs(CsvWriter& csv, const BoxFrame& frame, const Contender& contender) {
  std::vector<IndexPair> all = contender.sink.gather();
  std::ranges::sort(all);
  for (const IndexPair& pair : all) {
    csv.field(frame.number).field(contender.entry->info.name);
    csv.field(std::int64_t{pair.a}).field(std::int64_t{pair.b}).end_row();
  }
}

void print_summary(const std::vector<Contender>& contenders, std::size_t frames) {
  fmt::print("{:<28} {:>7} {:>12} {:>12}  {}\n", "algorithm", "frames", "pairs", "seconds",
             "frames that differ from the first's");
  for (const Contender& contender : contenders) {
    fmt::print("{:<28} {:>7} {:>12} {:>12.6f}  {}\n", contender.entry->info.name, frames,
               contender.pairs, contender.seconds, contender.differing);
  }
}

void pairs(const PairsOptions& options) {
  const auto entries = select(broad_phases(), split_names(options.broad), "broad phase");
  const std::vector<BoxFrame> frames = read_box_frames(options.file);
  if (!options.pairs.empty() && std::filesystem::weakly_canonical(options.pairs) ==
                                    std::filesystem::weakly_canonical(options.out)) {
    throw InputError("--out and --pairs name the same file; expected two");
  }
  CsvWriter csv(options.out,
                {"frame", "algorithm", "threads", "status", "pair_count", "pair_hash", "seconds"});
  std::optional<CsvWriter> pairs_csv;
  if (!options.pairs.empty()) {
    pairs_csv.emplace(options.pairs, std::vector<std::string>{"frame", "algorithm", "a", "b"});
  }
  Executor executor(options.threads);
  std::vector<Contender> contenders;
  for (const BroadPhaseEntry* entry : entries) {
    contenders.emplace_back().entry = entry;
    contenders.back().broad_phase = entry->make(executor);
  }
  for (const BoxFrame& frame : frames) {
    std::uint64_t first_hash = 0;
    for (Contender& contender : contenders) {
      const Stopwatch stopwatch;
      if (options.rebuild || &frame == &frames.front()) {
        contender.broad_phase->build(frame.own_boxes());
      } else {
        contender.broad_phase->update(frame.change());
      }
      const Status status = contender.broad_phase->find_pairs(contender.sink);
      const double seconds = stopwatch.seconds();
      const std::uint64_t hash = hash_of(contender.sink);
      if (&contender == &contenders.front()) first_hash = hash;
      contender.pairs += contender.sink.size();
      contender.differing += hash != first_hash ? 1 : 0;
      contender.seconds += seconds;
      csv.field(frame.number).field(contender.entry->info.name).field(options.threads);
      csv.field(to_string(status)).field(contender.sink.size()).field(to_hex(hash));
      csv.field(seconds).end_row();
      if (pairs_csv) write_pairs(*pairs_csv, frame, contender);
    }
  }
  if (pairs_csv) pairs_csv->close();
  csv.close();
  print_summary(contenders, frames.size());
}

}  // namespace

void add_pairs(CLI::App& app, int& status) {
  const auto options = std::make_shared<PairsOptions>();
  CLI::App& command = *app.add_subcommand("pairs", "Find the pairs of boxes that overlap");
  command
      .add_option("FILE", options->file,
                  "Boxes: CSV (frame,id,min_x,min_y,min_z,max_x,max_y,max_z), or a Broadmark "
                  "recording (.aabbs)")
      ->required();
  command.add_option("--broad", options->broad, "Broad phases: names joined by commas, or all")
      ->required();
  command.add_option("--threads", options->threads, "Width of the executor")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command.add_flag("--rebuild", options->rebuild, "Build each frame anew; no updates");
  command.add_option("--out", options->out, "The CSV file to write")->required();
  command.add_option("--pairs", options->pairs, "Where to write the pairs themselves, as CSV");
  command.callback([options, &status] {
    pairs(*options);
    status = exit_done;
  });
}

}  // namespace touchstone
