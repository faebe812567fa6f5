#include "harness/check/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "harness/check/margins.h"
#include "harness/io/csv.h"
#include "harness/run/machine.h"
#include "harness/run/text_table.h"

namespace touchstone {
namespace {

using Rows = std::vector<std::vector<std::string>>;

// The first digit and the exponent of an error; "-" where none was seen.
std::string digits(double x) {
  if (std::isnan(x)) return "-";
  return x == 0 ? "0" : fmt::format("{:.0e}", x);
}

std::string count(std::int64_t n) { return std::to_string(n); }

// An algorithm with its scalar.
struct Label {
  std::uint32_t entry;
  Precision scalar;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const Label&, const Label&) = default;
};

struct Totals {
  AnswerCount answers;
  FlipCount flips;
};

class Grouped {
 public:
  explicit Grouped(const CheckReport& report) : request_(*report.request) {
    for (const auto& [key, counted] : report.tally->answers()) {
      const std::string& group = request_.regimes[key.regime]->group;
      totals_[{key.entry, key.scalar}].answers.add(counted);
      by_group_[{{key.entry, key.scalar}, group}].add(counted);
    }
    for (const auto& [key, counted] : report.tally->flips()) {
      FlipCount& flips = totals_[{key.entry, key.scalar}].flips;
      flips.compared += counted.compared;
      flips.flips += counted.flips;
      flips.lost += counted.lost;
      flips.beyond += counted.beyond;
      flips.worst_flip = std::max(flips.worst_flip, counted.worst_flip);
      flips.worst_difference = std::max(flips.worst_difference, counted.worst_difference);
    }
    for (const Regime* regime : request_.regimes) {
      if (std::ranges::find(groups_, regime->group) == groups_.end()) {
        groups_.push_back(regime->group);
      }
    }
  }

  const std::map<Label, Totals>& totals() const { return totals_; }
  const std::vector<std::string>& groups() const { return groups_; }
  const AnswerCount* of(const Label& label, const std::string& group) const {
    const auto at = by_group_.find({label, group});
    return at == by_group_.end() ? nullptr : &at->second;
  }
  std::string name(const Label& label) const {
    return fmt::format("{} {}", request_.narrow[label.entry]->info.name, to_string(label.scalar));
  }
  bool is_ours(const Label& label) const {
    return request_.narrow[label.entry]->info.origin == Origin::ours;
  }

 private:
  const CheckRequest& request_;
  std::map<Label, Totals> totals_;
  std::map<std::pair<Label, std::string>, AnswerCount> by_group_;
  std::vector<std::string> groups_;
};

Rows summary_rows(const Grouped& grouped) {
  Rows rows = {{"", "answers", "silent", "margin", "honest", "unsaid", "lost", "gap", "deep",
                "shallow", "stuck", "bounds", "flips", "beyond"}};
  for (const auto& [label, totals] : grouped.totals()) {
    const AnswerCount& a = totals.answers;
    rows.push_back({grouped.name(label), count(a.answers), count(a.silent), digits(a.margin),
                    count(a.honest), count(a.not_reported), count(a.crashed + a.timed_out),
                    digits(a.distance), digits(a.too_deep), digits(a.too_shallow),
                    digits(a.does_not_separate), count(a.bounds), count(totals.flips.flips),
                    grouped.is_ours(label) ? count(a.beyond + totals.flips.beyond) : "-"});
  }
  return rows;
}

constexpr std::size_t shown_lines = 30;  // of what is wrong of ours

constexpr std::string_view summary_key =
    "silent: on the wrong side of contact, with a status that does not tell; margin: the greatest\n"
    "exact |signed distance| of those; honest: failures that were told; unsaid: answers whose\n"
    "status says nothing; lost: crashed or hung; gap, too deep, shallow: the greatest errors of\n"
    "distance and depth; stuck: by how far the reported translation does not separate; bounds:\n"
    "certified bounds that miss the exact value; flips: other answers to the same pair in another\n"
    "form; beyond: ours, beyond the documented margins. All against the exact answer for the bits\n"
    "that the algorithm was given; lengths as parts of the pair's size.\n";

struct Checked {
  std::int64_t cases = 0, unresolved = 0, proven = 0, refused = 0, boxes = 0, boxes_broken = 0;

