// Which pairs of a scene's bodies are left out, by name.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "harness/files/toml_table.h"
#include "harness/scene/scene.h"

namespace touchstone::scene {

// The bodies of each name, ascending.
std::map<std::string, std::vector<std::uint32_t>> bodies_by_name(const Scene& scene);
// Adds all pairs of a body of one list with one of the other. Afterwards the caller sorts the filter's pairs.
void ignore_pairs(std::span<const std::uint32_t> some, std::span<const std::uint32_t> others,
                  PairFilter& filter);
void sort_ignored(PairFilter& filter);

// Reads `ignore`, pairs of names, and `fixed_pairs` (datasets/README.md) into the filter. Throws InputError for a name
// that no body has.
void read_filter(files::TomlTable& table, bool fixed_pairs, Scene& scene);
// From here on no pair of two bodies that do not move is asked.
void ignore_fixed_pairs(Scene& scene);

}  // namespace touchstone::scene
