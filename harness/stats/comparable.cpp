// Finds what keeps two results from being compared.
#include "harness/stats/comparable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
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
      lines.push_back(fmt::format("in {}, {} was told from itself: its times are suspect in {}",
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

}  // namespace touchstone::stats
