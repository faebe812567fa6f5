// What the rooms of all kinds share: how a kind is made of its parts, and how batches are drawn and graded.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "algorithms/core/status.h"
#include "harness/base/error.h"
#include "harness/families/draws.h"
#include "harness/kinds/checker.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::kinds {

// The draws of one case: different for each family, seed and index.
inline families::RandomDraws draws_of(const Kind& kind, std::uint32_t number, std::uint64_t seed,
                                      std::uint64_t index) {
  const std::uint64_t family = std::uint64_t{kind.draw_number()} * 1000 + number;
  return families::RandomDraws(base::mix(seed) + family, index);
}

template <class Entry>
Contestant contestant_of(const Kind& kind, const Entry& entry, bool promised,
                         Precision scalar = Precision::float64, std::uint8_t task = 0) {
  return {.kind = &kind,
          .info = &entry.info,
          .entry = &entry,
          .scalar = scalar,
          .task = task,
          .promised = promised && is_answerable(entry.info.origin)};
}

// The grade that the status alone decides, if it does.
inline std::optional<Grade> grade_of_status(Status status, bool is_unknown) {
  if (process::is_lost(status)) return Grade::failed;
  if (status == Status::unsupported) return Grade::not_asked;
  if (!is_meant(status) || is_unknown) return Grade::gave_up;
  return std::nullopt;
}

// The grade of a verdict that is not what the exact one is.
inline std::optional<Grade> grade_of_verdict(bool contact, bool truth) {
  if (contact == truth) return std::nullopt;
  return truth ? Grade::missed : Grade::false_hit;
}

// An algorithm may lose so many queries of a job, since each hang costs a time limit.
inline process::IsolationLimits batch_limits(double time_limit) {
  return {.item_seconds = time_limit, .failures = 20};
}

// What a call answered; a crash costs all of its cases.
template <class Answer, std::size_t most>
struct CallAnswer {
  Status status = Status::unsupported;
  std::array<Answer, most> answers;
};

// Asks calls of at most so many cases, whose `places` say which these are, in a child process. make_solver() is called
// there, and gives solve(call, answers); take(place, answer) gets each answer, which has a `status`, in order.
template <class Answer, std::size_t most, class Call, class MakeSolver, class Take>
void ask_calls(const std::vector<Call>& calls, double time_limit, const MakeSolver& make_solver,
               const Take& take) {
  if (calls.empty()) return;
  const auto solved = process::isolated_answers<CallAnswer<Answer, most>>(
      calls.size(), batch_limits(time_limit), [&] {
        return [&calls, solve = make_solver()](std::size_t k) {
          CallAnswer<Answer, most> answer;
          answer.status = Status::ok;
          solve(calls[k], std::span<Answer>(answer.answers).first(calls[k].places.size()));
          return answer;
        };
      });
  for (std::size_t k = 0; k < calls.size(); ++k) {
    for (std::size_t at = 0; at < calls[k].places.size(); ++at) {
      Answer answer = solved.answers[k].answers[at];
      if (solved.answers[k].status != Status::ok) answer.status = solved.answers[k].status;
      take(calls[k].places[at], answer);
    }
  }
}

// The cases that a form is asked for: those that are sampled, or all as they are drawn.
inline bool is_asked(CaseForm form, std::uint64_t index) {
  return form == CaseForm::as_drawn || is_sampled(index);
}

