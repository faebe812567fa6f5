#include "harness/check/failures.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/check/margins.h"
#include "harness/check/shrink.h"
#include "harness/check/true_case.h"
#include "harness/grade/solve_case.h"
#include "harness/process/isolate.h"
#include "harness/process/worker_pool.h"

namespace touchstone {
namespace {

constexpr int shrink_budget = 400;           // queries
constexpr double shrink_seconds = 1;         // wall clock, of a case
constexpr std::size_t most_bytes = 1 << 20;  // of a shrunk case

Query query_of(const GradedAnswer& answer) {
  return {answer.regime, answer.entry, answer.scalar, answer.task};
}

bool is_lost(const GradedAnswer& answer) {
  return answer.given.verdict == Verdict::crashed || answer.given.verdict == Verdict::timed_out;
}

// Asks in this process.
GradedAnswer ask(const CheckRequest& request, const GradedAnswer& failure, const Case& c,
                 oracle::Oracle& oracle) {
  const NarrowPhaseSettings settings = {.scalar = failure.scalar};
  TrueCase true_case(c, failure.index, oracle);
  return grade_answer(request, query_of(failure), true_case,
                      solve_case(*request.narrow[failure.entry], settings, c, failure.task));
}

// Shrinking may turn a body into one of another kind.
bool offers_kinds(const CheckRequest& request, const GradedAnswer& failure, const Case& c) {
  return offers(*request.narrow[failure.entry], c.shape_a.kind, c.shape_b.kind, failure.task);
}

// Whether the query kills its process.
bool crashes(const CheckRequest& request, const GradedAnswer& failure, const Case& c) {
  const NarrowPhaseSettings settings = {.scalar = failure.scalar};
  const IsolationReport report =
      isolate(1, {.item_seconds = request.time_limit}, [&]() -> ItemWork {
        return [&](std::size_t) {
          solve_case(*request.narrow[failure.entry], settings, c, failure.task);
        };
      });
  return report.states[0] == ItemState::crashed || report.states[0] == ItemState::threw;
}

// A smaller case may be a little less wrong, and no more than that.
bool is_alike(const GradedAnswer& small, const GradedAnswer& failure) {
  if (failure.beyond && !small.beyond) return false;
  if (small.given.verdict != failure.given.verdict) return false;
  if (failure.given.verdict == Verdict::silent_error) {
    return small.given.margin / small.scale >= failure.given.margin / failure.scale / 10;
  }
  return badness(small) >= badness(failure) / 10;
}

Case shrunk(const CheckRequest& request, const GradedAnswer& failure, const Case& original) {
  // Without a measure of it nothing tells whether a smaller case is as bad.
  if (failure.given.verdict == Verdict::timed_out || badness(failure) == 0) return original;
  oracle::Oracle oracle;
  const Stopwatch watch;
  const auto still_fails = [&](const Case& c) {
    if (watch.seconds() > shrink_seconds) return false;
    if (!offers_kinds(request, failure, c)) return false;
    if (failure.given.verdict == Verdict::crashed) return crashes(request, failure, c);
    return is_alike(ask(request, failure, c, oracle), failure);
  };
  return shrink(original, still_fails, shrink_budget);
}

// A line of a case file, and the answer that it shows.
struct Shown {
  GradedAnswer answer;
  std::string line;
};

// The case with what is wrong about it, as keys that a reader of cases passes over.
std::string to_line(const Case& c, const GradedAnswer& answer, const CheckRequest& request,
                    const std::string& id) {
  nlohmann::ordered_json line = nlohmann::ordered_json::parse(to_json(c));
  const auto bound = [](double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
  };
  line["expect"] = {{"answer", to_string(answer.exact)},
                    {"signed_distance", {bound(answer.lower), bound(answer.upper)}}};
  line["source"] = {{"shrunk_from", id},
                    {"algorithm", request.narrow[answer.entry]->info.name},
                    {"scalar", to_string(answer.scalar)},
                    {"task", to_string(answer.task)},
                    {"wrong", describe(answer, request)}};
  return line.dump();
}

// In a process of its own: what is tried on the way may kill it. Then the case stays as it is.
Shown show(const CheckRequest& request, const GradedAnswer& failure) {
  const Regime& regime = *request.regimes[failure.regime];
  const Case original = make(regime, request.seed, failure.index);
  SharedArray<GradedAnswer> answer(1);
  SharedArray<char> text(most_bytes);
  const IsolationLimits limits = {.item_seconds = 3 * shrink_seconds + request.time_limit};
  const IsolationReport report = isolate(1, limits, [&]() -> ItemWork {
    return [&](std::size_t) {
      Case small = shrunk(request, failure, original);
      small.id = original.id;
      answer[0] = failure;
      if (!is_lost(failure)) {
        oracle::Oracle oracle;
        answer[0] = ask(request, failure, small, oracle);
      }
      const std::string line = to_line(small, answer[0], request, original.id);
      if (line.size() < most_bytes) std::memcpy(&text[0], line.data(), line.size());
    };
  });
  if (report.states[0] == ItemState::done && text[0] != '\0') return {answer[0], &text[0]};
  return {failure, to_line(original, failure, request, original.id)};
}

std::string to_bytes(const Shown& shown) {
  std::string bytes(reinterpret_cast<const char*>(&shown.answer), sizeof shown.answer);
  return bytes + shown.line;
}

Shown shown_from(const std::string& bytes) {
  Shown shown;
  std::memcpy(static_cast<void*>(&shown.answer), bytes.data(), sizeof shown.answer);
  shown.line = bytes.substr(sizeof shown.answer);
  return shown;
}

// "gjk-double-distance"
std::string stem(const CheckRequest& request, const Query& query) {
  return fmt::format("{}-{}-{}", request.narrow[query.entry]->info.name, to_string(query.scalar),
                     to_string(query.task));
}

// The files of a folder, each made when its first line comes.
class CaseFiles {
 public:
  explicit CaseFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::filesystem::path add(const std::string& name, const std::string& line) {
    std::filesystem::path file = folder_ / (name + ".jsonl");
    std::ofstream& stream = streams_[file];
    if (!stream.is_open()) {
      std::error_code ignored;
      std::filesystem::create_directories(folder_, ignored);
      stream.open(file, std::ios::binary);
    }
    stream << line << '\n';
    return file;
  }
  void close() {
    for (auto& [file, stream] : streams_) {
      stream.close();
      if (!stream) throw InputError(file.string(), 0, "cannot be written");
    }
  }