  explicit Checked(const Tally& tally) {
    for (const JobSummary& job : tally.jobs()) {
      cases += job.cases;
      unresolved += job.unresolved;
      proven += job.proven;
      refused += job.refused;
      boxes += job.boxes;
      boxes_broken += job.boxes_broken;
    }
  }
};

std::string checked_text(const CheckReport& report) {
  const Checked checked(*report.tally);
  std::string text = fmt::format(
      "{} cases, {} of them undecided by the oracle's enclosure; {} exact answers proven by a "
      "certificate, {} refused.\n{} boxes of bodies hold all of their body, {} do not.\n",
      checked.cases, checked.unresolved, checked.proven, checked.refused,
      checked.boxes - checked.boxes_broken, checked.boxes_broken);
  std::map<const BroadPhaseEntry*, std::pair<int, int>> broad;  // good, all
  std::int64_t pairs = 0;
  for (const BroadCheck& check : report.broad) {
    auto& [good, all] = broad[check.entry];
    good += check.good() ? 1 : 0;
    ++all;
    if (check.entry == report.broad.front().entry) pairs += check.pairs;
  }
  if (!broad.empty()) {
    int good = 0;
    for (const auto& [entry, counts] : broad) good += counts.first == counts.second ? 1 : 0;
    text += fmt::format("{} of {} broad phases find all pairs of all {} box scenes ({} pairs).\n",
                        good, broad.size(), broad.begin()->second.second, pairs);
  }
  return text;
}

// The first column is to the left, the others to the right, or all to the left where they are
// texts.
std::string markdown(const Rows& rows, bool are_texts = false) {
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const std::string& cell : rows[r]) {
      std::string escaped = cell;
      for (std::size_t at = 0; (at = escaped.find('|', at)) != std::string::npos; at += 2) {
        escaped.insert(at, 1, '\\');
      }
      text += "| " + escaped + ' ';
    }
    text += "|\n";
    if (r > 0) continue;
    text += "|---|";
    for (std::size_t i = 1; i < rows[r].size(); ++i) text += are_texts ? "---|" : "---:|";
    text += '\n';
  }
  return text;
}

}  // namespace

std::vector<std::string> CheckReport::ours_wrong() const {
  std::vector<std::string> lines;
  for (const FailureCase& failure : failures) {
    if (!failure.answer.beyond) continue;
    lines.push_back(fmt::format("{} {} {} on {}: {}",
                                request->narrow[failure.answer.entry]->info.name,
                                to_string(failure.answer.scalar), to_string(failure.answer.task),
                                failure.id, failure.what));
  }
  for (const VariantFailure& failure : variant_failures) {
    const VariantCount& count = failure.count;
    lines.push_back(fmt::format(
        "{} {} {} on {} and its variant '{}': {} answers in another form differ, by {:.0e} of the "
        "size",
        request->narrow[count.entry]->info.name, to_string(count.scalar), to_string(count.task),
        failure.id, count.name(), count.beyond,
        std::max(count.worst_flip, count.worst_difference)));
  }
  for (const TruthFailure& failure : truth_failures) {
    lines.push_back(fmt::format(
        "{}: {} certificates of the oracle refused, {} boxes that do not hold their body; first {} "
        "in {}",
        request->regimes[failure.job.regime]->name, failure.job.refused, failure.job.boxes_broken,
        failure.id, failure.file.string()));
  }
  for (const BroadCheck& check : broad) {
    if (check.good() || check.entry->info.origin != Origin::ours) continue;
    lines.push_back(fmt::format("{} on boxes '{}', seed {}: {}", check.entry->info.name,
                                check.scene->name, request->seed, check.faults()));
  }
  return lines;
}

std::string summary_text(const CheckReport& report, std::size_t page_width) {
  const Rows rows = summary_rows(Grouped(report));
  TextTable table(rows.front());
  for (std::size_t i = 1; i < rows.size(); ++i) table.add(rows[i]);
  std::string text = table.text(page_width) + '\n' + std::string(summary_key) + '\n';
  text += checked_text(report);
  for (const BroadPhaseEntry* entry : report.request->broad) {
    std::string scenes;
    for (const BroadCheck& check : report.broad) {
      if (check.entry != entry || check.good() || entry->info.origin == Origin::ours) continue;
      scenes += (scenes.empty() ? "" : ", ") + check.scene->name;
    }
    if (!scenes.empty()) text += fmt::format("  {} is wrong on: {}\n", entry->info.name, scenes);
  }
  const std::vector<std::string> wrong = report.ours_wrong();
  if (wrong.empty()) return text + "None of our own algorithms is wrong beyond its margin.\n";
  text += fmt::format("\nOurs, wrong beyond the documented margin: {}\n", wrong.size());
  for (std::size_t i = 0; i < std::min(wrong.size(), shown_lines); ++i) {
    text += "  " + wrong[i] + '\n';
  }
  if (wrong.size() > shown_lines) {
    text += fmt::format("  and {} more like them\n", wrong.size() - shown_lines);
  }
  std::set<std::string> commands;
  for (const FailureCase& failure : report.failures) {
    if (failure.answer.beyond) commands.insert(failure.command(*report.request));
  }
  for (const VariantFailure& failure : report.variant_failures) {
    commands.insert(query_command(*report.request, failure.query, failure.file));
  }
  if (!commands.empty()) text += "Shown by\n";
  for (const std::string& command : commands) text += "  " + command + '\n';
  return text;
}

