// Names of configurations, and the parsing of their parts.
#include "harness/trade/configuration.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "harness/base/error.h"
#include "harness/base/group_words.h"
#include "harness/kinds/selection.h"

namespace touchstone::trade {

std::string_view body_kind_name(std::size_t kind) {
  return kind == mesh_body ? "mesh" : to_string(all_shape_kinds[kind]);
}

// Returns true if the form is the body itself, for bodies of that kind: a sphere's sphere, a hull's
// hull.
bool is_the_body(proxies::Form form, std::size_t kind) {
  const auto is = [&](ShapeKind shape) { return kind == static_cast<std::size_t>(shape); };
  switch (form) {
    case proxies::Form::as_given: return true;
    case proxies::Form::sphere: return is(ShapeKind::sphere);
    case proxies::Form::box:
    case proxies::Form::oriented_box: return is(ShapeKind::box);
    case proxies::Form::capsule: return is(ShapeKind::capsule);
    case proxies::Form::hull: return is(ShapeKind::hull);
    case proxies::Form::icosphere: return is(ShapeKind::box) || is(ShapeKind::hull);
    case proxies::Form::parts:
    // The shape is convex already, and has no mesh.
    case proxies::Form::mesh: return kind != mesh_body;
    case proxies::Form::dop14:
    case proxies::Form::dop18:
    case proxies::Form::dop26:
    case proxies::Form::reduced_hull: break;
  }
  return false;
}

std::string Representations::name() const {
  std::string listed;
  // The common representation of kinds that are not as given.
  std::optional<proxies::Representation> common;
  for (const auto& one : of) {
    if (one && one->form != proxies::Form::as_given) common = one;
  }
  bool same = true;
  for (std::size_t kind = 0; kind < body_kinds; ++kind) {
    if (!of[kind]) continue;
    const bool own = of[kind]->form == proxies::Form::as_given;
    if (common && (own ? !is_the_body(common->form, kind) : *of[kind] != *common)) same = false;
    listed += fmt::format("{}{}={}", listed.empty() ? "" : ",", body_kind_name(kind),
                          to_string(*of[kind]));
  }
  return same ? to_string(common.value_or(proxies::Representation{})) : listed;
}

std::string BoxChoice::name() const {
  switch (kind) {
    case Kind::tight: return "tight";
    case Kind::loose: return "loose";
    case Kind::fat: break;
  }
  return fmt::format("fat-{}", margin);
}

std::optional<BoxChoice> parse_box_choice(std::string_view text) {
  if (text == "tight") return BoxChoice{};
  if (text == "loose") return BoxChoice{BoxChoice::Kind::loose, 0};
  constexpr std::string_view fat = "fat-";
  if (!text.starts_with(fat)) return {};
  text.remove_prefix(fat.size());
  BoxChoice choice{BoxChoice::Kind::fat, 0};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), choice.margin);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  if (!(choice.margin > 0 && choice.margin <= 10)) return {};
  return choice;
}

std::string chain_name(const NarrowChain& chain) {
  if (chain.empty()) return "none";
  std::string name;
  for (const NarrowPhaseEntry* entry : chain) name += (name.empty() ? "" : "+") + entry->info.name;
  return name;
}

NarrowChain parse_chain(std::string_view text) {
  if (text == "none") return {};
  std::vector<std::string> names;
  for (;;) {
    const std::size_t plus = text.find('+');
    names.emplace_back(text.substr(0, plus));
    if (plus == std::string_view::npos) break;
    text.remove_prefix(plus + 1);
  }
  for (const std::string& name : names) {
    if (base::is_group_word(name)) {
      throw base::InputError(fmt::format("'{}' in a chain of narrow phases; expected names", name));
    }
  }
  return kinds::select(registry::entries<NarrowPhaseEntry>(), names, "narrow phase");
}

std::string Configuration::phases_name() const {
  return concave != nullptr ? concave->info.name : chain_name(narrow);
}

std::string Configuration::narrow_name() const {
  if (narrow.empty() && concave == nullptr) return "none";
  std::string name = fmt::format("{} {}", phases_name(), to_string(settings.scalar));
  if (settings.tolerance) name += fmt::format(" {}", *settings.tolerance);
  if (settings.max_iterations) name += fmt::format(" cap {}", *settings.max_iterations);
  return name;
}

std::string Configuration::name() const {
  std::string name = representations.name();
  if (broad != nullptr) name += fmt::format(" / {} / {}", boxes.name(), broad->info.name);
  return name + " / " + narrow_name();
}

}  // namespace touchstone::trade
