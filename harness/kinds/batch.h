// Families of hard cases, and consecutive cases of one: asked in child processes, graded, and written
// to show one again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"
#include "harness/families/draws.h"
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

class Kind;

// A family of cases: hard queries of one make, drawn from a seed.
struct Family {
  std::string name;  // "triangles-edges-1e-9": lower case, words joined by '-'
  std::string
      group;  // "triangles", "bodies", "rays", "points", "casts", "turns", "vertex-face", ...
  const Kind* kind = nullptr;
  std::uint32_t number = 0;  // among those of its kind
  int one_in = 1;            // so many times fewer cases, since the exact answer takes long
  // Of a family that is a value of an axis, along which one property grows; empty for others. The values
  // of an axis follow each other.
  std::string axis = {}, value = {};
  // What its kind draws the cases by, if that is more than its number, such as a Regime.
  const void* drawn = nullptr;
};

// A value of an axis.
struct AxisValue {
  std::string name;  // such as "1e-3"; "0" if the property is absent
  double value = 0;
};

// The values from 10^first to 10^last, with names such as "1e-3".
std::vector<AxisValue> decades(int first, int last);

// Adds a family for each value of an axis.
void add_axis(std::vector<Family>& list, const std::string& axis,
              std::span<const AxisValue> values);

// A family that draws whole cases.
template <class Case>
struct DrawnFamily {
  std::string name, group;
  int one_in = 1;
  // Draws the case of an index, without its id.
  std::function<Case(families::Draws& draws, std::uint64_t index)> draw;
  std::string axis = {}, value = {};  // see Family
};

// The families as a kind lists them.
template <class Case>
std::vector<Family> families_of(std::span<const DrawnFamily<Case>> drawn) {
  std::vector<Family> list;
  for (const DrawnFamily<Case>& one : drawn) {
    list.push_back({.name = one.name,
                    .group = one.group,
                    .one_in = one.one_in,
                    .axis = one.axis,
                    .value = one.value});
  }
  return list;
}

inline constexpr std::uint8_t every_task = 0xff;

// An algorithm under test: an entry of the registry, its scalar, and what it is asked.
struct Contestant {
  const Kind* kind = nullptr;
  const AlgorithmInfo* info = nullptr;
  const void* entry = nullptr;  // what the kind's contract calls an entry, such as RayCastEntry
  Precision scalar = Precision::float64;
  std::uint8_t task = 0;  // place in the kind's tasks, or every_task
  // True if it is ours and promises that what it does not give up is right.
  bool promised = false;

  // `Entry` is that of the kind.
  template <class Entry>
  const Entry& of() const {
    return *static_cast<const Entry*>(entry);
  }
  std::string_view task_name() const;
  std::string name() const;  // such as "wide-bvh double closest", or "gjk double" of every task
};

// The same case in another form, which has the same exact answer. A form is asked where it is exact; turning
// casts are also reversed and split, where rounding may decide otherwise, and are then graded by that answer.
enum class CaseForm : std::uint8_t {
  as_drawn,
  swapped,   // the bodies, or features, in the other order
  scaled,    // all lengths times a power of two
  moved,     // by a rotation that permutes axes, and a translation that rounds nothing
  reversed,  // the motion, from its end to its start
  split,     // the motion, in two halves that are asked one after the other
};
inline constexpr std::array all_case_forms = {CaseForm::as_drawn, CaseForm::swapped,
                                              CaseForm::scaled,   CaseForm::moved,
                                              CaseForm::reversed, CaseForm::split};
std::string_view to_string(CaseForm form);

// True for every fifth case, which is sampled: it is also asked in other forms, and its exact answer is proven.
inline bool is_sampled(std::uint64_t index) { return index % 5 == 0; }

// Cases `first` to `first` + `count` - 1.
struct BatchRange {
  std::uint64_t seed, first;
  std::size_t count;
};

// A case depends on the family, the seed and its index alone. Exact answers are found when they are first
// needed, and kept.
class Batch {
 public:
  virtual ~Batch() = default;

  // Asks for the cases in a form, in a child process, and grades the answers, one for each case. Forms other
  // than as_drawn are asked for sampled cases alone. `time_limit`: seconds a query.
  virtual std::vector<Graded> ask(const Contestant& contestant, CaseForm form,
                                  double time_limit) = 0;
  // Writes the case of this place to files whose names begin with the stem, and returns the command
  // that asks for it again.
  virtual std::string write(const Contestant& contestant, std::size_t place,
                            const std::filesystem::path& stem) const = 0;
};

}  // namespace touchstone::kinds
