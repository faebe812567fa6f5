// What is asked of pairs of convex bodies.
#include "harness/kinds/pair/pair_questions.h"

#include <fmt/format.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/files/cases.h"
#include "harness/files/csv.h"
#include "harness/files/text_file.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/mesh/mesh_kind.h"
#include "harness/kinds/pair/pair_cases.h"
#include "harness/kinds/pair/reproducer/reproducer.h"
#include "harness/kinds/questions.h"
#include "harness/process/solve_case.h"

namespace touchstone::kinds {
namespace {

struct PairAnswer {
  Status status = Status::unsupported;  // of the outcome too; the child's end is written here
  Task task = Task::signed_distance;    // that was asked
  Outcome outcome;
};

class PairQuestions final : public AnswersOf<NarrowPhaseEntry, PairAnswer> {
 public:
  explicit PairQuestions(const QuestionInput& input)
      : input_(input),
        task_(static_cast<Task>(asked_task(input, pair_task_names, 3))),
        named_(asked_pair_cases(input)) {
    settings_ = {.scalar = input.scalar(),
                 .tolerance = input.number("--tolerance"),
                 .max_iterations = input.count("--max-iterations"),
                 .duality_gap = input.number("--duality-gap"),
                 .margin = input.number("--margin")};
    for (const std::string_view option : {"--margin", "--duality-gap"}) {
      if (asks_distance(task_) || !input.has(option)) continue;
      throw base::InputError(
          fmt::format("{} was given; expected it with --task distance or signed alone", option));
    }
    if (input.has("--save-certificates")) claim();
    for (const files::ConcaveCase& c : named_) cases_.push_back(convex_case(c));
    select(input.names, "narrow phase", settings_.scalar);
    if (input.has("--as-test")) {
      test_ = reproducer(library_of_test(), cases_, task_, input.text("--as-test"));
    }
    for (const Asked& asked : asked_) {
      if (!settings_.duality_gap || asked.entry->traits.stops_by_duality_gap) continue;
      throw base::InputError(fmt::format(
          "--duality-gap was given for '{}', which does not stop by it; expected only {}",
          asked.entry->info.name, names_stopping_by_duality_gap()));
    }
  }

  std::size_t size() const override { return cases_.size(); }
  std::string label(std::size_t i) const override { return fmt::format("case '{}'", cases_[i].id); }
  std::vector<files::NamedFile> inputs() const override { return {{"FILE", input_.file}}; }
  std::vector<files::NamedFile> outputs() const override {
    return {{"--page", input_.text("--page")}, {"--as-test", input_.text("--as-test")}};
  }
  void write_further() override {
    if (!input_.has("--as-test")) return;
    const std::filesystem::path file = input_.text("--as-test");
    files::write_text(file, test_);
    fmt::print("{}: its first lines say how it is compiled\n", file.string());
  }
  std::string_view unit() const override { return "m"; }
  std::span<const files::ConcaveCase> pairs() const override { return named_; }
  std::vector<std::string> of_other_scalar() const override {
    return names_where(
        [&](const NarrowPhaseEntry& entry) { return !offers(entry, settings_.scalar); });
  }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    const NarrowPhaseEntry& entry = *asked_[contestant].entry;
    const bool takes = offers(entry, settings_.scalar);
    return ask_each(
        contestant, input_.seconds(),
        [&](std::size_t i) { return takes && !tasks_of(entry, i).empty(); },
        [&] { return [this, &entry](std::size_t i) { return solve(entry, i); }; });
  }

  std::vector<std::string> columns() const override { return query_columns(); }
  void write(files::CsvWriter& csv, std::size_t i, std::size_t contestant) const override {
    const PairAnswer& given = answer(i, contestant);
    const Task task = given.status == given.outcome.status ? given.task : task_;
    write_query_fields(csv,
                       {cases_[i].id, info(contestant).name, to_string(settings_.scalar),
                        to_string(given.status == Status::unsupported ? task_ : task)},
                       outcome_of(given));
    csv.end_row();
  }

