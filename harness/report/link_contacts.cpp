// Counts the contacts of links.
#include "harness/report/link_contacts.h"

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

using Names = std::pair<std::string, std::string>;

Names names_of(const scene::Scene& scene, const IndexPair& pair) {
  const auto [a, b] = std::minmax(pair.a, pair.b);
  return {scene.names[a], scene.names[b]};
}

std::set<Names> disabled_names(const scene::Robot& robot) {
  std::set<Names> names;
  for (const auto& [a, b] : robot.disabled) {
    names.insert({robot.links[a].name, robot.links[b].name});
    names.insert({robot.links[b].name, robot.links[a].name});
  }
  return names;
}

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
  const std::set<Names> disabled = disabled_names(robot);
  const auto is_disabled = [&](const IndexPair& pair) {
    return disabled.contains(names_of(scene, pair));
  };
  measure::BlockInput input(scene, scene::BoxKind::tight, true);
  std::erase_if(input.filter.ignored, is_disabled);

  LinkContacts found;
  found.configurations = input.frames.size();
  std::map<Names, std::size_t> place;
  for (std::uint32_t a = 0; a < scene.bodies.size(); ++a) {
    for (std::uint32_t b = a + 1; b < scene.bodies.size(); ++b) {
      if (!input.filter.asks({a, b})) continue;
      const Names names = names_of(scene, {a, b});
      const auto [at, is_new] = place.try_emplace(names, found.pairs.size());
      if (!is_new) continue;
      found.pairs.push_back(
          {.first = names.first, .second = names.second, .is_disabled = is_disabled({a, b})});
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
      const std::size_t at = place.at(names_of(scene, pair));
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