 private:
  std::filesystem::path folder_;
  std::map<std::filesystem::path, std::ofstream> streams_;
};

}  // namespace

std::string describe(const GradedAnswer& answer, const CheckRequest& request) {
  const NarrowPhaseEntry& entry = *request.narrow[answer.entry];
  if (answer.beyond) {
    return beyond_margins(entry, answer, request.regimes[answer.regime]->extreme);
  }
  const Grade& grade = answer.given;
  const double scale = answer.scale;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  switch (grade.verdict) {
    case Verdict::crashed: add("crashed"); break;
    case Verdict::timed_out: add("no answer in time"); break;
    case Verdict::silent_error:
      add(fmt::format("called {}, and {} by {:.3g} m, {:.1e} of the size", to_string(answer.answer),
                      is_contact(answer.answer) ? "apart" : "overlapping", grade.margin,
                      grade.margin / scale));
      break;
    default: break;
  }
  const auto number = [&](const char* what, double error) {
    if (std::abs(error) > documented_margins(answer.scalar, true).length * scale) {
      add(fmt::format("{} by {:.3g} m, {:.1e} of the size", what, std::abs(error),
                      std::abs(error) / scale));
    }
  };
  number(grade.distance_error > 0 ? "distance too great" : "distance too small",
         grade.distance_error);
  number(grade.depth_error > 0 ? "depth too great" : "depth too small", grade.depth_error);
  if (answer.task == Task::penetration && grade.separation_error > 0) {
    number("the translation does not separate", grade.separation_error);
  }
  number("certified bounds miss the exact value", grade.bounds_error);
  if (answer.witnesses.not_a_number) add("a reported number is NaN or infinite");
  return text;
}

std::string query_command(const CheckRequest& request, const Query& query,
                          const std::filesystem::path& file) {
  return fmt::format("touchstone query {} --narrow {} --task {} --scalar {} --out answers.csv",
                     file.string(), request.narrow[query.entry]->info.name, to_string(query.task),
                     to_string(query.scalar));
}

std::string FailureCase::command(const CheckRequest& request) const {
  return query_command(request, query_of(answer), file);
}

std::vector<FailureCase> write_failures(const CheckRequest& request, const Tally& tally) {
  return write_failures(request, tally.failures(request));
}

std::vector<FailureCase> write_failures(const CheckRequest& request,
                                        const std::vector<GradedAnswer>& failures) {
  const std::filesystem::path folder = request.out / "failures";
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".jsonl") std::filesystem::remove(entry.path());
  }
  CaseFiles files(folder);
  std::vector<FailureCase> cases;
  run_jobs(
      0, failures.size(), request.workers,
      [&]() -> JobWork {
        return [&](std::size_t job) { return to_bytes(show(request, failures[job])); };
      },
      [&](std::size_t job, const std::string& bytes) {
        const Shown shown = shown_from(bytes);
        const GradedAnswer& failure = failures[job];
        const std::filesystem::path file = files.add(stem(request, query_of(failure)), shown.line);
        const Regime& regime = *request.regimes[failure.regime];
        cases.push_back({shown.answer, make(regime, request.seed, failure.index).id,
                         describe(shown.answer, request), file});
        return true;
      });
  files.close();
  return cases;
}

std::vector<VariantFailure> write_variant_failures(const CheckRequest& request,
                                                   const Tally& tally) {
  CaseFiles files(request.out / "failures");
  std::vector<VariantFailure> failures;
  for (const Tally::RegimeVariants& found : tally.variants_beyond()) {
    const VariantCount& count = found.count;
    const Query query = {found.regime, count.entry, count.scalar, count.task};
    const Case original = make(*request.regimes[found.regime], request.seed, count.worst_index);
    const std::string name = stem(request, query) + "-variants";
    std::filesystem::path file = files.add(name, to_json(original));
    for (const Variant& variant : sampled_variants(original, request.seed, count.worst_index)) {
      if (kind_of(variant) == count.name()) files.add(name, to_json(variant.transformed));
    }
    failures.push_back({query, original.id, count, std::move(file)});
  }
  files.close();
  return failures;
}

std::vector<TruthFailure> write_truth_failures(const CheckRequest& request, const Tally& tally) {
  CaseFiles files(request.out / "failures");
  std::vector<TruthFailure> failures;
  for (const JobSummary& job : tally.jobs()) {
    if (job.refused + job.boxes_broken == 0) continue;
    const Case c = make(*request.regimes[job.regime], request.seed, job.worst_index);
    failures.push_back({job, c.id, files.add("truth", to_json(c))});
  }
  files.close();
  return failures;
}

}  // namespace touchstone
