// Shrinks a failing case in a child process, describes what is wrong with it, and writes and
// removes files of cases.
#include "harness/grade/failures/shrunk_failure.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

#include "harness/base/clock.h"
#include "harness/grade/failures/shrink.h"
#include "harness/grade/wrong.h"
#include "harness/process/isolate.h"
#include "harness/process/solve_case.h"

namespace touchstone::grade {

std::filesystem::path CaseFiles::add(const std::string& name, const std::string& line) {
  std::unique_ptr<files::OutputFile>& file = files_[name];
  if (!file) {
    std::filesystem::path path = own_.free_stem(failures_folder, name);
    path += ".jsonl";
    own_.note({path});
    file = std::make_unique<files::OutputFile>(path);
  }
  file->write(line + "\n");
  return file->path();
}

void CaseFiles::close() {
  for (const auto& [name, file] : files_) file->close();
}

void remove_case_files(const std::filesystem::path& results) {
  record::OwnFiles(results).remove(
      [](const std::string& name) { return name.starts_with(std::string(failures_folder) + "/"); });
}

namespace {

constexpr int shrink_budget = 400;           // queries
constexpr double shrink_seconds = 1;         // wall clock, for one case
constexpr std::size_t most_bytes = 1 << 20;  // size of a shrunk case, bytes

// Runs the query in this process.
GradedAnswer ask(const FailedQuery& failed, const files::Case& c, oracle::Oracle& oracle) {
  TrueCase true_case(c, failed.answer.index, oracle);
  const Query query = query_of(failed.answer);
  return grade_answer(
      *failed.algorithm, failed.extreme, query, true_case,
      process::solve_case(*failed.algorithm, {.scalar = query.scalar}, c, query.task));
}

// Returns whether the algorithm takes the kinds of the case, which shrinking may have changed.
bool offers_kinds(const FailedQuery& failed, const files::Case& c) {
  return offers(*failed.algorithm, c.shape_a.kind, c.shape_b.kind, failed.answer.task);
}

// Returns whether the query kills its process.
bool crashes(const FailedQuery& failed, const files::Case& c) {
  const auto solved =
      process::isolated_answers<Outcome>(1, {.item_seconds = failed.time_limit}, [&] {
        return [&](std::size_t) {
          return process::solve_case(*failed.algorithm, {.scalar = failed.answer.scalar}, c,
                                     failed.answer.task);
        };
      });
  return solved.answers[0].status == failed.answer.status;
}

// Returns whether the smaller case is about as wrong: it may be a little less wrong.
bool is_alike(const GradedAnswer& small, const GradedAnswer& failure) {
  if (failure.beyond && !small.beyond) return false;
  if (small.given.verdict != failure.given.verdict) return false;
  if (failure.given.verdict == Verdict::silent_error) {
    return small.given.margin / small.scale >= failure.given.margin / failure.scale / 10;
  }
  return badness(small) >= badness(failure) / 10;
}

files::Case shrunk(const FailedQuery& failed) {
  const GradedAnswer& failure = failed.answer;
  // Without a badness, two cases cannot be compared.
  if (failure.given.verdict == Verdict::timed_out || badness(failure) == 0) return failed.original;
  oracle::Oracle oracle;
  const base::Stopwatch watch;
  const auto still_fails = [&](const files::Case& c) {
    if (watch.seconds() > shrink_seconds) return false;
    if (!offers_kinds(failed, c)) return false;
    if (failure.given.verdict == Verdict::crashed) return crashes(failed, c);
    return is_alike(ask(failed, c, oracle), failure);
  };
  files::Case small = shrink(failed.original, still_fails, shrink_budget);
  small.id = failed.original.id;
  return small;
}

std::string to_line(const FailedQuery& failed, const files::Case& c, const GradedAnswer& answer) {
  nlohmann::ordered_json line = nlohmann::ordered_json::parse(files::to_json(c));
  const auto bound = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  line["expect"] = {{"answer", to_string(answer.exact)},
                    {"signed_distance", {bound(answer.lower), bound(answer.upper)}}};
  line["source"] = {{"shrunk_from", failed.original.id},
                    {"algorithm", failed.algorithm->info.name},
                    {"scalar", to_string(answer.scalar)},
                    {"task", to_string(answer.task)},
                    {"wrong", describe(*failed.algorithm, answer, failed.extreme)}};
  return line.dump();
}

}  // namespace

ShrunkFailure shrunk_failure(const FailedQuery& failed) {
  const GradedAnswer& failure = failed.answer;
  process::SharedArray<GradedAnswer> answer(1);
  process::SharedArray<char> text(most_bytes);
  const process::IsolationLimits limits = {.item_seconds = 3 * shrink_seconds + failed.time_limit};
  const process::IsolationReport report = process::isolate(1, limits, [&]() -> process::ItemWork {
    return [&](std::size_t) {
      const files::Case small = shrunk(failed);
      answer[0] = failure;
      const Verdict verdict = failure.given.verdict;
      if (verdict != Verdict::crashed && verdict != Verdict::timed_out) {
        oracle::Oracle oracle;
        answer[0] = ask(failed, small, oracle);
      }
      const std::string line = to_line(failed, small, answer[0]);
      if (line.size() < most_bytes) std::memcpy(&text[0], line.data(), line.size());
    };
  });
  if (report.states[0] == process::ItemState::done && text[0] != '\0') return {answer[0], &text[0]};
  return {failure, to_line(failed, failed.original, failure)};
}

}  // namespace touchstone::grade
