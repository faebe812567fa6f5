// What is asked of pairs of bodies that need not be convex.
#include "harness/kinds/mesh/mesh_kind.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/base/input_file.h"
#include "harness/files/csv.h"
#include "harness/kinds/pair/pair_cases.h"
#include "harness/kinds/questions.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {
namespace {

constexpr std::array<std::string_view, 3> mesh_task_names = {"intersect", "distance", "contacts"};

struct MeshReply {
  Outcome outcome;
  Status status = Status::unsupported;  // of the outcome too; the child's end is written here
  std::uint64_t pair_count = 0, pair_hash = 0;
};

[[noreturn]] void refuse_mesh_task(const QuestionInput& input,
                                   const std::vector<files::ConcaveCase>& cases) {
  const std::string message = fmt::format(
      "--task {}, which concave phases do not answer; expected intersect, distance or contacts",
      input.task);
  const auto concave = std::ranges::find(cases, false, &files::ConcaveCase::is_convex);
  if (concave == cases.end()) {
    throw base::InputError(fmt::format("--with {} names concave phases, with {}",
                                       fmt::join(input.names, ","), message));
  }
  throw base::InputError(input.file, concave->line,
                         fmt::format("case '{}' has a mesh or a compound, with {}",
                                     base::shortened(concave->id), message));
}

// The pairs of one algorithm, those that were asked for, by case.
struct Fetched {
  std::vector<std::vector<IndexPair>> pairs;
  std::vector<std::vector<PartContact>> contacts;
};

class MeshQuestions final : public AnswersOf<ConcaveEntry, MeshReply> {
 public:
  explicit MeshQuestions(const QuestionInput& input)
      : input_(input), cases_(asked_pair_cases(input)) {
    if (input.task == "penetration" || input.task == "signed") refuse_mesh_task(input, cases_);
    const bool wants_pairs = input.has("--pairs") || input.has("--contacts");
    const auto fullest = wants_pairs ? ConcaveTask::contacts : ConcaveTask::distance;
    task_ = static_cast<ConcaveTask>(
        asked_task(input, mesh_task_names, static_cast<std::size_t>(fullest)));
    for (const std::string_view option : {"--pairs", "--contacts"}) {
      if (task_ != ConcaveTask::contacts && input.has(option)) {
        throw base::InputError(
            fmt::format("{} was given; expected it with --task contacts alone", option));
      }
    }
    if (input.has("--welded") && !input.has("--contacts")) {
      throw base::InputError("--welded was given; expected it with --contacts alone");
    }
    select(input.names, "concave phase", input.scalar());
    fetched_.resize(contestants());
    const std::string parts_name = input.text("--parts", "certified");
    const auto* mid = kinds::select(registry::entries<MidPhaseEntry>(),
                                    {input.text("--mid", "wide-bvh")}, "mid-phase")
                          .at(0);
    const auto* parts =
        kinds::select(registry::entries<NarrowPhaseEntry>(), {parts_name}, "narrow phase").at(0);
    if (!answers_for_all(*parts)) {
      throw base::InputError(fmt::format(
          "--parts: the narrow phase '{}' does not answer every task for all convex shapes; "
          "expected one that does, such as certified",
          parts_name));
    }
    const NarrowPhaseSettings of_parts = {.tolerance = input.number("--tolerance"),
                                          .max_iterations = input.count("--max-iterations")};
    settings_ = {.scalar = input.scalar(),
                 .mid_phase = mid->make,
                 .narrow_phase = [parts, of_parts] { return parts->make(of_parts); },
                 .tolerance = of_parts.tolerance,
                 .welds = input.has("--welded")};
  }

  std::size_t size() const override { return cases_.size(); }
  std::string label(std::size_t i) const override { return fmt::format("case '{}'", cases_[i].id); }
  std::vector<files::NamedFile> inputs() const override { return {{"FILE", input_.file}}; }
  std::vector<files::NamedFile> outputs() const override {
    return {{"--pairs", input_.text("--pairs")},
            {"--contacts", input_.text("--contacts")},
            {"--page", input_.text("--page")}};
  }
  std::string_view unit() const override { return "m"; }
  std::span<const files::ConcaveCase> pairs() const override { return cases_; }
  std::vector<std::string> of_other_scalar() const override {
    return names_where([&](const ConcaveEntry& entry) {
      return std::ranges::count(entry.scalars, settings_.scalar) == 0;
    });
  }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    const ConcaveEntry& entry = *asked_[contestant].entry;
    const ConcaveTask task = task_of(entry);
    const bool takes = offers(entry, task, settings_.scalar);
    auto failures = ask_each(
        contestant, input_.seconds(),
        [&](std::size_t i) {
          return takes && (entry.supports == nullptr || entry.supports(cases_[i].a, cases_[i].b));
        },
        [&] {
          return [this, &entry, task](std::size_t i) {
            std::vector<IndexPair> pairs;
            return solve(entry, task, cases_[i], pairs, nullptr);
          };
        });
    fetched_[contestant].pairs.resize(size());
    fetched_[contestant].contacts.resize(size());
    if (input_.has("--pairs") || input_.has("--contacts")) fetch_pairs(contestant, failures);
    return failures;
  }