void write_summary(const CheckReport& report, const std::filesystem::path& file) {
  CsvWriter csv(
      file,
      {"algorithm",     "scalar",        "regime",           "group",           "answers",
       "silent",        "silent_end",    "honest",           "not_reported",    "crashed",
       "timed_out",     "touching",      "touching_contact", "bounds",          "not_a_number",
       "beyond_margin", "honest_margin", "margin",           "margin_end",      "distance",
       "distance_end",  "too_deep",      "too_shallow",      "depth_end",       "does_not_separate",
       "excess",        "bounds_missed", "witness",          "witness_length",  "normal",
       "variants",      "flips",         "worst_flip",       "worst_difference"});
  const CheckRequest& request = *report.request;
  for (const auto& [key, a] : report.tally->answers()) {
    const Regime& regime = *request.regimes[key.regime];
    csv.field(request.narrow[key.entry]->info.name).field(to_string(key.scalar));
    csv.field(regime.name).field(regime.group);
    for (const std::int64_t n :
         {a.answers, a.silent, a.silent_end, a.honest, a.not_reported, a.crashed, a.timed_out,
          a.touching, a.touching_contact, a.bounds, a.not_a_number, a.beyond}) {
      csv.field(n);
    }
    for (const double x : {a.honest_margin, a.margin, a.margin_end, a.distance, a.distance_end,
                           a.too_deep, a.too_shallow, a.depth_end, a.does_not_separate, a.excess,
                           a.bounds_missed, a.witness, a.witness_length, a.normal}) {
      csv.field(x);
    }
    const auto flips = report.tally->flips().find(key);
    const FlipCount f = flips == report.tally->flips().end() ? FlipCount() : flips->second;
    csv.field(f.compared).field(f.flips).field(f.worst_flip).field(f.worst_difference);
    csv.end_row();
  }
  csv.close();
}

