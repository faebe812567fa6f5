// One way to find the contacts of a scene: what stands for its bodies, and what is asked of that.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/registry.h"
#include "harness/proxies/representation.h"

namespace touchstone::trade {

// Kinds of bodies: a shape's, or `mesh` for a body that has a mesh.
inline constexpr std::size_t mesh_body = all_shape_kinds.size();
inline constexpr std::size_t body_kinds = all_shape_kinds.size() + 1;
std::string_view body_kind_name(std::size_t kind);

// Tells whether the form is the body itself, for bodies of that kind: the sphere of a sphere, the
// hull of a hull.
bool is_the_body(proxies::Form form, std::size_t kind);

// The representation of the bodies of each kind; without one they are as given, as half-spaces
// always are.
struct Representations {
  std::array<std::optional<proxies::Representation>, body_kinds> of;

  // "hull-16", or "box=sphere,hull=hull-16" where kinds differ otherwise than that some kind's own
  // shape is what the others have.
  std::string name() const;
  friend bool operator==(const Representations&, const Representations&) = default;
};

// A kind of boxes: tight, or rotation-invariant (core/bounds.h), or tight and grown
// by a margin, then kept until the body leaves it.
struct BoxChoice {
  enum class Kind : std::uint8_t { tight, loose, fat };
  Kind kind = Kind::tight;
  double margin = 0;  // of fat boxes, on each side, as a part of the box's longest side

  std::string name() const;  // "tight", "loose", "fat-0.1"
  friend bool operator==(const BoxChoice&, const BoxChoice&) = default;
};
// Empty for a text that is no choice of boxes.
std::optional<BoxChoice> parse_box_choice(std::string_view text);

// Narrow phases in order: a pair goes to the first that takes its kinds. Empty: none, and every
// pair of boxes counts as a contact.
using NarrowChain = std::vector<const NarrowPhaseEntry*>;
std::string chain_name(const NarrowChain& chain);  // "closed-form+gjk", "none"
// Reads names that are joined by '+'. Throws InputError with the names that there are.
NarrowChain parse_chain(std::string_view text);

struct Configuration {
  Representations representations;
  BoxChoice boxes;
  const BroadPhaseEntry* broad = nullptr;  // null where the scene lists its pairs
  NarrowChain narrow;
  NarrowPhaseSettings settings;

  std::string narrow_name() const;  // "gjk double 1e-06 cap 8", "none"
  // "hull-16 / tight / sweep-and-prune / gjk double": no two that differ share it.
  std::string name() const;
};

}  // namespace touchstone::trade
