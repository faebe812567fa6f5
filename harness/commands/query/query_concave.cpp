// Runs concave phases on cases, each in a child process, and writes a row for each answer.
#include "harness/commands/query/query_concave.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/hash.h"
#include "harness/commands/query/query_rows.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::commands {
namespace {

struct ConcaveAnswer {
  Outcome outcome;
  Status status = Status::unsupported;  // of the outcome too; the child's end is written here
  std::uint64_t pair_count = 0, pair_hash = 0;
};

// The answers of one algorithm for all cases, and the pairs of those that were asked for.
struct ConcaveAnswers {
  const ConcaveEntry* entry;
  std::vector<ConcaveAnswer> answers;
  std::vector<std::vector<IndexPair>> pairs;
  std::vector<std::vector<PartContact>> contacts;
};

class ConcaveQueryRun {
 public:
  ConcaveQueryRun(const ConcaveQuery& query, const std::vector<files::ConcaveCase>& cases)
      : query_(query), cases_(cases) {
    const auto* mid =
        kinds::select(registry::entries<MidPhaseEntry>(), {query.mid}, "mid-phase").at(0);
    const auto* parts =
        kinds::select(registry::entries<NarrowPhaseEntry>(), {query.parts}, "narrow phase").at(0);
    if (!answers_for_all(*parts)) {
      throw base::InputError(fmt::format(
          "--parts: the narrow phase '{}' does not answer every task for all convex shapes; "
          "expected one that does, such as certified",
          query.parts));
    }
    settings_ = {.scalar = query.scalar,
                 .mid_phase = mid->make,
                 .narrow_phase = [parts, &query] { return parts->make(query.settings); },
                 .tolerance = query.settings.tolerance,
                 .welds = query.welds};
  }

  ConcaveAnswers ask(const ConcaveEntry& entry) const {
    ConcaveAnswers all = {&entry, std::vector<ConcaveAnswer>(cases_.size()), {}, {}};
    all.pairs.resize(cases_.size());
    all.contacts.resize(cases_.size());
    std::vector<std::size_t> taken;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const bool supported = entry.supports == nullptr || entry.supports(cases_[i].a, cases_[i].b);
      if (supported && offers(entry, query_.task, query_.scalar)) taken.push_back(i);
    }
    const process::IsolationLimits limits = {.item_seconds = query_.time_limit};
    const auto solved = process::isolated_answers<ConcaveAnswer>(taken.size(), limits, [&] {
      return [&](std::size_t item) {
        std::vector<IndexPair> pairs;
        return solve(entry, cases_[taken[item]], pairs, nullptr);
      };
    });
    for (std::size_t item = 0; item < taken.size(); ++item) {
      all.answers[taken[item]] = solved.answers[item];
    }
    print_failures(entry.info.name, solved.failures, [&](std::size_t item) {
      return fmt::format("case '{}'", cases_[taken[item]].id);
    });
    if (!query_.pairs.empty() || !query_.contacts.empty()) fetch_pairs(all);
    return all;
  }

 private:
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

