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

std::map<std::string, std::vector<std::uint32_t>> bodies_by_name(const Scene& scene) {
  std::map<std::string, std::vector<std::uint32_t>> named;
  for (std::uint32_t i = 0; i < scene.names.size(); ++i) {
    if (!scene.names[i].empty()) named[scene.names[i]].push_back(i);
  }
  return named;
}

void ignore_pairs(std::span<const std::uint32_t> some, std::span<const std::uint32_t> others,
                  PairFilter& filter) {
  const bool is_one = std::ranges::equal(some, others);
  for (const std::uint32_t a : some) {
    for (const std::uint32_t b : others) {
      if (a != b && !(is_one && a > b)) filter.ignored.push_back({std::min(a, b), std::max(a, b)});
    }
  }
}

void sort_ignored(PairFilter& filter) {
  std::ranges::sort(filter.ignored);
  const auto again = std::ranges::unique(filter.ignored);
  filter.ignored.erase(again.begin(), again.end());
}

void read_filter(files::TomlTable& table, bool fixed_pairs, Scene& scene) {
  const std::map<std::string, std::vector<std::uint32_t>> named = bodies_by_name(scene);
  for (const toml::node* node : table.elements("ignore")) {
    const toml::array* pair = node->as_array();
    if (pair == nullptr || pair->size() != 2 || !(*pair)[0].is_string() ||
        !(*pair)[1].is_string()) {
      table.fail("ignore", "expected pairs of names, such as [[\"arm\", \"table\"]]");
    }
    const auto find = [&](const toml::node& end) {
      const std::string name = *end.value<std::string>();
      const auto found = named.find(name);
      if (found == named.end()) {
        table.fail("ignore", fmt::format("no body has the name \"{}\"; expected one that has",
                                         base::shortened(name)));
      }
      return found;
    };
    ignore_pairs(find((*pair)[0])->second, find((*pair)[1])->second, scene.filter);
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