  ShownAnswer shown(std::size_t i, std::size_t contestant) const override {
    const PairAnswer& given = answer(i, contestant);
    ShownAnswer shown = shown_outcome(outcome_of(given));
    if (given.task == Task::intersect && shown.verdict == "overlapping") shown.more = "(no depth)";
    if (given.task == Task::distance && shown.verdict == "overlapping") shown.more = "(no depth)";
    if (given.task == Task::intersect && shown.verdict == "separated") shown.more = "(no distance)";
    if (given.task == Task::penetration && shown.verdict == "separated") {
      shown.more = "(no distance)";
    }
    return shown;
  }
  std::vector<std::string_view> verdicts() const override {
    return {"separated", "touching", "overlapping", "unknown"};
  }

  Proving proving() const override { return parts_proving(claim(), named_); }

 private:
  // The one library that is asked.
  std::string_view library_of_test() const {
    std::string_view library;
    int count = 0;
    for (const Asked& asked : asked_) {
      if (asked.entry->info.origin != Origin::peer) continue;
      library = asked.entry->info.name;
      ++count;
    }
    if (count == 1) return library;
    throw base::InputError(fmt::format("--as-test was given with {} libraries; expected one of {}",
                                       count, names_with_reproducers()));
  }

  static Outcome outcome_of(const PairAnswer& given) {
    Outcome outcome = given.outcome;
    outcome.status = given.status;
    return outcome;
  }

  // What is proven of a case: there are no proofs of depths.
  ConcaveTask claim() const {
    if (input_.task == "intersect") return ConcaveTask::intersect;
    if (input_.task.empty() || input_.task == "distance") return ConcaveTask::distance;
    throw base::InputError(fmt::format(
        "--save-certificates was given with --task {}; expected intersect, distance or contacts",
        input_.task));
  }

  // The task; if none was asked and the algorithm lacks signed distances, those which it has that make one up.
  std::vector<Task> tasks_of(const NarrowPhaseEntry& entry, std::size_t i) const {
    const auto has = [&](Task task) {
      return offers(entry, cases_[i].shape_a.kind, cases_[i].shape_b.kind, task);
    };
    if (has(task_)) return {task_};
    std::vector<Task> tasks;
    if (!input_.task.empty()) return tasks;
    for (const Task task : {Task::penetration, Task::distance}) {
      if (has(task)) tasks.push_back(task);
    }
    if (tasks.empty() && has(Task::intersect)) tasks.push_back(Task::intersect);
    return tasks;
  }

  PairAnswer solve(const NarrowPhaseEntry& entry, std::size_t i) const {
    PairAnswer answer;
    for (const Task task : tasks_of(entry, i)) {
      answer.task = task;
      answer.outcome = process::solve_case(entry, settings_, cases_[i], task);
      answer.status = answer.outcome.status;
      if (answer.outcome.answer != Answer::separated) break;  // a distance adds nothing
    }
    return answer;
  }

  QuestionInput input_;
  Task task_;
  std::vector<files::ConcaveCase> named_;  // as they were read
  std::vector<files::Case> cases_;
  std::string test_;  // of --as-test
  NarrowPhaseSettings settings_;
};

}  // namespace

std::vector<QueryOption> pair_options() {
  using Value = QueryOption::Value;
  return pair_case_options(
      {option::scalar,
       option::tolerance,
       {.name = "--duality-gap",
        .value = Value::positive,
        .help = "Stop a distance by the absolute duality gap of its square instead (square metres)",
        .excludes = "--tolerance"},
       {"--margin", Value::not_negative, "Bodies further apart than this get no distance (metres)"},
       option::max_iterations,
       option::saved,
       {"--as-test", Value::text,
        "Also write the pairs as a test of the library of --with or --peer, in its own language, "
        "such as reproducer.cpp"}});
}

std::unique_ptr<Questions> read_pair_questions(const QuestionInput& input) {
  return std::make_unique<PairQuestions>(input);
}

}  // namespace touchstone::kinds
