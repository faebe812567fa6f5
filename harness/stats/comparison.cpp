// Finds what keeps two results from being compared, and compares them cell by cell.
#include "harness/stats/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace touchstone::stats {
namespace {

// Facts of machine.csv that must be equal, and facts that may explain a difference.
constexpr std::array machine_facts_compared = {"processor",
                                               "cores_online",
                                               "simultaneous_multithreading",
                                               "cache_0",
                                               "cache_1",
                                               "cache_2",
                                               "cache_3",
                                               "governor",
                                               "boost",
                                               "hypervisor",
                                               "instructions_of_machine",
                                               "instructions_in_use",
                                               "build_type",
                                               "sanitizers"};
constexpr std::array facts_remarked = {"affinity",
                                       "processor_limit",
                                       "memory_limit",
                                       "numa_nodes",
                                       "transparent_huge_pages",
                                       "clock_source",
                                       "c_library",
                                       "preloaded",
                                       "campaign_hash",
                                       "seed",
                                       "microcode",
                                       "kernel",
                                       "address_randomisation",
                                       "compiler",
                                       "flags",
                                       "eigen",
                                       "onetbb",
                                       "bullet",
                                       "fcl",
                                       "libccd",
                                       "ode",
                                       "embree",
                                       "cgal",
                                       "boost_geometry",
                                       "commit",
                                       "tree",
                                       "sources"};

std::string fact(const Results& results, const char* name) {
  const auto at = results.machine.find(name);
  return at == results.machine.end() ? "unknown" : at->second;
}

template <class Names>
void add_differences(const Results& a, const Results& b, const Names& names,
                     std::vector<std::string>& lines) {
  for (const char* name : names) {
    const std::string in_a = fact(a, name);
    const std::string in_b = fact(b, name);
    if (in_a != in_b) lines.push_back(fmt::format("{}: '{}' in A, '{}' in B", name, in_a, in_b));
  }
}

SetKey without_hash(SetKey key) {
  key.scene_hash.clear();
  return key;
}

// Returns the hashes of every scene by its name and settings.
std::set<std::string> hashes_of(const Results& results, const SetKey& key) {
  std::set<std::string> hashes;
  for (const SampleSet& set : results.sets) {
    if (without_hash(set.key) == without_hash(key)) hashes.insert(set.key.scene_hash);
  }
  return hashes;
}

}  // namespace

Missing missing(const Results& a, const Results& b, const ResultNames& names) {
  Missing gone;
  std::set<std::tuple<std::string, std::int64_t, std::string>> told;
  for (const SampleSet& set : a.sets) {
    const SampleSet* const other = b.find(set.key);
    if (other == nullptr) {
      const std::set<std::string> hashes = hashes_of(b, set.key);
      if (hashes.empty()) {
        gone.cells.push_back(fmt::format("{} is not in {}", set.key.words(), names.b));
      } else if (told.emplace(set.key.scene, set.key.bodies, set.key.seed).second) {
        gone.scenes.push_back(fmt::format("scene {} with {} bodies: hash {} in {}, {} in {}",
                                          set.key.scene, set.key.bodies, set.key.scene_hash,
                                          names.a, fmt::join(hashes, "+"), names.b));
      }
      continue;
    }
    for (const Contestant& contestant : set.contestants) {
      if (other->find(contestant.label) == nullptr) {
        gone.cells.push_back(
            fmt::format("{} in {} is not in {}", contestant.label, set.key.words(), names.b));
      }
    }
  }
  return gone;
}

std::vector<std::string> obstacles(const Results& a, const Results& b, bool machines) {
  std::vector<std::string> lines;
  if (machines) {
    for (const auto& [results, name] : {std::pair(&a, "A"), std::pair(&b, "B")}) {
      if (results->machine.empty()) {
        lines.push_back(
            fmt::format("machine of {}: no machine.csv beside {}", name, results->file.string()));
      }
    }
    if (lines.empty()) add_differences(a, b, machine_facts_compared, lines);
  }
  if (a.isa != b.isa) {
    lines.push_back(fmt::format("vector instructions: {} in A, {} in B", fmt::join(a.isa, "+"),
                                fmt::join(b.isa, "+")));
  }
  const Missing gone = missing(a, b);
  lines.insert(lines.end(), gone.scenes.begin(), gone.scenes.end());
  for (const std::string& cell : gone.cells) lines.push_back("settings: " + cell);
  if (a.sets.empty()) lines.push_back("A has no rows");
  return lines;
}

std::vector<std::string> remarks(const Results& a, const Results& b) {
  std::vector<std::string> lines;
  if (!a.machine.empty() && !b.machine.empty()) add_differences(a, b, facts_remarked, lines);
  const auto tell_suspects = [&](const Results& results, const char* name) {
    for (const SampleSet& set : results.sets) {
      if (!set.suspect) continue;
      lines.push_back(fmt::format("in {}, {} differed from its own copy: times are suspect in {}",
                                  name, set.twin.label, set.key.words()));
    }
  };
  tell_suspects(a, "A");
  tell_suspects(b, "B");
  for (const SampleSet& set : b.sets) {
    const SampleSet* const other = a.find(set.key);
    if (other == nullptr) {
      lines.push_back(fmt::format("only B has {}", set.key.words()));
      continue;
    }
    for (const Contestant& contestant : set.contestants) {
      if (other->find(contestant.label) == nullptr) {
        lines.push_back(fmt::format("only B has {} in {}", contestant.label, set.key.words()));
      }
    }
  }
  return lines;
}

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
  if (contestant == nullptr) return nan;
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
