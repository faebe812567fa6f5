// Joins the answers of two checks.
#include "harness/check/changed_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "harness/base/error.h"
#include "harness/check/graded_answers.h"
#include "harness/files/csv.h"
#include "harness/files/packed_files.h"
#include "harness/record/machine.h"

namespace touchstone::check {
namespace {

namespace fs = std::filesystem;

fs::path grades_of(const fs::path& folder) { return files::row_file(folder / "grades.csv"); }
fs::path families_of(const fs::path& folder) { return files::row_file(folder / "families.csv"); }

// Throws InputError if the request of B asks for other cases than that of A.
void compare_requests(const fs::path& a, const fs::path& b) {
  const record::Facts facts_a = record::read_facts(a / "machine.csv");
  const record::Facts facts_b = record::read_facts(b / "machine.csv");
  for (const char* fact : {"mode", "seed", "cases", "families"}) {
    const std::string in_a = record::value_of(facts_a, fact),
                      in_b = record::value_of(facts_b, fact);
    if (in_a == in_b) continue;
    throw base::InputError(
        (b / "machine.csv").string(), 0,
        fmt::format("{}: found '{}'; expected '{}', as in {}: a comparison takes "
                    "two checks of the same cases",
                    fact, in_b, in_a, a.string()));
  }
}

using LibraryKey = std::pair<std::string, Precision>;

// The version of each library of a folder. Throws InputError for a second one.
class Versions {
 public:
  explicit Versions(fs::path file) : file_(std::move(file)) {}

  void take(const std::string& library, const std::string& version, std::int64_t line) {
    const auto [at, is_new] = versions_.emplace(library, version);
    if (is_new || at->second == version) return;
    throw base::InputError(
        file_.string(), line,
        fmt::format("found version {} of {} beside {}; expected one version of a "
                    "library, to be compared with that of the other folder",
                    version, library, at->second));
  }
  bool has(const std::string& library) const { return versions_.contains(library); }
  const std::string& of(const std::string& library) const { return versions_.at(library); }

 private:
  fs::path file_;
  std::map<std::string, std::string> versions_;
};

struct AnswerKey {
  std::string library, scalar, regime;
  std::int64_t index;
  std::string task;
  friend auto operator<=>(const AnswerKey&, const AnswerKey&) = default;
};

AnswerKey key_of(const CheckedAnswer& one) {
  return {one.library, std::string(to_string(one.scalar)), one.regime, one.index, one.task};
}

// Whether two rows may be about one pair: both enclosures hold its distance.
bool is_same_case(const CheckedAnswer& a, const CheckedAnswer& b) {
  if (a.kind_a != b.kind_a || a.kind_b != b.kind_b) return false;
  return !(a.exact_lower > b.exact_upper) && !(b.exact_lower > a.exact_upper);
}

class Comparing {
 public:
  Comparing(fs::path a, fs::path b, double max_error)
      : a_(std::move(a)), b_(std::move(b)), max_error_(max_error) {}

  AnswerComparison result() {
    if (fs::exists(grades_of(a_)) || fs::exists(grades_of(b_))) compare_pairs();
    if (fs::exists(families_of(a_)) || fs::exists(families_of(b_))) compare_families();
    for (auto& [key, count] : counts_) report_.counts.push_back(std::move(count));
    if (report_.counts.empty()) {
      throw base::InputError(
          grades_of(b_).string(), 0,
          "has no answers; expected those of a library that " + a_.string() + " has, too");
    }
    return std::move(report_);
  }

 private:
  AnswerCount& count_of(const std::string& library, Precision scalar, const std::string& version_a,
                        const std::string& version_b) {
    AnswerCount& count = counts_[{library, scalar}];
    count.library = library;
    count.scalar = scalar;
    count.version_a = version_a;
    count.version_b = version_b;
    return count;
  }

  static void add(AnswerCount& count, std::string_view change, std::int64_t answers = 1) {
    (change == "wrong"   ? count.wrong
     : change == "right" ? count.right
     : change == "lost"  ? count.lost
                         : count.other) += answers;
  }

  void remark_new(const std::map<std::string, std::int64_t>& only_in_b) {
    for (const auto& [library, answers] : only_in_b) {
      report_.remarks.push_back(fmt::format("{} answers of {} are in B alone", answers, library));
    }
  }

  // Throws InputError for a library that B lacks.
  void expect_in_b(const std::string& library, const Versions& versions_b, const fs::path& file) {
    if (versions_b.has(library)) return;
    throw base::InputError(
        file.string(), 0,
        fmt::format("has no answers of {}; expected them, as {} has them", library, a_.string()));
  }

  void compare_pairs() {
    Versions versions_a(grades_of(a_)), versions_b(grades_of(b_));
    std::map<AnswerKey, CheckedAnswer> before;
    for_each_answer(grades_of(a_), max_error_, [&](CheckedAnswer one, std::int64_t line) {
      versions_a.take(one.library, one.version, line);
      AnswerKey key = key_of(one);
      before.insert_or_assign(std::move(key), std::move(one));
    });
    std::map<std::string, std::int64_t> only_in_b;
    for_each_answer(grades_of(b_), max_error_, [&](const CheckedAnswer& now, std::int64_t line) {
      versions_b.take(now.library, now.version, line);
      const auto at = before.find(key_of(now));
      if (at == before.end()) {
        ++only_in_b[now.library];
        return;
      }
      if (!is_same_case(at->second, now)) {
        throw base::InputError(
            grades_of(b_).string(), line,
            fmt::format(
                "found {}, {} and {}, {} to {} m apart; expected the pair that {} has there, "
                "{} and {}, {} to {} m apart",
                now.case_name(), now.kind_a, now.kind_b, now.exact_lower, now.exact_upper,
                a_.string(), at->second.kind_a, at->second.kind_b, at->second.exact_lower,
                at->second.exact_upper));
      }
      compare(at->second, &now, now.version);
      before.erase(at);
    });
    for (const auto& [key, one] : before) {  // B did not ask them, so it takes less than A did
      expect_in_b(one.library, versions_b, grades_of(b_));
      compare(one, nullptr, versions_b.of(one.library));
    }
    std::ranges::sort(report_.changes, {}, [](const VersionChange& one) {
      return std::tie(one.library, one.scalar, one.regime, one.index, one.task);
    });
    remark_new(only_in_b);
  }

