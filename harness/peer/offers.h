// What a peer says that it offers of a kind, and how each kind becomes an entry of the registry.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/ccd.h"
#include "algorithms/concave_phase.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"
#include "harness/peer/link.h"

namespace touchstone::peer {

inline constexpr std::array all_scalars = {Precision::float64, Precision::float32};
inline constexpr std::array all_concave_tasks = {ConcaveTask::intersect, ConcaveTask::distance,
                                                 ConcaveTask::contacts};
inline constexpr std::array all_feature_pairs = {FeaturePair::vertex_face, FeaturePair::edge_edge};

// The values of a list of names; `fallback` if it is missing. Throws base::InputError for a name that is no value's.
template <class Value>
std::vector<Value> offered(const files::JsonNode& offer, const char* key,
                           std::span<const Value> values,
                           const std::optional<std::vector<Value>>& fallback = {}) {
  if (fallback && !offer.has(key)) return *fallback;
  const files::JsonNode list = offer.at(key, "an array of names");
  list.as_array("an array of names");
  std::vector<Value> chosen;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const files::JsonNode node = list[i];
    const auto at = std::ranges::find_if(
        values, [&](Value value) { return node.value() == std::string(to_string(value)); });
    if (at == values.end()) {
      std::string names;
      for (const Value value : values) {
        names += fmt::format("{}{}", names.empty() ? "" : ", ", to_string(value));
      }
      node.fail(fmt::format("found {}; expected one of {}", node.found(), names));
    }
    if (std::ranges::find(chosen, *at) == chosen.end()) chosen.push_back(*at);
  }
  if (chosen.empty()) list.fail("found none; expected at least one name");
  return chosen;
}

inline std::vector<Precision> offered_scalars(const files::JsonNode& offer) {
  return offered<Precision>(offer, "scalars", all_scalars, std::vector{Precision::float64});
}
inline std::vector<ShapeKind> offered_shapes(const files::JsonNode& offer) {
  return offered<ShapeKind>(offer, "shapes", all_shape_kinds,
                            std::vector(all_shape_kinds.begin(), all_shape_kinds.end()));
}
inline bool offered_flag(const files::JsonNode& offer, const char* key) {
  if (!offer.has(key)) return false;
  const files::JsonNode node = offer.at(key, "");
  if (!node.value().is_boolean()) {
    node.fail(fmt::format("found {}; expected true or false", node.found()));
  }
  return node.value().get<bool>();
}

// Each adds an entry with this description to the registry. Throws base::InputError for a wrong offer.
void add_pair(const AlgorithmInfo& info, const files::JsonNode& offer,
              const std::shared_ptr<Link>& link);
void add_cast(const AlgorithmInfo& info, const files::JsonNode& offer,
              const std::shared_ptr<Link>& link);
void add_ray(const AlgorithmInfo& info, const files::JsonNode& offer,
             const std::shared_ptr<Link>& link);
void add_point(const AlgorithmInfo& info, const files::JsonNode& offer,
               const std::shared_ptr<Link>& link);
void add_mesh(const AlgorithmInfo& info, const files::JsonNode& offer,
              const std::shared_ptr<Link>& link);
void add_feature(const AlgorithmInfo& info, const files::JsonNode& offer,
                 const std::shared_ptr<Link>& link);
// Frames of boxes go packed, so nothing is added for a link that takes none.
void add_box(const AlgorithmInfo& info, const files::JsonNode& offer,
             const std::shared_ptr<Link>& link);

}  // namespace touchstone::peer