  std::vector<std::string> columns() const override {
    std::vector<std::string> columns = query_columns();
    if (counts()) columns.insert(columns.end(), {"pair_count", "pair_hash"});
    return columns;
  }
  void write(files::CsvWriter& csv, std::size_t i, std::size_t contestant) const override {
    const MeshReply& given = answer(i, contestant);
    Outcome outcome = given.outcome;
    outcome.status = given.status;
    write_query_fields(csv,
                       {cases_[i].id, info(contestant).name, to_string(settings_.scalar),
                        to_string(task_of(*asked_[contestant].entry))},
                       outcome);
    if (counts() && outcome.answer == Answer::unknown && given.pair_count == 0) {
      csv.field("").field("");
    } else if (counts()) {
      csv.field(given.pair_count).field(base::to_hex(given.pair_hash));
    }
    csv.end_row();
  }
  void write_further() override {
    if (input_.has("--pairs")) write_pairs(input_.text("--pairs"));
    if (input_.has("--contacts")) write_contacts(input_.text("--contacts"));
  }

  ShownAnswer shown(std::size_t i, std::size_t contestant) const override {
    const MeshReply& given = answer(i, contestant);
    ShownAnswer shown = shown_outcome(given.outcome);
    shown.status = given.status;
    if (given.outcome.answer == Answer::overlapping) shown.more = "(no depth)";
    if (given.outcome.answer == Answer::separated && std::isnan(shown.number)) {
      shown.more = "(no distance)";
    }
    if (counts()) shown.more = fmt::format("{} pairs of parts", given.pair_count);
    return shown;
  }
  std::vector<std::string_view> verdicts() const override {
    return {"separated", "touching", "overlapping", "unknown"};
  }

  Proving proving() const override { return parts_proving(task_, cases_); }

 private:
  bool counts() const { return task_ == ConcaveTask::contacts; }

  // The task; if none was asked, what the algorithm has instead of the fullest.
  ConcaveTask task_of(const ConcaveEntry& entry) const {
    if (!input_.task.empty() || offers(entry, task_, settings_.scalar)) return task_;
    if (task_ == ConcaveTask::contacts) return task_;  // no other task lists pairs
    return offers(entry, ConcaveTask::intersect, settings_.scalar) ? ConcaveTask::intersect : task_;
  }

  static bool answers_for_all(const NarrowPhaseEntry& entry) {
    if (!offers(entry, Precision::float64)) return false;
    for (const Task task : {Task::intersect, Task::distance, Task::penetration}) {
      for (const ShapeKind a : all_shape_kinds) {
        for (const ShapeKind b : all_shape_kinds) {
          if (!offers(entry, a, b, task)) return false;
        }
      }
    }
    return true;
  }

  MeshReply solve(const ConcaveEntry& entry, ConcaveTask task, const files::ConcaveCase& c,
                  std::vector<IndexPair>& pairs, std::vector<PartContact>* contacts) const {
    const std::vector<ConcaveBody> bodies = {c.a, c.b};
    const std::unique_ptr<ConcavePhase> algorithm = entry.make(settings_);
    algorithm->bind(bodies);
    MeshReply answer;
    algorithm->solve(task, {0, c.pose_a}, {1, c.pose_b}, answer.outcome, pairs);
    if (contacts != nullptr) {
      std::ranges::sort(pairs);
      algorithm->measure({0, c.pose_a}, {1, c.pose_b}, pairs, *contacts);
    }
    answer.status = answer.outcome.status;
    answer.pair_count = pairs.size();
    answer.pair_hash = base::pair_hash(pairs);
    return answer;
  }