  // `now` is null for what B was not asked.
  void compare(const CheckedAnswer& before, const CheckedAnswer* now,
               const std::string& version_b) {
    AnswerCount& count = count_of(before.library, before.scalar, before.version, version_b);
    if (now != nullptr) {
      ++count.compared;
      if (before.answer == now->answer && before.state == now->state) return;
    }
    VersionChange change = change_of(before);
    change.from = before.version;
    change.to = version_b;
    change.before = before.answer;
    change.after = now != nullptr ? now->answer : "not asked";
    change.error_before = before.error;
    change.error_after = now != nullptr ? now->error : 0;
    change.became = became(before.state, now != nullptr ? now->state : AnswerState::gave_up);
    add(count, change.became);
    report_.changes.push_back(std::move(change));
  }

  // Family, algorithm, form and round.
  using FamilyKey = std::tuple<std::string, std::string, std::string, std::int64_t>;
  struct FamilyRow {
    std::string version;
    std::int64_t cases = 0, right = 0;
  };

  static void for_each_family(
      const fs::path& file, Versions& versions,
      const std::function<void(FamilyKey, FamilyRow, std::int64_t line)>& each) {
    const std::vector<std::string> columns = {"family", "algorithm", "form",
                                              "round",  "cases",     "right"};
    files::CsvReader(file, columns).read([&](const files::CsvReader::Row& row) {
      auto [library, version] = library_and_version(row.text(1));
      versions.take(library, version, row.line());
      each({std::string(row.text(0)), std::move(library), std::string(row.text(2)), row.integer(3)},
           {std::move(version), row.integer(4), row.integer(5)}, row.line());
    });
  }

  void compare_families() {
    Versions versions_a(families_of(a_)), versions_b(families_of(b_));
    std::map<FamilyKey, FamilyRow> before;
    for_each_family(families_of(a_), versions_a, [&](FamilyKey key, FamilyRow row, std::int64_t) {
      before.insert_or_assign(std::move(key), std::move(row));
    });
    std::map<std::string, std::int64_t> only_in_b;
    for_each_family(families_of(b_), versions_b,
                    [&](const FamilyKey& key, FamilyRow now, std::int64_t line) {
                      const auto at = before.find(key);
                      if (at == before.end()) {
                        only_in_b[std::get<1>(key)] += now.cases;
                        return;
                      }
                      if (at->second.cases != now.cases) {
                        throw base::InputError(
                            families_of(b_).string(), line,
                            fmt::format("cases: found {}; expected {}, as {} has of {}", now.cases,
                                        at->second.cases, a_.string(), std::get<0>(key)));
                      }
                      compare(key, at->second, now);
                      before.erase(at);
                    });
    for (const auto& [key, row] : before) {
      const std::string& library = std::get<1>(key);
      expect_in_b(library, versions_b, families_of(b_));
      compare(key, row, {versions_b.of(library), 0, 0});
    }
    remark_new(only_in_b);
  }

  void compare(const FamilyKey& key, const FamilyRow& before, const FamilyRow& now) {
    const auto& [family, algorithm, form, round] = key;
    const bool is_float = algorithm.find(" float") != std::string::npos;
    AnswerCount& count = count_of(algorithm, is_float ? Precision::float32 : Precision::float64,
                                  before.version, now.version);
    count.compared += now.cases;
    if (before.right == now.right) return;
    VersionChange change;
    change.library = algorithm;
    change.scalar = count.scalar;
    change.from = before.version;
    change.to = now.version;
    change.regime = family;
    change.index = -1;
    change.exact_lower = change.exact_upper = Outcome::none;
    change.before = fmt::format("{} of {} right", before.right, before.cases);
    change.after = fmt::format("{} of {} right", now.right, now.cases);
    const bool is_worse = now.right < before.right;
    change.became = is_worse ? (now.cases == 0 ? "lost" : "wrong") : "right";
    add(count, change.became, std::abs(now.right - before.right));
    report_.changes.push_back(std::move(change));
  }

  const fs::path a_, b_;
  const double max_error_;
  std::map<LibraryKey, AnswerCount> counts_;
  AnswerComparison report_;
};

}  // namespace

bool AnswerComparison::has_regressed() const {
  return std::ranges::any_of(counts,
                             [](const AnswerCount& one) { return one.wrong > 0 || one.lost > 0; });
}

bool is_of_check(const fs::path& folder) {
  return fs::exists(grades_of(folder)) || fs::exists(families_of(folder));
}

AnswerComparison compare_answers(const fs::path& a, const fs::path& b, double max_error) {
  for (const fs::path& folder : {a, b}) {
    if (is_of_check(folder)) continue;
    throw base::InputError(
        folder.string(), 0,
        "has neither grades.csv nor families.csv; expected a folder that `check` "
        "wrote, as the other is");
  }
  compare_requests(a, b);
  return Comparing(a, b, max_error).result();
}

}  // namespace touchstone::check
