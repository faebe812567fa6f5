// What is asked of pairs of bodies that touch: the points of their contact, and how good these are.
#include "harness/kinds/manifold/manifold_kind.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/files/cases.h"
#include "harness/files/csv.h"
#include "harness/files/text_file.h"
#include "harness/grade/manifold/manifold_grade.h"
#include "harness/kinds/grading.h"
#include "harness/kinds/questions.h"
#include "harness/process/solve_case.h"

namespace touchstone::kinds {
namespace {

constexpr std::array<std::string_view, 1> manifold_task_names = {"manifold"};
constexpr int most_settled = 1'000'000;

class ManifoldQuestions final : public AnswersOf<ManifoldEntry, Manifold> {
 public:
  explicit ManifoldQuestions(const QuestionInput& input)
      : input_(input), settled_(input.count("--settled")) {
    asked_task(input, manifold_task_names);
    if (input.has("--page") && !input.has("--grade")) {
      throw base::InputError("--page was given without --grade; expected both");
    }
    if (settled_ && *settled_ > most_settled) {
      throw base::InputError(
          fmt::format("--settled: found {}; expected 1 to {}", *settled_, most_settled));
    }
    if (const std::optional<int> seed = input.count("--seed")) {
      if (!settled_) throw base::InputError("--seed was given; expected it with --settled alone");
      seed_ = static_cast<std::uint64_t>(*seed);
    }
    for (const ManifoldEntry* entry :
         kinds::select(registry::entries<ManifoldEntry>(), input.names, "contact manifold")) {
      for (const Precision scalar : {Precision::float64, Precision::float32}) {
        const bool wanted = !input.has("--scalar") || input.scalar() == scalar;
        if (wanted && offers(*entry, scalar)) asked_.push_back({.entry = entry, .scalar = scalar});
      }
    }
    read_or_make_cases();
  }

  std::size_t size() const override { return cases_.size(); }
  std::string label(std::size_t i) const override {
    return fmt::format("case '{}'", cases_[i].pair.id);
  }
  std::string name(std::size_t contestant) const override {
    return fmt::format("{} {}", info(contestant).name, to_string(asked_[contestant].scalar));
  }
  std::vector<files::NamedFile> inputs() const override { return {{"FILE", input_.file}}; }
  std::vector<files::NamedFile> outputs() const override {
    return {{"--page", input_.text("--page")}};
  }
  std::string_view unit() const override { return "m"; }

  // Kinds of shapes that the algorithm lacks are unsupported.
  std::vector<AskFailure> ask(std::size_t contestant) override {
    const Asked& asked = asked_[contestant];
    return ask_each(
        contestant, input_.seconds(),
        [&](std::size_t i) {
          const files::Case& c = cases_[i].pair;
          return offers(*asked.entry, c.shape_a.kind, c.shape_b.kind);
        },
        [&] {
          return [this, &asked](std::size_t i) {
            return process::solve_manifold(*asked.entry, {.scalar = asked.scalar}, cases_[i].pair);
          };
        });
  }

  std::vector<std::string> columns() const override {
    return {"id",       "algorithm", "scalar", "answer", "status", "normal_x",
            "normal_y", "normal_z",  "count",  "point",  "depth",  "a_x",
            "a_y",      "a_z",       "b_x",    "b_y",    "b_z",    "feature"};
  }
  void write(files::CsvWriter& csv, std::size_t i, std::size_t contestant) const override {
    const Manifold& manifold = answer(i, contestant);
    // A manifold without points has one row too.
    for (int k = 0; k < std::max(1, manifold.count); ++k) {
      csv.field(cases_[i].pair.id).field(info(contestant).name);
      csv.field(to_string(asked_[contestant].scalar)).field(to_string(manifold.answer));
      csv.field(to_string(manifold.status));
      for (const double x : manifold.normal) csv.field(x);
      csv.field(manifold.count);
      write_if(csv, manifold.count != 0, k);
      const ContactPoint point = manifold.points[static_cast<std::size_t>(k)];
      csv.field(point.depth);
      for (const Vec3d& v : {point.on_a, point.on_b}) {
        for (const double x : v) csv.field(x);
      }
      csv.field(point.feature == 0 ? std::string() : fmt::format("{:016x}", point.feature));
      csv.end_row();
    }
  }
  void write_further() override {
    if (!input_.has("--grade")) return;
    grade_all();
    if (input_.has("--page")) files::write_text(input_.text("--page"), page_text());
  }

  ShownAnswer shown(std::size_t i, std::size_t contestant) const override {
    const Manifold& manifold = answer(i, contestant);
    ShownAnswer shown = {.verdict = to_string(manifold.answer), .status = manifold.status};
    if (manifold.count > 0) {
      const auto contacts = manifold.contacts();
      shown.more = fmt::format("{} points, the deepest {} m", manifold.count,
                               std::ranges::max(contacts, {}, &ContactPoint::depth).depth);
    }
    return shown;
  }
  std::vector<std::string_view> verdicts() const override { return {}; }

