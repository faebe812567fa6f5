// A configuration of a scene: proxies, boxes and algorithms that together find its contacts.
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

// The kind of a body is that of its shape, or `mesh` for a body that has a mesh.
inline constexpr std::size_t mesh_body = all_shape_kinds.size();
inline constexpr std::size_t body_kinds = all_shape_kinds.size() + 1;
std::string_view body_kind_name(std::size_t kind);

// Returns true if the form is the body itself, for bodies of that kind: the sphere of a sphere, the
// hull of a hull.
bool is_the_body(proxies::Form form, std::size_t kind);

// The representation of the bodies of each kind. A kind without a representation stays as given,
// and half-spaces always do.
struct Representations {
  std::array<std::optional<proxies::Representation>, body_kinds> of;

  // A name such as "hull-16", or "box=sphere,hull=hull-16" if kinds differ in more than that the
  // shape of some kind is already the representation of the others.
  std::string name() const;
  friend bool operator==(const Representations&, const Representations&) = default;
};

// A kind of boxes: tight, or rotation-invariant (core/bounds.h), or fat: tight and grown by a
// margin, then kept until the body leaves it.
struct BoxChoice {
  enum class Kind : std::uint8_t { tight, loose, fat };
  Kind kind = Kind::tight;
  double margin = 0;  // the margin of fat boxes on each side, as a part of the box's longest side

  std::string name() const;  // a name such as "tight", "loose" or "fat-0.1"
  friend bool operator==(const BoxChoice&, const BoxChoice&) = default;
};
// Returns nothing for a text that is no choice of boxes.
std::optional<BoxChoice> parse_box_choice(std::string_view text);

// Narrow phases in order: a pair goes to the first that takes its kinds. If the chain is empty,
// every pair of boxes counts as a contact.
using NarrowChain = std::vector<const NarrowPhaseEntry*>;
std::string chain_name(const NarrowChain& chain);  // a name such as "closed-form+gjk" or "none"
// Reads names that are joined by '+'. Throws InputError with the list of known names.
NarrowChain parse_chain(std::string_view text);

struct Configuration {
  Representations representations;
  BoxChoice boxes;
  const BroadPhaseEntry* broad = nullptr;  // null if the scene lists its pairs
  NarrowChain narrow;
  // Takes whole bodies: a body that is represented by its mesh as that mesh, a solid if it is closed,
  // others as compounds of their parts. The chain is empty then.
  const ConcaveEntry* concave = nullptr;
  NarrowPhaseSettings settings;

  // The name of the chain or of the concave phase, or "none".
  std::string phases_name() const;
  std::string narrow_name() const;  // a name such as "gjk double 1e-06 cap 8" or "none"
  // A name such as "hull-16 / tight / sweep-one-axis / gjk double"; distinct configurations have
  // distinct names.
  std::string name() const;
};

}  // namespace touchstone::trade