  ConcaveAnswer solve(const ConcaveEntry& entry, const files::ConcaveCase& c,
                      std::vector<IndexPair>& pairs, std::vector<PartContact>* contacts) const {
    const std::vector<ConcaveBody> bodies = {c.a, c.b};
    const std::unique_ptr<ConcavePhase> algorithm = entry.make(settings_);
    algorithm->bind(bodies);
    ConcaveAnswer answer;
    algorithm->solve(query_.task, {0, c.pose_a}, {1, c.pose_b}, answer.outcome, pairs);
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
  void fetch_pairs(ConcaveAnswers& all) const {
    std::vector<std::size_t> taken, first = {0};
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const std::size_t count = all.answers[i].pair_count;
      if (count == 0) continue;
      taken.push_back(i);
      first.push_back(first.back() + count);
    }
    if (taken.empty()) return;
    const bool measured =
        !query_.contacts.empty() && all.entry->measures && (!query_.welds || all.entry->welds);
    process::SharedArray<IndexPair> fetched(first.back());
    process::SharedArray<PartContact> fetched_contacts(measured ? first.back() : 1);
    const auto of_item = [&](auto& items, std::size_t item) {
      return items.span().subspan(first[item], first[item + 1] - first[item]);
    };
    const auto fill = [](const auto& from, const auto& to) {
      std::copy_n(from.begin(), std::min(from.size(), to.size()), to.begin());
    };
    const process::IsolationLimits limits = {.item_seconds = query_.time_limit};
    const auto report = process::isolate(taken.size(), limits, [&]() -> process::ItemWork {
      return [&](std::size_t item) {
        std::vector<IndexPair> pairs;
        std::vector<PartContact> contacts;
        solve(*all.entry, cases_[taken[item]], pairs, measured ? &contacts : nullptr);
        fill(pairs, of_item(fetched, item));
        if (measured) fill(contacts, of_item(fetched_contacts, item));
      };
    });
    print_failures(all.entry->info.name, report.failures, [&](std::size_t item) {
      return fmt::format("pairs of case '{}'", cases_[taken[item]].id);
    });
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

  const ConcaveQuery& query_;
  const std::vector<files::ConcaveCase>& cases_;
  ConcaveSettings settings_;
};

void write_pairs(const std::string& file, const std::vector<files::ConcaveCase>& cases,
                 const std::vector<ConcaveAnswers>& all) {
  files::CsvWriter csv(file, {"id", "algorithm", "a_part", "b_part"});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const ConcaveAnswers& answers : all) {
      for (const IndexPair& pair : answers.pairs[i]) {
        csv.field(cases[i].id)
            .field(answers.entry->info.name)
            .field(std::uint64_t{pair.a})
            .field(std::uint64_t{pair.b});
        csv.end_row();
      }
    }
  }
  csv.close();
}

// One row for each pair and each algorithm that has contacts.
void write_contacts(const std::string& file, const std::vector<files::ConcaveCase>& cases,
                    const std::vector<ConcaveAnswers>& all) {
  files::CsvWriter csv(file, {"id", "algorithm", "a_part", "b_part", "status", "depth", "normal_x",
                              "normal_y", "normal_z", "point_x", "point_y", "point_z", "welded"});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const ConcaveAnswers& answers : all) {
      for (const PartContact& contact : answers.contacts[i]) {
        csv.field(cases[i].id)
            .field(answers.entry->info.name)
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

}  // namespace

void query_concave(const ConcaveQuery& query, const std::vector<files::ConcaveCase>& cases) {
  const auto entries = kinds::select(registry::entries<ConcaveEntry>(),
                                     kinds::split_names(query.names), "concave phase");
  const ConcaveQueryRun run(query, cases);
  files::check_outputs(
      {{"CASES", query.cases}},
      {{"--out", query.out}, {"--pairs", query.pairs}, {"--contacts", query.contacts}});
  std::vector<ConcaveAnswers> all;
  all.reserve(entries.size());
  for (const ConcaveEntry* entry : entries) all.push_back(run.ask(*entry));

  const bool counts = query.task == ConcaveTask::contacts;
  std::vector<std::string> columns = query_columns();
  if (counts) columns.insert(columns.end(), {"pair_count", "pair_hash"});
  files::CsvWriter csv(query.out, columns);
  QuerySummary summary;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const ConcaveAnswers& answers : all) {
      const ConcaveAnswer& answer = answers.answers[i];
      Outcome outcome = answer.outcome;
      outcome.status = answer.status;
      summary.count(answers.entry->info.name, outcome);
      write_query_fields(
          csv,
          {cases[i].id, answers.entry->info.name, to_string(query.scalar), to_string(query.task)},
          outcome);
      if (counts && outcome.answer == Answer::unknown && answer.pair_count == 0) {
        csv.field("").field("");
      } else if (counts) {
        csv.field(answer.pair_count).field(base::to_hex(answer.pair_hash));
      }
      csv.end_row();
    }
  }
  csv.close();
  if (!query.pairs.empty()) write_pairs(query.pairs, cases, all);
  if (!query.contacts.empty()) write_contacts(query.contacts, cases, all);
  summary.print();
}

}  // namespace touchstone::commands
