// What is asked of boxes, frame by frame: which of them overlap.
#include "harness/kinds/box/box_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/files/csv.h"
#include "harness/kinds/box/broad_check.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/selection.h"
#include "harness/scene/box_frames.h"

namespace touchstone::kinds {
namespace {

constexpr std::array<std::string_view, 1> box_task_names = {"pairs"};
constexpr int most_threads = 1024;

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

class BoxQuestions final : public Questions {
 public:
  explicit BoxQuestions(const QuestionInput& input) : input_(input) {
    asked_task(input, box_task_names);
    const auto entries = select(registry::entries<BroadPhaseEntry>(), input.names, "broad phase");
    options_ = {.pairs = input.text("--pairs"),
                .changes = input.text("--changes"),
                .moved = input.text("--moved"),
                .resting = input.text("--resting"),
                .threads = input.count("--threads").value_or(2),
                .executor = input.text("--executor") == "onetbb" ? ExecutorKind::onetbb
                            : input.has("--executor")            ? ExecutorKind::crew
                                                                 : usual_executor,
                .rebuild = input.has("--rebuild")};
    if (options_.threads > most_threads) {
      throw base::InputError(
          fmt::format("--threads: found {}; expected 1 to {}", options_.threads, most_threads));
    }
    options_.time_limit = input.seconds(options_.time_limit);
    frames_ = scene::read_box_frames(input.file);
    if (!options_.resting.empty()) is_resting_ = read_resting(options_.resting, frames_);
    std::size_t rounded = 0;
    for (const scene::BoxFrame& frame : frames_) {
      rounded += frame.rounded;
      known_ += frame.known_pairs.size();
    }
    if (known_ > 0 && !options_.resting.empty()) {
      throw base::InputError(
          "--resting: leaves out pairs that the frames' lists of known pairs ask for");
    }
    if (rounded > 0) {
      fmt::print(stderr, "{} coordinates are not floats, and were rounded outwards\n", rounded);
    }
    for (const BroadPhaseEntry* entry : entries) {
      contenders_.push_back(std::make_unique<BoxContender>(*entry, frames_, options_, is_resting_));
    }
  }

  std::size_t size() const override { return frames_.size(); }
  std::string label(std::size_t i) const override {
    return fmt::format("frame {}", frames_[i].number);
  }
  std::vector<files::NamedFile> inputs() const override {
    return {{"FILE", input_.file}, {"--resting", options_.resting}};
  }
  std::vector<files::NamedFile> outputs() const override {
    return {
        {"--pairs", options_.pairs}, {"--changes", options_.changes}, {"--moved", options_.moved}};
  }
  std::string_view unit() const override { return ""; }

  std::size_t contestants() const override { return contenders_.size(); }
  const AlgorithmInfo& info(std::size_t contestant) const override {
    return contenders_[contestant]->info();
  }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    return contenders_[contestant]->run();
  }

  std::vector<std::string> columns() const override {
    return {"frame", "algorithm", "threads", "status", "pair_count", "pair_hash", "seconds"};
  }
  void write(files::CsvWriter& csv, std::size_t i, std::size_t contestant) const override {
    const FrameResult& result = contenders_[contestant]->result(i);
    csv.field(frames_[i].number).field(info(contestant).name).field(options_.threads);
    csv.field(to_string(result.status));
    if (result.known) {
      csv.field(result.pairs).field(base::to_hex(result.hash));
      if (touchstone::is_timed(info(contestant))) {
        csv.field(result.seconds);
      } else {
        csv.field("");
      }
    } else {
      csv.field("").field("").field("");
    }
    csv.end_row();
  }
  void write_further() override {
    const auto all = [](const BoxContender& of, std::size_t frame) { return of.kept_pairs(frame); };
    const auto fresh = [](const BoxContender& of, std::size_t frame) {
      return of.kept_moved_pairs(frame);
    };
    if (!options_.pairs.empty()) write_pairs(options_.pairs, all);
    if (!options_.moved.empty()) write_pairs(options_.moved, fresh);
    if (!options_.changes.empty()) write_changes(options_.changes);
  }

  ShownAnswer shown(std::size_t i, std::size_t contestant) const override {
    const FrameResult& result = contenders_[contestant]->result(i);
    ShownAnswer shown = {.verdict = {}, .status = result.status};
    if (!result.known) return shown;
    shown.more = fmt::format("{} pairs, hash {}", result.pairs, base::to_hex(result.hash));
    if (touchstone::is_timed(info(contestant))) {
      shown.more += fmt::format(", {:.3g} ms", 1e3 * result.seconds);
    }
    return shown;
  }
  std::vector<std::string_view> verdicts() const override { return {}; }

  bool print_summary(bool are_shown) const override {
    if (!are_shown) print_counts();
    if (known_ > 0) print_known();
    return true;
  }
  bool is_wrong() const override {
    return std::ranges::any_of(contenders_, [&](const auto& contender) {
      return contender->info().origin != Origin::peer && missing(*contender).pairs > 0;
    });
  }

