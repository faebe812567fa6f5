// The data that the registry holds on every algorithm, whatever its contract. It may include the
// standard library only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace touchstone {

// A module is a shared object of somebody's, loaded at run time (module/touchstone_module.h).
enum class Origin : std::uint8_t { ours, peer, oracle, module };

std::string_view to_string(Origin origin);

// True where `ok` is the author's word, so that a wrong answer fails the command: of ours and of modules. A library's
// wrong answers are told, and fail nothing.
constexpr bool is_answerable(Origin origin) {
  return origin == Origin::ours || origin == Origin::module;
}

struct AlgorithmInfo {
  std::string name;  // name on the command line: lower case, words joined by '-'
  // Authors, title, where and when; for a peer the library and the function called.
  std::string citation;
  Origin origin = Origin::ours;
  // A known and accepted departure from the contract, in one line, which the comparison reports as
  // such. If it is empty, any departure is a fault.
  std::string known_defect = {};
  // The reason why it is not built; empty if it is. The registry fills it in.
  std::string reason = {};
  // The part of a built algorithm that is not built, and the reason, in one line; empty if all of
  // it is.
  std::string lacking = {};
};

}  // namespace touchstone
