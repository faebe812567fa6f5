// What is asked of pairs of moving bodies: when they first touch.
#include "harness/kinds/cast/cast_kind.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/files/cases.h"
#include "harness/files/csv.h"
#include "harness/kinds/proofs.h"
#include "harness/kinds/questions.h"
#include "harness/process/solve_cast.h"

namespace touchstone::kinds {
namespace {

constexpr std::array<std::string_view, 2> start_names = {"counts", "approach"};

// --start says the same as the task.
StartContact asked_start(const QuestionInput& input) {
  if (input.has("--start") && !input.task.empty() && input.task != input.text("--start")) {
    throw base::InputError(fmt::format("--start {} was given with --task {}; expected one of them",
                                       input.text("--start"), input.task));
  }
  QuestionInput one = input;
  if (one.task.empty()) one.task = input.text("--start");
  return static_cast<StartContact>(asked_task(one, start_names));
}

class CastQuestions final : public AnswersOf<CastEntry, CastOutcome> {
 public:
  explicit CastQuestions(const QuestionInput& input) : input_(input) {
    settings_ = {.scalar = input.scalar(),
                 .tolerance = input.number("--tolerance"),
                 .max_iterations = input.count("--max-iterations"),
                 .start = asked_start(input)};
    if (input.has("--save-certificates") && settings_.start == StartContact::approach) {
      throw base::InputError(
          "--save-certificates: there are proofs only of casts where contact at time 0 counts; "
          "expected --start counts");
    }
    select(input.names, "cast", settings_.scalar);
    cases_ = files::read_cast_cases(input.file);
  }

  std::size_t size() const override { return cases_.size(); }
  std::string label(std::size_t i) const override { return fmt::format("case '{}'", cases_[i].id); }
  std::vector<files::NamedFile> inputs() const override { return {{"FILE", input_.file}}; }
  std::string_view unit() const override { return "of the step"; }
  std::vector<std::string> of_other_scalar() const override {
    CastSettings other = settings_;
    other.scalar = other.scalar == Precision::float64 ? Precision::float32 : Precision::float64;
    return names_where(
        [&](const CastEntry& entry) { return !offers(entry, settings_) && offers(entry, other); });
  }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    const CastEntry& entry = *asked_[contestant].entry;
    const bool takes = offers(entry, settings_);
    return ask_each(
        contestant, input_.seconds(),
        [&](std::size_t i) { return takes && is_taken_by(entry, cases_[i]); },
        [&] {
          return [this, &entry](std::size_t i) {
            return process::solve_cast(entry, settings_, cases_[i]);
          };
        });
  }

  std::vector<std::string> columns() const override {
    return {"id",       "algorithm", "scalar",  "answer",   "status",
            "toi",      "lower",     "upper",   "normal_x", "normal_y",
            "normal_z", "point_x",   "point_y", "point_z",  "iterations"};
  }
  void write(files::CsvWriter& csv, std::size_t i, std::size_t contestant) const override {
    const CastOutcome& outcome = answer(i, contestant);
    csv.field(cases_[i].id).field(info(contestant).name).field(to_string(settings_.scalar));
    csv.field(to_string(outcome.answer)).field(to_string(outcome.status));
    csv.field(outcome.toi).field(outcome.lower).field(outcome.upper);
    for (const Vec3d& v : {outcome.normal, outcome.point}) {
      for (const double x : v) csv.field(x + 0.0);  // no negative zero
    }
    write_if(csv, outcome.iterations >= 0, outcome.iterations);
    csv.end_row();
  }

  ShownAnswer shown(std::size_t i, std::size_t contestant) const override {
    const CastOutcome& outcome = answer(i, contestant);
    return {.verdict = to_string(outcome.answer),
            .status = outcome.status,
            .number = outcome.toi,
            .lower = outcome.lower,
            .upper = outcome.upper};
  }
  std::vector<std::string_view> verdicts() const override { return {"hit", "miss", "unknown"}; }

  Proving proving() const override {
    const CastEntry& exact = *registry::find<CastEntry>("exact");
    std::vector<std::size_t> taken;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (is_taken_by(exact, cases_[i])) taken.push_back(i);
    }
    const auto prove = [this, taken](std::size_t item) {
      return files::to_json(process::prove_cast(cases_[taken[item]], settings_.tolerance));
    };
    return {{},
            taken.size(),
            [prove] { return prove; },
            [this, taken](std::size_t item) { return label(taken[item]); }};
  }

 private:
  static bool is_taken_by(const CastEntry& entry, const files::CastCase& c) {
    return offers(entry, c.shape_a.kind, c.shape_b.kind, process::turns(c));
  }

  QuestionInput input_;
  CastSettings settings_;
  std::vector<files::CastCase> cases_;
};

}  // namespace

std::vector<QueryOption> cast_options() {
  return {option::scalar,
          option::tolerance,
          option::max_iterations,
          {"--start",
           QueryOption::Value::choice,
           "Whether contact at time 0 counts always, or only where the bodies approach (default: "
           "counts)",
           {"counts", "approach"}},
          option::saved};
}

std::unique_ptr<Questions> read_cast_questions(const QuestionInput& input) {
  return std::make_unique<CastQuestions>(input);
}

bool verify_cast_proofs(const std::string& proofs, const std::filesystem::path& file) {
  AskedCases asked;
  if (!file.empty()) {
    for (files::CastCase& c : files::read_cast_cases(file)) {
      asked.add(to_json(c));
      // A half-space is the second body in a certificate.
      std::swap(c.shape_a, c.shape_b);
      std::swap(c.pose_a, c.pose_b);
      std::swap(c.motion_a, c.motion_b);
      asked.add(to_json(c));
    }
  }
  Verdicts verdicts(proofs);
  return verdicts.of([&] {
    files::read_cast_certificates(
        proofs, [&](const files::StoredCastCertificate& stored, std::int64_t line) {
          std::string why = asked.fault(to_json(stored.of));
          if (why.empty()) why = process::fault_of(stored);
          verdicts.add(line, stored.of.id, why);
        });
  });
}

}  // namespace touchstone::kinds
