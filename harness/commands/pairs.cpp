// touchstone pairs: runs broad phases on the boxes of a file, frame by frame.
// It writes a row for each frame and algorithm.
#include <fmt/format.h>
#include <sys/types.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/clock.h"
#include "harness/base/hash.h"
#include "harness/campaign/selection.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/process/isolate.h"
#include "harness/scene/box_frames.h"

namespace touchstone::commands {
namespace {

struct PairsOptions {
  std::string file, broad, out, pairs, changes;
  int threads = 2;
  bool rebuild = false;
  double time_limit = std::numeric_limits<double>::infinity();  // seconds a frame
};

// An algorithm's result of a frame.
struct Result {
  Status status = Status::crashed;
  bool known = false;  // the members below are known
  std::size_t pairs = 0;
  std::uint64_t hash = 0;
  double seconds = 0;
  std::size_t began = 0, ended = 0;
  // The place in the temporary file of the pairs, of those that began and of those that ended.
  off_t kept_at = 0;
  int error = 0;  // errno of a failure to keep the pairs
};

// One algorithm, which goes through the frames in a child process.
class Contender {
 public:
  Contender(const BroadPhaseEntry& entry, const std::vector<scene::BoxFrame>& frames,
            const PairsOptions& options)
      : entry_(entry), frames_(frames), options_(options), results_(frames.size()) {
    if (options.pairs.empty() && options.changes.empty()) return;
    kept_.reset(std::tmpfile());
    if (!kept_) keeping_failed(errno);
  }

  const std::string& name() const { return entry_.info.name; }
  const Result& result(std::size_t frame) const { return results_[frame]; }

  // A frame that crashes the algorithm or takes too long is lost; the next one is built anew.
  void run() {
    const process::IsolationLimits limits = {.item_seconds = options_.time_limit,
                                             .memory = process::IsolationLimits::no_limit};
    const process::IsolationReport report = process::isolate(frames_.size(), limits, [this] {
      const auto worker = std::make_shared<Worker>(entry_, options_.threads);
      return [this, worker](std::size_t i) { find_pairs(*worker, frames_[i], results_[i]); };
    });
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      Result& result = results_[i];
      if (report.states[i] != process::ItemState::done)
        result = {.status = process::status_of(report.states[i])};
      if (result.error != 0) keeping_failed(result.error);
    }
    print_failures(name(), report.failures, [this](std::size_t item) {
      return fmt::format("frame {}", frames_[item].number);
    });
  }

  // Returns the sorted pairs of the frame.
  std::vector<IndexPair> kept_pairs(std::size_t frame) {
    std::vector<IndexPair> all = kept(frame, 0, results_[frame].pairs);
    std::ranges::sort(all);
    return all;
  }
  // Returns the pairs that began in the frame, or those that ended, ascending.
  std::vector<IndexPair> kept_changes(std::size_t frame, bool have_begun) {
    const Result& result = results_[frame];
    return have_begun ? kept(frame, result.pairs, result.began)
                      : kept(frame, result.pairs + result.began, result.ended);
  }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  // The state of the child process, which has threads of its own.
  struct Worker {
    Executor executor;
    std::unique_ptr<BroadPhase> broad_phase;
    PairSink sink, began, ended;
    bool built = false;

    Worker(const BroadPhaseEntry& entry, int threads)
        : executor(threads, Pinning::one_a_thread), broad_phase(entry.make(executor)) {}
  };

  void find_pairs(Worker& worker, const scene::BoxFrame& frame, Result& result) {
    const base::Stopwatch stopwatch;
    if (worker.built && !options_.rebuild) {
      worker.broad_phase->update(frame.change());
    } else {
      worker.broad_phase->build(frame.own_boxes());
    }
    result.status = worker.broad_phase->find_pairs(worker.sink);
    result.seconds = stopwatch.seconds();
    worker.built = true;
    result.pairs = worker.sink.size();
    for (const PairBuffer& chunk : worker.sink.chunks())
      result.hash += base::pair_hash(chunk.pairs());
    if (!options_.changes.empty()) {
      const Status status = worker.broad_phase->find_changes(worker.began, worker.ended);
      if (result.status == Status::ok) result.status = status;
      result.began = worker.began.size();
      result.ended = worker.ended.size();
    }
    if (kept_) keep(worker, result);
    result.known = true;
  }

