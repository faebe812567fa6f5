// Reads the graded answers of a check, and compares those of a library's versions.
#include "harness/check/versions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "harness/check/graded_answers.h"
#include "harness/check/wrong_pairs.h"
#include "harness/record/machine.h"

namespace touchstone::check {
namespace {

// What one version answered.
struct Given {
  std::string algorithm;
  std::string answer;  // or how it failed
  double error = 0;
  AnswerState state{};
};

struct CaseKey {
  std::string library, scalar, regime;
  std::int64_t index;
  std::string task;
  friend auto operator<=>(const CaseKey&, const CaseKey&) = default;
};

struct GradedCase {
  VersionChange exact;                   // what all versions have in common
  std::map<std::size_t, Given> answers;  // by the place of the version
};

struct CountKey {
  std::string library;
  std::size_t version;
  std::string scalar, group;
  friend auto operator<=>(const CountKey&, const CountKey&) = default;
};

struct Count {
  VersionCount row;
  std::map<std::pair<std::string, std::int64_t>, double> wrong_pairs;  // and their greatest errors
};

class Comparison {
 public:
  // `built_in` has the versions of libraries that are built in, by algorithm.
  Comparison(const std::filesystem::path& grades,
             const std::map<std::string, std::string>& built_in) {
    for_each_answer(grades, wrong_share, [&](CheckedAnswer one, std::int64_t) {
      if (one.version.empty()) {
        const auto at = built_in.find(one.algorithm);
        if (at == built_in.end()) return;
        one.version = at->second;
      }
      add(std::move(one));
    });
  }

  VersionReport report() const {
    VersionReport report;
    for (const auto& [key, count] : counts_) {
      VersionCount& row = report.counts.emplace_back(count.row);
      row.wrong_pairs = static_cast<std::int64_t>(count.wrong_pairs.size());
    }
    for (const auto& [key, graded] : cases_) add_changes(key, graded, report.changes);
    return report;
  }

  // The worst pairs of each count.
  std::vector<WrongPair> wrong_pairs() const {
    std::map<std::pair<std::string, std::int64_t>, WrongPair> chosen;
    for (const auto& [key, count] : counts_) {
      std::vector<std::pair<std::pair<std::string, std::int64_t>, double>> pairs(
          count.wrong_pairs.begin(), count.wrong_pairs.end());
      std::ranges::stable_sort(pairs, std::greater<>(), [](const auto& one) { return one.second; });
      if (pairs.size() > most_wrong_pairs) pairs.resize(most_wrong_pairs);
      for (const auto& [place, error] : pairs) {
        WrongPair& pair = chosen[place];
        pair.regime = place.first;
        pair.index = place.second;
        pair.group = key.group;
      }
    }
    // `signed`, the fullest task, is the last.
    for (auto one = cases_.rbegin(); one != cases_.rend(); ++one) {
      const auto at = chosen.find({one->first.regime, one->first.index});
      if (at != chosen.end()) add_answers(one->first, one->second, at->second);
    }
    std::vector<WrongPair> pairs;
    for (auto& [place, pair] : chosen) pairs.push_back(std::move(pair));
    return pairs;
  }

 private:
  void add(CheckedAnswer one) {
    std::vector<std::string>& versions = versions_[one.library];
    auto place = std::ranges::find(versions, one.version);
    if (place == versions.end()) place = versions.insert(place, one.version);
    const auto version = static_cast<std::size_t>(place - versions.begin());
    const std::string scalar(to_string(one.scalar));

    auto& [row, wrong_pairs] = counts_[{one.library, version, scalar, one.group}];
    row.library = one.library;
    row.version = one.version;
    row.algorithm = one.algorithm;
    row.scalar = one.scalar;
    row.group = one.group;
    ++row.answers;
    row.gave_up += one.state == AnswerState::gave_up ? 1 : 0;
    row.failed += one.state == AnswerState::failed ? 1 : 0;
    if (one.state == AnswerState::wrong) {
      ++row.wrong;
      double& worst = wrong_pairs[{one.regime, one.index}];
      worst = std::max(worst, one.error);
      if (!(one.error <= row.worst)) {
        row.worst = one.error;
        row.worst_case = one.case_name();
      }
    }

    GradedCase& graded = cases_[{one.library, scalar, one.regime, one.index, one.task}];
    graded.exact = change_of(one);
    graded.answers[version] = {std::move(one.algorithm), std::move(one.answer), one.error,
                               one.state};
  }

  void add_changes(const CaseKey& key, const GradedCase& graded,
                   std::vector<VersionChange>& changes) const {
    const std::vector<std::string>& versions = versions_.at(key.library);
    std::optional<std::size_t> last;
    for (const auto& [version, now] : graded.answers) {
      if (last) {
        const Given& before = graded.answers.at(*last);
        if (before.answer != now.answer || before.state != now.state) {
          VersionChange& change = changes.emplace_back(graded.exact);
          change.from = versions[*last];
          change.to = versions[version];
          change.before = before.answer;
          change.after = now.answer;
          change.error_before = before.error;
          change.error_after = now.error;
          change.became = became(before.state, now.state);
        }
      }
      last = version;
    }
  }

