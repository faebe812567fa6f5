// Reads the graded answers of a check, and compares those of a library's versions.
#include "harness/check/versions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "harness/files/csv.h"

namespace touchstone::check {
namespace {

// What one version answered.
struct Given {
  std::string answer;  // or how it failed
  bool is_wrong = false;
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

double number(std::string_view text) {
  return text.empty() ? Outcome::none : std::strtod(std::string(text).c_str(), nullptr);
}

class Comparison {
 public:
  explicit Comparison(const std::filesystem::path& file) {
    const std::vector<std::string> columns = {"algorithm",
                                              "scalar",
                                              "regime",
                                              "index",
                                              "task",
                                              "kind_a",
                                              "kind_b",
                                              "exact",
                                              "exact_lower",
                                              "exact_upper",
                                              "answer",
                                              "status",
                                              "end_verdict",
                                              "group",
                                              "scale",
                                              "end_margin",
                                              "end_distance_error",
                                              "end_depth_error"};
    files::CsvReader(file, columns).read([&](const files::CsvReader::Row& row) { add(row); });
  }

  VersionReport report() const {
    VersionReport report;
    for (const auto& [key, count] : counts_) {
      if (versions_.at(key.library).size() > 1) report.counts.push_back(count);
    }
    for (const auto& [key, graded] : cases_) add_changes(key, graded, report.changes);
    return report;
  }

 private:
  void add(const files::CsvReader::Row& row) {
    const std::string name(row.text(0));
    const std::size_t at = name.find('@');
    if (at == std::string::npos) return;
    const std::string library = name.substr(0, at), version = name.substr(at + 1);
    std::vector<std::string>& versions = versions_[library];
    auto place = std::ranges::find(versions, version);
    if (place == versions.end()) place = versions.insert(place, version);
    const auto number_of_version = static_cast<std::size_t>(place - versions.begin());

    const std::string scalar(row.text(1)), regime(row.text(2)), status(row.text(11)),
        verdict(row.text(12));
    double worst = 0;
    for (const std::size_t column : {std::size_t{15}, std::size_t{16}, std::size_t{17}}) {
      const double error = std::abs(number(row.text(column))) / row.number(14);
      if (error > worst) worst = error;
    }
    const bool has_failed = verdict == "crashed" || verdict == "timed_out";
    const bool has_answer = !has_failed && verdict != "honest_failure";
    const bool is_wrong = has_answer && worst > wrong_share;

    VersionCount& count = counts_[{library, number_of_version, scalar, std::string(row.text(13))}];
    count.library = library;
    count.version = version;
    count.scalar = scalar == "float" ? Precision::float32 : Precision::float64;
    count.group = row.text(13);
    ++count.answers;
    count.wrong += is_wrong ? 1 : 0;
    count.gave_up += verdict == "honest_failure" ? 1 : 0;
    count.failed += has_failed ? 1 : 0;
    if (is_wrong && !(worst <= count.worst)) {
      count.worst = worst;
      count.worst_case = fmt::format("{}/{}", regime, row.text(3));
    }

    GradedCase& graded =
        cases_[{library, scalar, regime, row.integer(3), std::string(row.text(4))}];
    VersionChange& exact = graded.exact;
    exact.library = library;
    exact.scalar = count.scalar;
    exact.regime = regime;
    exact.index = row.integer(3);
    exact.task = row.text(4);
    exact.kind_a = row.text(5);
    exact.kind_b = row.text(6);
    exact.exact = row.text(7);
    exact.exact_lower = number(row.text(8));
    exact.exact_upper = number(row.text(9));
    graded.answers[number_of_version] = {has_failed ? status : std::string(row.text(10)),
                                         is_wrong || has_failed};
  }

  void add_changes(const CaseKey& key, const GradedCase& graded,
                   std::vector<VersionChange>& changes) const {
    const std::vector<std::string>& versions = versions_.at(key.library);
    std::optional<std::size_t> last;
    for (const auto& [version, now] : graded.answers) {
      if (last) {
        const Given& before = graded.answers.at(*last);
        if (before.answer != now.answer || before.is_wrong != now.is_wrong) {
          VersionChange& change = changes.emplace_back(graded.exact);
          change.from = versions[*last];
          change.to = versions[version];
          change.before = before.answer;
          change.after = now.answer;
          change.became = before.is_wrong == now.is_wrong ? "other"
                          : now.is_wrong                  ? "wrong"
                                                          : "right";
        }
      }
      last = version;
    }
  }

  std::map<std::string, std::vector<std::string>> versions_;  // of each library, as they come
  std::map<CountKey, VersionCount> counts_;
  std::map<CaseKey, GradedCase> cases_;
};

}  // namespace

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
        name, sum.became["right"], sum.became["wrong"], sum.became["other"], first.task,
        first.regime, first.index, first.exact, first.before, first.after));
  }
  return lines;
}

VersionReport compare_versions(const CheckRequest& request) {
  std::map<std::string, std::set<std::string>> versions;
  for (const kinds::Contestant& one : request.contestants) {
    const std::string& name = one.info->name;
    const std::size_t at = name.find('@');
    if (at != std::string::npos) versions[name.substr(0, at)].insert(name);
  }
  if (std::ranges::none_of(versions, [](const auto& one) { return one.second.size() > 1; })) {
    return {};
  }
  VersionReport report = Comparison(request.out / "grades.csv").report();
  record::write_rows(request.out / "versions.csv", report.counts);
  record::write_rows(request.out / "version_changes.csv", report.changes);
  return report;
}

}  // namespace touchstone::check