std::string page_text(const CheckReport& report, const std::string& command) {
  const CheckRequest& request = *report.request;
  const Grouped grouped(report);
  std::string text = "# Who is wrong where\n\n";
  text += fmt::format(
      "Made by `{}` (seed {}, {} cases of each of {} regimes in a round). Every answer is graded "
      "against exact arithmetic. Lengths are parts of the pair's size, or of its distance where "
      "that is greater; each number is the greatest that was seen.\n\n",
      command, request.seed, request.cases, request.regimes.size());
  for (const auto& [name, value] : machine_facts()) {
    for (const char* wanted : {"compiler", "bullet", "fcl", "libccd", "ode", "mujoco", "embree", "cgal",
                               "boost_geometry", "commit"}) {
      if (name == wanted) text += fmt::format("- {}: {}\n", name, value);
    }
  }

  text +=
      "\n## Side of contact\n\nA silent error is an answer on the wrong side of contact whose "
      "status does not tell. *Given* is against the exact answer for the bits that the "
      "algorithm was given, after conversion to float or to a quaternion; *end to end* is "
      "against the pair as the case has it. *Margin* is the greatest exact distance or depth "
      "of a pair that was called wrongly; an honest "
      "failure is one that the algorithm told of, up to that distance or depth. Pairs that touch "
      "exactly are not scored: the column "
      "says how many of them were called contact.\n\n";
  Rows rows = {{"algorithm", "answers", "silent, given", "margin", "silent, end to end", "margin",
                "honest failures", "up to", "status says nothing", "crashed", "hung",
                "touching: contact"}};
  for (const auto& [label, totals] : grouped.totals()) {
    const AnswerCount& a = totals.answers;
    rows.push_back({grouped.name(label), count(a.answers), count(a.silent), digits(a.margin),
                    count(a.silent_end), digits(a.margin_end), count(a.honest),
                    digits(a.honest_margin), count(a.not_reported), count(a.crashed),
                    count(a.timed_out), fmt::format("{} of {}", a.touching_contact, a.touching)});
  }
  text += markdown(rows);

  text +=
      "\n## Distances and depths\n\n*Stuck*: by how far the reported translation does not "
      "separate the bodies; *excess*: by how far the reported direction needs more than the "
      "least translation. *Off body*: how far a witness point is from its body. *Bounds*: how "
      "many certified bounds miss the exact value. A depth marked `<=` is labelled as an upper "
      "bound.\n\n";
  rows = {{"algorithm", "distance", "end to end", "too deep", "too shallow", "end to end", "stuck",
           "excess", "off body", "bounds", "NaN"}};
  for (const auto& [label, totals] : grouped.totals()) {
    const AnswerCount& a = totals.answers;
    const bool is_bound = request.narrow[label.entry]->depth_is_bound;
    rows.push_back({grouped.name(label), digits(a.distance), digits(a.distance_end),
                    (is_bound ? "<= " : "") + digits(a.too_deep), digits(a.too_shallow),
                    digits(a.depth_end), digits(a.does_not_separate), digits(a.excess),
                    digits(a.witness), count(a.bounds), count(a.not_a_number)});
  }
  text += markdown(rows);

  text +=
      "\n## Silent errors by group of regimes\n\nHow many answers were silent errors against "
      "what was given, and the margin.\n\n";
  rows = {{"algorithm"}};
  for (const std::string& group : grouped.groups()) rows.front().push_back(group);
  for (const auto& [label, totals] : grouped.totals()) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(grouped.name(label));
    for (const std::string& group : grouped.groups()) {
      const AnswerCount* a = grouped.of(label, group);
      row.push_back(a == nullptr     ? ""
                    : a->silent == 0 ? "0"
                                     : fmt::format("{} ({})", a->silent, digits(a->margin)));
    }
  }
  text += markdown(rows);

  text +=
      "\n## Worst depth by group of regimes\n\nThe greater of too deep and too shallow, "
      "against what was given; distances where the algorithm has no depth.\n\n";
  rows = {{"algorithm"}};
  for (const std::string& group : grouped.groups()) rows.front().push_back(group);
  for (const auto& [label, totals] : grouped.totals()) {
    std::vector<std::string>& row = rows.emplace_back();
    row.push_back(grouped.name(label));
    for (const std::string& group : grouped.groups()) {
      const AnswerCount* a = grouped.of(label, group);
      double worst = Grade::none;
      if (a != nullptr) worst = std::fmax(a->too_deep, a->too_shallow);
      if (a != nullptr && std::isnan(worst)) worst = a->distance;
      row.push_back(a == nullptr ? "" : digits(worst));
    }
  }
  text += markdown(rows);

  text +=
      "\n## The same pair in another form\n\nSwapped, moved and scaled exactly, or with its "
      "vertices in another order, a pair has the same answer.\n\n";
  rows = {{"algorithm", "compared", "other side of contact", "margin", "worst difference"}};
  for (const auto& [label, totals] : grouped.totals()) {
    const FlipCount& f = totals.flips;
    rows.push_back({grouped.name(label), count(f.compared), count(f.flips), digits(f.worst_flip),
                    digits(f.worst_difference)});
  }
  text += markdown(rows);

  if (!report.broad.empty()) {
    text +=
        "\n## Broad phases\n\nAgainst every pair of closed boxes, on scenes that touch, "
        "coincide, have no volume, or are huge, tiny or far away.\n\n";
    rows = {{"algorithm", "scenes", "wrong", "first fault"}};
    for (const BroadPhaseEntry* entry : request.broad) {
      int scenes = 0, wrong = 0;
      std::string first;
      for (const BroadCheck& check : report.broad) {
        if (check.entry != entry) continue;
        ++scenes;
        if (check.good()) continue;
        if (wrong++ == 0) {
          const std::string faults = check.faults();
          first = fmt::format("{}: {}", check.scene->name, faults.substr(0, faults.find(';')));
        }
      }
      rows.push_back({entry->info.name, count(scenes), count(wrong), first});
    }
    text += markdown(rows, true);
  }

  text += "\n## What was checked beside them\n\n" + checked_text(report);
  text +=
      "\n## One failure of each\n\nThe worst of each algorithm. The case files are what "
      "`check` leaves in its folder; `touchstone query` shows each again.\n\n";
  std::map<Label, const FailureCase*> worst;
  for (const FailureCase& failure : report.failures) {
    const FailureCase*& slot = worst[{failure.answer.entry, failure.answer.scalar}];
    if (slot == nullptr || badness(failure.answer) > badness(slot->answer)) slot = &failure;
  }
  rows = {{"algorithm", "task", "case", "what"}};
  for (const auto& [label, failure] : worst) {
    rows.push_back({grouped.name(label), std::string(to_string(failure->answer.task)), failure->id,
                    failure->what});
  }
  if (worst.empty()) return text + "None.\n";
  return text + markdown(rows, true);
}

}  // namespace touchstone