  // Adds the answers of all versions to a task, if it is the first in which one of them is wrong.
  void add_answers(const CaseKey& key, const GradedCase& graded, WrongPair& pair) const {
    const auto is_news = [&](const auto& one) {
      return one.second.state == AnswerState::wrong &&
             std::ranges::none_of(pair.answers, [&](const WrongPair::Given& other) {
               return other.algorithm == one.second.algorithm &&
                      to_string(other.scalar) == key.scalar && other.state == AnswerState::wrong;
             });
    };
    if (std::ranges::none_of(graded.answers, is_news)) return;
    for (const auto& [version, given] : graded.answers) {
      pair.answers.push_back({.algorithm = given.algorithm,
                              .scalar = graded.exact.scalar,
                              .task = key.task,
                              .state = given.state,
                              .error = given.error});
    }
  }

  std::map<std::string, std::vector<std::string>> versions_;  // of each library, as they come
  std::map<CountKey, Count> counts_;
  std::map<CaseKey, GradedCase> cases_;
};

// Whether it is a built-in library whose numbers are no bounds by design.
bool is_measured_by_number(const kinds::Contestant& one) {
  if (one.info->origin != Origin::peer || one.kind != &kinds::pair_kind()) return false;
  const Traits& traits = one.of<NarrowPhaseEntry>().traits;
  return !traits.depth_is_bound && !traits.approximate;
}

// That of bullet-gjk-epa is the fact `bullet`. Where the fact is a file, such as libccd.so.2.0, its end counts.
std::string built_in_version(const record::Facts& facts, const std::string& algorithm) {
  const std::string fact = record::value_of(facts, algorithm.substr(0, algorithm.find('-')));
  constexpr std::string_view mark = ".so.";
  const std::size_t at = fact.find(mark);
  return at == std::string::npos ? fact : fact.substr(at + mark.size());
}

}  // namespace

VersionChange change_of(const CheckedAnswer& one) {
  VersionChange change;
  change.library = one.library;
  change.scalar = one.scalar;
  change.regime = one.regime;
  change.index = one.index;
  change.kind_a = one.kind_a;
  change.kind_b = one.kind_b;
  change.task = one.task;
  change.exact = one.exact;
  change.exact_lower = one.exact_lower;
  change.exact_upper = one.exact_upper;
  return change;
}

base::Table VersionReport::table() const {
  base::Table table(
      {"library", "scalar", "answers", "wrong", "gave up", "failed", "worst", "in case"});
  std::vector<VersionCount> sums;
  for (const VersionCount& one : counts) {
    const auto is_same = [&](const VersionCount& sum) {
      return std::tie(sum.library, sum.version, sum.scalar) ==
             std::tie(one.library, one.version, one.scalar);
    };
    auto sum = std::ranges::find_if(sums, is_same);
    if (sum == sums.end()) {
      sums.push_back(one);
      continue;
    }
    sum->answers += one.answers;
    sum->wrong += one.wrong;
    sum->wrong_pairs += one.wrong_pairs;
    sum->gave_up += one.gave_up;
    sum->failed += one.failed;
    if (!std::isnan(one.worst) && !(one.worst <= sum->worst)) {
      sum->worst = one.worst;
      sum->worst_case = one.worst_case;
    }
  }
  for (const VersionCount& sum : sums) {
    table.add({sum.library + " " + sum.version, std::string(to_string(sum.scalar)),
               fmt::format("{}", sum.answers), fmt::format("{}", sum.wrong),
               fmt::format("{}", sum.gave_up), fmt::format("{}", sum.failed),
               std::isnan(sum.worst) ? "-" : fmt::format("{:.1e}", sum.worst),
               sum.worst_case.empty() ? "-" : sum.worst_case});
  }
  return table;
}

std::vector<std::string> VersionReport::since() const {
  struct Sum {
    std::map<std::string, int> became;
    const VersionChange* first = nullptr;
  };
  std::vector<std::pair<std::string, Sum>> sums;  // in the order of the versions
  for (const VersionChange& change : changes) {
    const std::string name = fmt::format("{} {}, from {} to {}", change.library,
                                         to_string(change.scalar), change.from, change.to);
    auto at = std::ranges::find(sums, name, &std::pair<std::string, Sum>::first);
    if (at == sums.end()) at = sums.insert(at, {name, {}});
    ++at->second.became[change.became];
    if (at->second.first == nullptr) at->second.first = &change;
  }
  std::vector<std::string> lines;
  for (auto& [name, sum] : sums) {
    const VersionChange& first = *sum.first;
    lines.push_back(fmt::format(
        "{}: {} answers became right, {} wrong, {} changed otherwise; the first is {} of {}/{}, "
        "exactly {}: {} became {}",
        name, sum.became["right"], sum.became["wrong"], sum.became["other"] + sum.became["lost"],
        first.task, first.regime, first.index, first.exact, first.before, first.after));
  }
  return lines;
}

VersionReport compare_versions(const CheckRequest& request) {
  std::map<std::string, std::set<std::string>> versions;
  std::map<std::string, std::string> built_in;
  const record::Facts facts = record::machine_facts();
  for (const kinds::Contestant& one : request.contestants) {
    const std::string& name = one.info->name;
    const auto [library, version] = library_and_version(name);
    if (!version.empty()) versions[library].insert(version);
    if (version.empty() && is_measured_by_number(one)) {
      built_in[name] = built_in_version(facts, name);
    }
  }
  if (std::ranges::none_of(versions, [](const auto& one) { return one.second.size() > 1; })) {
    return {};
  }
  const Comparison comparison(request.out / "grades.csv", built_in);
  VersionReport report = comparison.report();
  record::write_rows(request.out / "versions.csv", report.counts);
  record::write_rows(request.out / "version_changes.csv", report.changes);
  write_wrong_pairs(request, comparison.wrong_pairs());
  return report;
}

}  // namespace touchstone::check