  void keep(const Worker& worker, Result& result) {
    // The place is behind all data of an earlier child, even partial data.
    bool good = fseeko(kept_.get(), 0, SEEK_END) == 0;
    result.kept_at = ftello(kept_.get());
    for (const PairSink* sink : {&worker.sink, &worker.began, &worker.ended}) {
      for (const PairBuffer& chunk : sink->chunks()) {
        const std::size_t count = chunk.size();
        good = good &&
               std::fwrite(chunk.pairs().data(), sizeof(IndexPair), count, kept_.get()) == count;
      }
    }
    if (!good || std::fflush(kept_.get()) != 0) result.error = errno;
  }
  // Returns `count` of the pairs that were kept of the frame, from the `first` on.
  std::vector<IndexPair> kept(std::size_t frame, std::size_t first, std::size_t count) {
    std::vector<IndexPair> pairs(count);
    const auto at = results_[frame].kept_at + static_cast<off_t>(first * sizeof(IndexPair));
    if (fseeko(kept_.get(), at, SEEK_SET) != 0 ||
        std::fread(pairs.data(), sizeof(IndexPair), count, kept_.get()) != count) {
      keeping_failed(errno);
    }
    return pairs;
  }
  [[noreturn]] static void keeping_failed(int error) {
    throw base::InputError(
        fmt::format("the pairs cannot be kept in a temporary file: {}", std::strerror(error)));
  }

  const BroadPhaseEntry& entry_;
  const std::vector<scene::BoxFrame>& frames_;
  const PairsOptions& options_;
  process::SharedArray<Result> results_;
  std::unique_ptr<std::FILE, CloseFile> kept_;  // the pairs of all frames that are done
};

void write_row(files::CsvWriter& csv, const scene::BoxFrame& frame, const Contender& contender,
               const Result& result, int threads) {
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
      const Result& result = contender->result(i);
      const Result& first = contenders.front()->result(i);
      done += result.known ? 1 : 0;
      pairs += result.pairs;
      seconds += result.seconds;
      differing += result.known && first.known && result.hash != first.hash ? 1 : 0;
    }
    fmt::print("{:<28} {:>7} {:>12} {:>12.6f}  {}\n", contender->name(), done, pairs, seconds,
               differing);
  }
}

struct Output {
  const char* option;
  const std::string& file;  // empty if it is not wanted
};

void check_outputs(std::initializer_list<Output> outputs) {
  for (const Output& output : outputs) {
    if (output.file.empty()) continue;
    files::check_output(output.file);
    for (const Output* other = outputs.begin(); other != &output; ++other) {
      if (!other->file.empty() && std::filesystem::weakly_canonical(other->file) ==
                                      std::filesystem::weakly_canonical(output.file)) {
        throw base::InputError(fmt::format("{} and {} name the same file; expected two",
                                           other->option, output.option));
      }
    }
  }
}

void write_pairs(const std::string& file, const std::vector<scene::BoxFrame>& frames,
                 std::span<const std::unique_ptr<Contender>> contenders) {
  files::CsvWriter csv(file, {"frame", "algorithm", "a", "b"});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const auto& contender : contenders) {
      for (const IndexPair& pair : contender->kept_pairs(i)) {
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

void pairs(const PairsOptions& options) {
  const auto entries =
      campaign::select(broad_phases(), campaign::split_names(options.broad), "broad phase");
  const std::vector<scene::BoxFrame> frames = scene::read_box_frames(options.file);
  check_outputs(
      {{"--out", options.out}, {"--pairs", options.pairs}, {"--changes", options.changes}});
  std::vector<std::unique_ptr<Contender>> contenders;
  contenders.reserve(entries.size());
  for (const BroadPhaseEntry* entry : entries) {
    contenders.push_back(std::make_unique<Contender>(*entry, frames, options));
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
  if (!options.pairs.empty()) write_pairs(options.pairs, frames, contenders);
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
            "recording (.aabbs)")
      .required();
  command.text("--broad", options->broad, "Broad phases: names joined by commas, or all")
      .required();
  add_threads(command, options->threads, "Width of the executor");
  add_time_limit(command, options->time_limit, "Seconds that a frame may take")
      .show_default("none");
  command.flag("--rebuild", options->rebuild, "Build each frame anew; no updates");
  command.text("--out", options->out, "The CSV file to write").required();
  command.text("--pairs", options->pairs, "Where to write the pairs themselves, as CSV");
  command.text("--changes", options->changes,
               "Where to write the pairs that began and those that ended in each frame, as CSV; "
               "after a frame that is lost, all pairs begin");
  command.job([options] {
    pairs(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