// What the rooms of kinds give to theirs. What is null a kind does not have.
template <class Entry>
struct KindParts {
  // What a user's own file asks, and the proofs of it.
  std::vector<QueryOption> (*options)();
  std::unique_ptr<Questions> (*read)(const QuestionInput& input);
  bool (*verify)(const std::string& proofs, const std::filesystem::path& file) = nullptr;
  // Who is checked: `offers` a scalar and a task, and `promises` that what it does not give up is right; null: all
  // of ours do.
  bool (*offers)(const Entry& entry, Precision scalar, std::uint8_t task) = nullptr;
  bool (*promises)(const Entry& entry) = nullptr;
  bool by_scalar = true, by_task = true;  // a contestant for each; false: one that is asked all
  // On which cases: batches of families, or those of a checker.
  std::vector<Family> (*families)() = nullptr;
  std::unique_ptr<Batch> (*draw)(const Family& family, const BatchRange& range) = nullptr;
  std::unique_ptr<Checker> (*checker)(const CheckRequest& request) = nullptr;
  // What is timed.
  std::vector<PlannedSet> (*sets)(files::TomlTable& table,
                                  const std::filesystem::path& home) = nullptr;
};

template <class Batches>
std::unique_ptr<Batch> drawn_batch(const Family& family, const BatchRange& range) {
  return std::make_unique<Batches>(family.number, range);
}

// A kind whose algorithms are the entries of a type.
template <class Entry>
class KindOf final : public Kind {
 public:
  KindOf(const Words& words, const KindParts<Entry>& parts) : Kind(words), parts_(parts) {}

  std::vector<const AlgorithmInfo*> algorithms() const override {
    std::vector<const AlgorithmInfo*> infos;
    for (const Entry& entry : registry::entries<Entry>()) infos.push_back(&entry.info);
    return infos;
  }
  std::vector<Contestant> contestants(const std::vector<std::string>& names,
                                      std::span<const Precision> scalars) const override {
    static constexpr std::array any_scalar = {Precision::float64};
    std::vector<Contestant> all;
    if (parts_.offers == nullptr) return all;
    for (const Entry* entry : select(registry::entries<Entry>(), names, contract())) {
      const bool is_named = std::ranges::find(names, entry->info.name) != names.end();
      if (entry->info.origin == Origin::oracle && !is_named) continue;
      const bool promised = parts_.promises == nullptr || parts_.promises(*entry);
      const std::size_t before = all.size();
      for (const Precision scalar :
           parts_.by_scalar ? scalars : std::span<const Precision>(any_scalar)) {
        const std::size_t asked = parts_.by_task ? tasks().size() : 1;
        for (std::uint8_t task = 0; task < asked; ++task) {
          if (!parts_.offers(*entry, scalar, task)) continue;
          all.push_back(
              contestant_of(*this, *entry, promised, scalar, parts_.by_task ? task : every_task));
        }
      }
      // An algorithm of a group may lack the scalar: it is left out.
      if (parts_.by_task || !is_named || all.size() > before) continue;
      throw base::InputError(fmt::format("'{}' does not compute in {}; expected another --scalar",
                                         entry->info.name, to_string(scalars.front())));
    }
    return all;
  }
  std::unique_ptr<Batch> draw(const Family& family, const BatchRange& range) const override {
    if (parts_.draw == nullptr) throw std::logic_error("a kind without batches draws none");
    return parts_.draw(family, range);
  }
  std::unique_ptr<Checker> checker(const CheckRequest& request) const override {
    return parts_.checker == nullptr ? nullptr : parts_.checker(request);
  }
  std::vector<QueryOption> query_options() const override { return parts_.options(); }
  std::unique_ptr<Questions> read(const QuestionInput& input) const override {
    return parts_.read(input);
  }
  bool verify(const std::string& proofs, const std::filesystem::path& file) const override {
    if (parts_.verify != nullptr) return parts_.verify(proofs, file);
    throw base::InputError(proofs, 0, fmt::format("the kind {} has no proofs", name()));
  }
  std::vector<PlannedSet> timed_sets(files::TomlTable& table,
                                     const std::filesystem::path& home) const override {
    if (parts_.sets == nullptr) table.fail("kind", "these have no timed sets of this form");
    return parts_.sets(table, home);
  }

 private:
  std::vector<Family> list_families() const override {
    return parts_.families == nullptr ? std::vector<Family>() : parts_.families();
  }

  KindParts<Entry> parts_;
};

}  // namespace touchstone::kinds