 private:
  // Writes the pairs of each frame and algorithm that `pairs_of` returns.
  template <class PairsOf>
  void write_pairs(const std::string& file, const PairsOf& pairs_of) const {
    files::CsvWriter csv(file, {"frame", "algorithm", "a", "b"});
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      for (const auto& contender : contenders_) {
        for (const IndexPair& pair : pairs_of(*contender, i)) {
          csv.field(frames_[i].number).field(contender->info().name);
          csv.field(std::int64_t{pair.a}).field(std::int64_t{pair.b}).end_row();
        }
      }
    }
    csv.close();
  }

  void write_changes(const std::string& file) const {
    files::CsvWriter csv(file, {"frame", "algorithm", "a", "b", "change"});
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      for (const auto& contender : contenders_) {
        for (const bool have_begun : {true, false}) {
          for (const IndexPair& pair : contender->kept_changes(i, have_begun)) {
            csv.field(frames_[i].number).field(contender->info().name);
            csv.field(std::int64_t{pair.a}).field(std::int64_t{pair.b});
            csv.field(have_begun ? "began" : "ended").end_row();
          }
        }
      }
    }
    csv.close();
  }

  void print_counts() const {
    fmt::print("{:<28} {:>7} {:>12} {:>12}  {}\n", "algorithm", "frames", "pairs", "seconds",
               "frames that differ from the first's");
    for (const auto& contender : contenders_) {
      std::size_t done = 0, pairs = 0, differing = 0;
      double seconds = 0;
      for (std::size_t i = 0; i < frames_.size(); ++i) {
        const FrameResult& result = contender->result(i);
        const FrameResult& first = contenders_.front()->result(i);
        done += result.known ? 1 : 0;
        pairs += result.pairs;
        seconds += result.seconds;
        differing += result.known && first.known && result.hash != first.hash ? 1 : 0;
      }
      const bool has_time = touchstone::is_timed(contender->info());
      fmt::print("{:<28} {:>7} {:>12} {:>12}  {}\n", contender->info().name, done, pairs,
                 has_time ? fmt::format("{:.6f}", seconds) : "-", differing);
    }
  }

  struct Missing {
    std::size_t pairs = 0;
    std::string first;  // frame and pair
  };
  Missing missing(const BoxContender& contender) const {
    Missing all;
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const FrameResult& result = contender.result(i);
      if (!result.known || result.missing == 0) continue;
      if (all.pairs == 0) {
        all.first = fmt::format("{} and {} of frame {}", result.first_missing.a,
                                result.first_missing.b, frames_[i].number);
      }
      all.pairs += result.missing;
    }
    return all;
  }
  void print_known() const {
    bool are_all_found = true;
    for (const auto& contender : contenders_) {
      const Missing not_found = missing(*contender);
      if (not_found.pairs == 0) continue;
      are_all_found = false;
      fmt::print("{}: misses {} of {} known pairs, first {}\n", contender->info().name,
                 not_found.pairs, known_, not_found.first);
    }
    if (are_all_found)
      fmt::print("Each algorithm found the {} known pairs of the frames that it answered.\n",
                 known_);
  }

  QuestionInput input_;
  BoxOptions options_;
  std::vector<scene::BoxFrame> frames_;
  std::size_t known_ = 0;         // pairs that the frames' authors know to meet
  std::vector<char> is_resting_;  // by id
  std::vector<std::unique_ptr<BoxContender>> contenders_;
};

}  // namespace

std::vector<QueryOption> box_options() {
  using Value = QueryOption::Value;
  return {{"--threads", Value::count, "Width of the executor (default: 2)"},
          {"--executor",
           Value::choice,
           "Whose threads: ours (crew, the default) or oneTBB's",
           {"crew", "onetbb"}},
          {"--rebuild", Value::flag, "Build each frame anew; no updates"},
          {"--pairs", Value::text, "Where to write the pairs themselves, as CSV"},
          {"--changes", Value::text,
           "Where to write the pairs that began and those that ended in each frame, as CSV; after "
           "a frame that is "
           "lost, all pairs begin"},
          {"--moved", Value::text,
           "Where to write the pairs of which one body, or both, moved or came in the frame, as "
           "CSV; of a frame that "
           "is built, all pairs"},
          {"--resting", Value::text,
           "Bodies that are static or asleep: CSV (id). Two of them are no pair, neither in --out "
           "nor in --pairs and "
           "--changes"}};
}

std::unique_ptr<Questions> read_box_questions(const QuestionInput& input) {
  return std::make_unique<BoxQuestions>(input);
}

const Kind& box_kind() {
  static const KindOf<BroadPhaseEntry> kind(
      {.registry = kind_words<BroadPhaseEntry>,
       .title = "Boxes",
       .contract = "broad phase",
       .legend = "",
       .tasks = box_task_names,
       .draw_number = 0},
      {.options = box_options,
       .read = read_box_questions,
       .offers = [](const BroadPhaseEntry&, Precision, std::uint8_t) { return true; },
       .by_scalar = false,
       .checker = [](const CheckRequest& request) -> std::unique_ptr<Checker> {
         return std::make_unique<BoxChecker>(request);
       }});
  return kind;
}

}  // namespace touchstone::kinds
