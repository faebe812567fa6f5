// Compares two results cell by cell.
#include "harness/stats/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace touchstone::stats {
namespace {

constexpr double significance = 0.05;

void correct(std::vector<ComparedCell>& cells) {
  std::vector<double> p;
  for (const ComparedCell& cell : cells) p.push_back(cell.p);
  const std::vector<double> corrected = holm(p);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i].p_corrected = corrected[i];
}

// Returns the log of the median over the squares, which is the value of a whole run.
double log_of_run(const Results& run, const SetKey& key, const std::string& label, Noise noise) {
  const SampleSet* const set = run.find(key);
  const Contestant* const contestant = set == nullptr ? nullptr : set->find(label);
  if (contestant == nullptr) return std::numeric_limits<double>::quiet_NaN();
  return median(logs(by_square(*contestant, noise)));
}

// A value that a verified frame must reproduce to the digit, and that differs.
struct Change {
  std::string name, in_a, in_b;
};

std::optional<Change> change(const Check& a, const Check& b) {
  const auto known = [](std::int64_t n) { return n < 0 ? std::string("none") : std::to_string(n); };
  if (a.pair_count != b.pair_count) {
    return Change{"pair count", known(a.pair_count), known(b.pair_count)};
  }
  if (a.pair_hash != b.pair_hash) return Change{"pair hash", a.pair_hash, b.pair_hash};
  if (a.grade != b.grade) return Change{"grade", a.grade, b.grade};
  if (a.contact_count != b.contact_count) {
    return Change{"contact count", known(a.contact_count), known(b.contact_count)};
  }
  return std::nullopt;
}

// Returns a change of the work counters. A build that cannot count something is not compared by it;
// and a peer's use of the heap depends on the versions of the libraries below it.
std::optional<Change> changed_work(const Check& a, const Check& b, bool ours) {
  for (std::size_t i = 0; i < work_count; ++i) {
    const auto work = static_cast<Work>(i);
    const bool of_heap = work == Work::allocations || work == Work::allocated_bytes;
    if (a.work[i] == b.work[i] || a.work[i] < 0 || b.work[i] < 0 || (of_heap && !ours)) continue;
    std::string name(to_string(work));
    std::ranges::replace(name, '_', ' ');
    return Change{name, std::to_string(a.work[i]), std::to_string(b.work[i])};
  }
  return std::nullopt;
}

// Calls visit(set of A, contestant of A, contestant of B) for each contestant that both have.
template <class Visit>
void for_each_common(const Results& a, const Results& b, const Visit& visit) {
  for (const SampleSet& set : a.sets) {
    const SampleSet* const other = b.find(set.key);
    if (other == nullptr) continue;
    for (const Contestant& contestant : set.contestants) {
      if (const Contestant* const match = other->find(contestant.label)) {
        visit(set, contestant, *match);
      }
    }
  }
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::same: return "same";
    case Verdict::faster: return "faster";
    case Verdict::not_slower: return "not slower";
    case Verdict::slower: return "SLOWER";
    case Verdict::undecided: return "undecided";
  }
  return "?";
}

Verdict verdict(const ComparedCell& cell, double threshold) {
  const double high = 1 + threshold;
  const double low = 1 / high;
  const MedianInterval& ratio = cell.ratio;
  // Comparisons with a missing end (NaN) are false.
  if (ratio.low > high && cell.p_corrected < significance) return Verdict::slower;
  if (ratio.high < low) return Verdict::faster;
  if (ratio.low >= low && ratio.high <= high) return Verdict::same;
  if (ratio.high <= high) return Verdict::not_slower;
  return Verdict::undecided;
}

std::vector<std::string> changed_answers(const Results& a, const Results& b, Compared what,
                                         const ResultNames& names) {
  std::vector<std::string> lines;
  for_each_common(a, b, [&](const SampleSet& set, const Contestant& in_a, const Contestant& in_b) {
    const std::string where = fmt::format("{} in {}", in_a.label, set.key.words());
    if (!in_a.failure && in_b.failure) {
      lines.push_back(fmt::format("{}: {} in {}", where, to_string(*in_b.failure), names.b));
      return;
    }
    std::map<std::pair<std::int64_t, record::Phase>, const Check*> by_frame;
    for (const Check& check : in_b.checks) by_frame[{check.frame, check.phase}] = &check;
    for (const Check& check : in_a.checks) {
      const auto at = by_frame.find({check.frame, check.phase});
      if (at == by_frame.end()) continue;
      std::optional<Change> found = change(check, *at->second);
      if (!found && what == Compared::answers_and_work) {
        found = changed_work(check, *at->second, in_a.is_ours());
      }
      if (!found) continue;
      lines.push_back(fmt::format("{}, frame {}: {} {} in {}, {} in {}", where, check.frame,
                                  found->name, found->in_a, names.a, found->in_b, names.b));
      return;  // the first frame is the example of all
    }
  });
  return lines;
}

std::vector<ComparedCell> compare(const Results& a, const Results& b, Noise noise) {
  std::vector<ComparedCell> cells;
  for_each_common(a, b, [&](const SampleSet& set, const Contestant& in_a, const Contestant& in_b) {
    const std::vector<double> of_a = logs(by_square(in_a, noise));
    const std::vector<double> of_b = logs(by_square(in_b, noise));
    if (of_a.empty() && of_b.empty() && in_a.failure) return;  // it has no times
    MedianInterval ratio = exponential(shift(of_a, of_b, usual_confidence));
    if (ratio.n < fewest_squares) ratio.low = ratio.high = std::nan("");
    cells.push_back(
        {set.key, in_a.label, ratio, mann_whitney(of_a, of_b), 1, of_a.size(), of_b.size()});
  });
  correct(cells);
  return cells;
}

std::vector<ComparedCell> compare_runs(std::span<const Results> a, std::span<const Results> b,
                                       Noise noise) {
  std::vector<ComparedCell> cells;
  for_each_common(a[0], b[0], [&](const SampleSet& set, const Contestant& in_a, const Contestant&) {
    std::vector<double> of_a, of_b, ratios;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double run_a = log_of_run(a[i], set.key, in_a.label, noise);
      const double run_b = log_of_run(b[i], set.key, in_a.label, noise);
      if (!std::isnan(run_a)) of_a.push_back(run_a);
      if (!std::isnan(run_b)) of_b.push_back(run_b);
      if (!std::isnan(run_a + run_b)) ratios.push_back(run_b - run_a);
    }
    if (of_a.empty() && of_b.empty() && in_a.failure) return;
    cells.push_back({set.key, in_a.label, exponential(median_interval(ratios, usual_confidence)),
                     mann_whitney(of_a, of_b), 1, of_a.size(), of_b.size()});
  });
  correct(cells);
  return cells;
}

}  // namespace touchstone::stats