  bool print_summary(bool are_shown) const override {
    base::Table table({"algorithm", "0 points", "1", "2", "3", "4", "not asked"});
    for (std::size_t c = 0; c < contestants(); ++c) {
      std::array<std::size_t, 6> counts{};
      for (const Manifold& manifold : asked_[c].answers) {
        const bool is_asked = manifold.status != Status::unsupported;
        ++counts[is_asked ? static_cast<std::size_t>(manifold.count) : 5];
      }
      std::vector<std::string> row = {name(c)};
      for (const std::size_t count : counts) row.push_back(fmt::format("{}", count));
      table.add(std::move(row));
    }
    if (!are_shown) fmt::print("{}", table.text(base::page_width()));
    if (input_.has("--grade")) fmt::print("\n{}", tally_.table().text(base::page_width()));
    return true;
  }
  bool is_wrong() const override {
    for (const std::string& line : tally_.ours_wrong()) fmt::print("wrong: {}\n", line);
    return !tally_.ours_wrong().empty();
  }

 private:
  // A case, with its family.
  struct FamilyCase {
    files::Case pair;
    std::string family;
  };

  void read_or_make_cases() {
    if (input_.file.empty() == !settled_) {
      throw base::InputError("found neither or both; expected either FILE or --settled COUNT");
    }
    if (!settled_) {
      for (files::Case& c : files::read_cases(input_.file)) {
        cases_.push_back({std::move(c), "cases"});
      }
      return;
    }
    for (const SettledFamily& family : settled_families()) {
      for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(*settled_); ++i) {
        cases_.push_back({settled_pair(family, seed_, i), std::string(family.name)});
      }
    }
  }

  void grade_all() {
    tally_ = {};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const grade::ManifoldTruth truth = grade::manifold_truth(cases_[i].pair);
      for (std::size_t c = 0; c < contestants(); ++c) {
        const Manifold& manifold = answer(i, c);
        if (manifold.status == Status::unsupported) continue;
        tally_.add(cases_[i].family, name(c), info(c), asked_[c].scalar, cases_[i].pair, truth,
                   manifold);
      }
    }
  }

  std::string page_text() const {
    std::string text = "# Contact manifolds\n\n";
    const std::string asked =
        settled_ ? fmt::format("--settled {} --seed {}", *settled_, seed_) : input_.file.string();
    text += fmt::format(
        "Made by `touchstone query {} --kind manifold --with {} --grade --page FILE`. Every row is "
        "the worst of its pairs; "
        "lengths "
        "are parts of the pair's size.\n\n"
        "- *missed*: pairs that overlap and have no point.\n"
        "- *off body*: how far a point is from the body that it is said to be of, by the oracle.\n"
        "- *depth error*: of the deepest point, against the oracle's depth.\n"
        "- *apart*: the gap at a point. Bullet reports places that nearly touch, by design.\n"
        "- *area of best four*: the area between the points, as a part of the greatest that four "
        "corners of the touching area span of which one is the deepest; at most 1. *Area of all*: "
        "as "
        "a "
        "part of the whole. The touching area is where the two faces overlap as seen along the "
        "algorithm's normal.\n\n"
        "Peers are given the shapes without the margins that they would add, as their files in "
        "`algorithms/peers` say.\n\n",
        asked, fmt::join(input_.names, ","));
    if (settled_) {
      for (const SettledFamily& family : settled_families()) {
        text += fmt::format("- `{}`: {}\n", family.name, family.what);
      }
      text += '\n';
    }
    return text + tally_.table().markdown();
  }

  QuestionInput input_;
  std::optional<int> settled_;  // the number of pairs of each family
  std::uint64_t seed_ = 1;
  std::vector<FamilyCase> cases_;
  grade::ManifoldTally tally_;
};

}  // namespace

std::vector<QueryOption> manifold_options() {
  using Value = QueryOption::Value;
  return {option::scalar,
          {"--settled", Value::count,
           "Instead of FILE: so many generated pairs of each family of face contacts"},
          {"--seed", Value::natural, "The seed of the generated pairs (default: 1)"},
          {"--grade", Value::flag,
           "Hold the points to the oracle, the bodies and the touching area; exit status 1 where "
           "one of ours is not "
           "as good as it promises"},
          {"--page", Value::text, "With --grade: the table as a Markdown page"}};
}

std::unique_ptr<Questions> read_manifold_questions(const QuestionInput& input) {
  return std::make_unique<ManifoldQuestions>(input);
}

const Kind& manifold_kind() {
  static const KindOf<ManifoldEntry> kind(
      {.registry = kind_words<ManifoldEntry>,
       .title = "Contact manifolds",
       .contract = "contact manifold",
       .legend = "",
       .tasks = manifold_task_names,
       .draw_number = 0},
      {.options = manifold_options, .read = read_manifold_questions});
  return kind;
}

}  // namespace touchstone::kinds