  // Solves the cases with pairs again, in one child process, now that it is known how many there are.
  void fetch_pairs(std::size_t contestant, std::vector<AskFailure>& failures) {
    const ConcaveEntry& entry = *asked_[contestant].entry;
    Fetched& all = fetched_[contestant];
    std::vector<std::size_t> taken, first = {0};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const std::size_t count = answer(i, contestant).pair_count;
      if (count == 0) continue;
      taken.push_back(i);
      first.push_back(first.back() + count);
    }
    if (taken.empty()) return;
    const bool measured =
        input_.has("--contacts") && entry.measures && (!settings_.welds || entry.welds);
    process::SharedArray<IndexPair> fetched(first.back());
    process::SharedArray<PartContact> fetched_contacts(measured ? first.back() : 1);
    const auto of_item = [&](auto& items, std::size_t item) {
      return items.span().subspan(first[item], first[item + 1] - first[item]);
    };
    const auto fill = [](const auto& from, const auto& to) {
      std::copy_n(from.begin(), std::min(from.size(), to.size()), to.begin());
    };
    const process::IsolationLimits limits = {.item_seconds = input_.seconds()};
    const auto report = process::isolate(taken.size(), limits, [&]() -> process::ItemWork {
      return [&](std::size_t item) {
        std::vector<IndexPair> pairs;
        std::vector<PartContact> contacts;
        solve(entry, task_of(entry), cases_[taken[item]], pairs, measured ? &contacts : nullptr);
        fill(pairs, of_item(fetched, item));
        if (measured) fill(contacts, of_item(fetched_contacts, item));
      };
    });
    for (const process::IsolationFailure& failure : report.failures) {
      failures.push_back({"pairs of " + label(taken[failure.item]), failure.reason()});
    }
    for (std::size_t item = 0; item < taken.size(); ++item) {
      if (report.states[item] != process::ItemState::done) continue;
      const auto pairs = of_item(fetched, item);
      all.pairs[taken[item]].assign(pairs.begin(), pairs.end());
      std::ranges::sort(all.pairs[taken[item]]);
      if (!measured) continue;
      const auto contacts = of_item(fetched_contacts, item);
      all.contacts[taken[item]].assign(contacts.begin(), contacts.end());
    }
  }

  void write_pairs(const std::string& file) const {
    files::CsvWriter csv(file, {"id", "algorithm", "a_part", "b_part"});
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      for (std::size_t c = 0; c < contestants(); ++c) {
        for (const IndexPair& pair : fetched_[c].pairs[i]) {
          csv.field(cases_[i].id)
              .field(info(c).name)
              .field(std::uint64_t{pair.a})
              .field(std::uint64_t{pair.b});
          csv.end_row();
        }
      }
    }
    csv.close();
  }

  // One row for each pair and each algorithm that has contacts.
  void write_contacts(const std::string& file) const {
    files::CsvWriter csv(
        file, {"id", "algorithm", "a_part", "b_part", "status", "depth", "normal_x", "normal_y",
               "normal_z", "point_x", "point_y", "point_z", "welded"});
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      for (std::size_t c = 0; c < contestants(); ++c) {
        for (const PartContact& contact : fetched_[c].contacts[i]) {
          csv.field(cases_[i].id)
              .field(info(c).name)
              .field(std::uint64_t{contact.parts.a})
              .field(std::uint64_t{contact.parts.b})
              .field(to_string(contact.status))
              .field(contact.depth);
          for (const double x : contact.normal) csv.field(x);
          for (const double x : contact.point) csv.field(x);
          csv.field(contact.is_welded ? 1 : 0);
          csv.end_row();
        }
      }
    }
    csv.close();
  }

  QuestionInput input_;
  std::vector<files::ConcaveCase> cases_;
  ConcaveTask task_ = ConcaveTask::distance;
  ConcaveSettings settings_;
  std::vector<Fetched> fetched_;  // by contestant
};

}  // namespace

std::vector<QueryOption> mesh_options() {
  using Value = QueryOption::Value;
  return pair_case_options(
      {option::scalar,
       option::tolerance,
       option::max_iterations,
       {"--pairs", Value::text,
        "With --task contacts: the CSV file of the pairs of parts that share a point"},
       {"--contacts", Value::text,
        "With --task contacts: the CSV file of these pairs' normals, depths and points"},
       {"--welded", Value::flag,
        "With --contacts: where neighbours of a triangle are in the way of a normal, the contact "
        "has that of the "
        "nearest face around it, on the side of the other body's origin"},
       {"--mid", Value::text, "The mid-phase that finds pairs of parts (default: wide-bvh)"},
       {"--parts", Value::text, "The narrow phase for pairs of convex parts (default: certified)"},
       option::saved});
}

std::unique_ptr<Questions> read_mesh_questions(const QuestionInput& input) {
  return std::make_unique<MeshQuestions>(input);
}

}  // namespace touchstone::kinds
