// Counts the contacts of links.
#include "harness/report/link_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "algorithms/registry.h"
#include "harness/measure/block_input.h"
#include "harness/report/scene_view.h"

namespace touchstone::report {
namespace {

constexpr std::uint8_t verdict_touching = 1, verdict_overlapping = 2;

// Whose bodies are told apart: the links by their numbers, and behind them everything else by its name.
struct Owners {
  std::vector<std::size_t> of;  // by body
  std::vector<std::string> names;
};

Owners owners_of(const scene::Scene& scene, const scene::Robot& robot) {
  Owners owners;
  for (std::size_t link = 0; link < robot.links.size(); ++link) {
    owners.names.push_back(robot.links[link].name);
    owners.of.insert(owners.of.end(), robot.links[link].shapes.size(), link);
  }
  std::map<std::string, std::size_t> others;
  for (std::size_t body = owners.of.size(); body < scene.bodies.size(); ++body) {
    const std::string name =
        scene.names[body].empty() ? fmt::format("body {}", body) : scene.names[body];
    const auto [at, is_new] = others.try_emplace(name, owners.names.size());
    if (is_new) owners.names.push_back(name);
    owners.of.push_back(at->second);
  }
  return owners;
}

using Pair = std::pair<std::size_t, std::size_t>;

measure::NarrowChoice convex_choice() {
  return {.entry = registry::find<NarrowPhaseEntry>("certified"), .settings = {}};
}

measure::NarrowChoice concave_choice() {
  return measure::concave_choices(std::array{registry::find<ConcaveEntry>("fused")}, {},
                                  std::array{Precision::float64})
      .at(0);
}

}  // namespace

LinkContacts link_contacts(const scene::Scene& scene, const scene::Robot& robot,
                           double time_limit) {
  const Owners owners = owners_of(scene, robot);
  const auto owners_pair = [&](const IndexPair& pair) -> Pair {
    return std::minmax(owners.of[pair.a], owners.of[pair.b]);
  };
  std::set<Pair> disabled;
  for (const auto& [a, b] : robot.disabled) disabled.insert({a, b});
  const auto is_disabled = [&](const IndexPair& pair) {
    return disabled.contains(owners_pair(pair));
  };
  measure::BlockInput input(scene, scene::BoxKind::tight, true);
  std::erase_if(input.filter.ignored, is_disabled);

  LinkContacts found;
  found.configurations = input.frames.size();
  std::map<Pair, std::size_t> place;
  for (std::uint32_t a = 0; a < scene.bodies.size(); ++a) {
    for (std::uint32_t b = a + 1; b < scene.bodies.size(); ++b) {
      if (!input.filter.asks({a, b})) continue;
      const Pair pair = owners_pair({a, b});
      const auto [at, is_new] = place.try_emplace(pair, found.pairs.size());
      if (!is_new) continue;
      found.pairs.push_back({.first = owners.names[pair.first],
                             .second = owners.names[pair.second],
                             .is_of_links = pair.second < robot.links.size(),
                             .is_disabled = disabled.contains(pair)});
    }
  }

  const ScenePairs pairs(input);
  const std::vector<std::uint8_t> convex = pairs.verdicts(convex_choice(), time_limit);
  const std::vector<std::uint8_t> concave =
      scene.concave.empty() ? convex : pairs.verdicts(concave_choice(), time_limit);
  for (std::size_t frame = 0; frame < pairs.frames(); ++frame) {
    const std::vector<std::uint32_t> bodies = pairs.bodies(frame);
    std::set<std::size_t> touching, unknown;  // pairs of names in this frame
    for (std::size_t i = 0; 2 * i < bodies.size(); ++i) {
      const IndexPair pair = {bodies[2 * i], bodies[2 * i + 1]};
      const bool is_concave = input.is_concave(pair.a) || input.is_concave(pair.b);
      const std::uint8_t verdict = (is_concave ? concave : convex)[pairs.start(frame) + i];
      const std::size_t at = place.at(owners_pair(pair));
      if (verdict == verdict_touching || verdict == verdict_overlapping) {
        touching.insert(at);
      } else if (verdict > verdict_overlapping) {
        unknown.insert(at);
      }
    }
    bool is_free = true, is_known = true;
    for (const std::size_t at : touching) {
      ++found.pairs[at].touching;
      unknown.erase(at);
      if (!found.pairs[at].is_disabled) is_free = false;
    }
    for (const std::size_t at : unknown) {
      ++found.pairs[at].unknown;
      if (!found.pairs[at].is_disabled) is_known = false;
    }
    if (!is_free) continue;
    ++(is_known ? found.free : found.unknown);
  }
  return found;
}

}  // namespace touchstone::report
