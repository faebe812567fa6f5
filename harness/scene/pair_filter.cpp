// Leaves out pairs of bodies.
#include "harness/scene/pair_filter.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/base/input_file.h"

namespace touchstone::scene {

bool PairFilter::asks(const IndexPair& pair) const {
  if (!rests.empty() && rests[pair.a] != 0 && rests[pair.b] != 0) return false;
  return ignored.empty() ||
         !std::ranges::binary_search(ignored,
                                     IndexPair{std::min(pair.a, pair.b), std::max(pair.a, pair.b)});
}

void PairFilter::apply(std::vector<IndexPair>& pairs) const {
  if (is_empty()) return;
  std::erase_if(pairs, [&](const IndexPair& pair) { return !asks(pair); });
}

std::vector<std::uint32_t> bodies_named(const Scene& scene, std::string_view name) {
  std::vector<std::uint32_t> bodies;
  for (std::uint32_t i = 0; i < scene.names.size(); ++i) {
    if (scene.names[i] == name) bodies.push_back(i);
  }
  return bodies;
}

void ignore_pairs(std::span<const std::uint32_t> some, std::span<const std::uint32_t> others,
                  PairFilter& filter) {
  for (const std::uint32_t a : some) {
    for (const std::uint32_t b : others) {
      if (a != b) filter.ignored.push_back({std::min(a, b), std::max(a, b)});
    }
  }
}

void sort_ignored(PairFilter& filter) {
  std::ranges::sort(filter.ignored);
  const auto again = std::ranges::unique(filter.ignored);
  filter.ignored.erase(again.begin(), again.end());
}

void read_filter(files::TomlTable& table, bool fixed_pairs, Scene& scene) {
  for (const toml::node* node : table.elements("ignore")) {
    const toml::array* pair = node->as_array();
    if (pair == nullptr || pair->size() != 2 || !(*pair)[0].is_string() ||
        !(*pair)[1].is_string()) {
      table.fail("ignore", "expected pairs of names, such as [[\"arm\", \"table\"]]");
    }
    std::vector<std::uint32_t> bodies[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string name = *(*pair)[i].value<std::string>();
      bodies[i] = bodies_named(scene, name);
      if (bodies[i].empty()) {
        table.fail("ignore", fmt::format("no body has the name \"{}\"; expected one that has",
                                         base::shortened(name)));
      }
    }
    ignore_pairs(bodies[0], bodies[1], scene.filter);
  }
  sort_ignored(scene.filter);
  scene.filter.rests.clear();
  if (!table.boolean("fixed_pairs", fixed_pairs)) ignore_fixed_pairs(scene);
}

void ignore_fixed_pairs(Scene& scene) {
  scene.filter.rests.clear();
  for (const Body& body : scene.bodies) scene.filter.rests.push_back(body.moving ? 0 : 1);
}

}  // namespace touchstone::scene
