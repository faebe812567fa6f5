// Tables of functions as a module has them: how they are read, and how instances live.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/algorithm_info.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/shape.h"
#include "harness/modules/shared_object.h"
#include "harness/process/child_process.h"

namespace touchstone::modules {

// A copy of a module's struct. What its size does not reach is null. Throws base::InputError if the size is below `least`.
template <class Struct>
Struct copy_of(const Struct& theirs, std::size_t least, const SharedObject& object,
               std::string_view what) {
  // A size that cuts a pointer in two is none.
  if (theirs.struct_size < least || theirs.struct_size % alignof(Struct) != 0) {
    object.fail(fmt::format("{} has the struct_size {}; expected sizeof, which is {}", what,
                            theirs.struct_size, sizeof(Struct)));
  }
  Struct copy{};
  std::memcpy(&copy, &theirs, std::min<std::size_t>(theirs.struct_size, sizeof copy));
  return copy;
}

// A table of a module that stays loaded.
template <class Table>
struct Kept {
  std::shared_ptr<const SharedObject> object;
  Table table;
  std::string name;
};
template <class Table>
using Offer = std::shared_ptr<const Kept<Table>>;

// What create() made, until its end.
template <class Table>
class Instance {
 public:
  template <class Settings>
  Instance(Offer<Table> offer, const Settings& settings)
      : offer_(std::move(offer)), made_(table().create(&settings)) {
    if (made_ == nullptr) throw std::runtime_error(offer_->name + ": create() returned NULL");
  }
  ~Instance() { table().destroy(made_); }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const Table& table() const { return offer_->table; }
  void* made() const { return made_; }
  const std::string& name() const { return offer_->name; }

 private:
  Offer<Table> offer_;
  void* made_;
};

inline std::uint32_t scalar_of(Precision scalar) {
  return scalar == Precision::float32 ? TOUCHSTONE_MODULE_FLOAT : TOUCHSTONE_MODULE_DOUBLE;
}
inline double tolerance_of(const std::optional<double>& tolerance) {
  return tolerance.value_or(std::numeric_limits<double>::quiet_NaN());
}
inline constexpr std::uint32_t all_scalars = TOUCHSTONE_MODULE_FLOAT | TOUCHSTONE_MODULE_DOUBLE;
inline std::vector<Precision> scalars_of(std::uint32_t bits) {
  std::vector<Precision> scalars;
  if ((bits & TOUCHSTONE_MODULE_FLOAT) != 0) scalars.push_back(Precision::float32);
  if ((bits & TOUCHSTONE_MODULE_DOUBLE) != 0) scalars.push_back(Precision::float64);
  return scalars;
}
// The values whose place is a bit.
template <class Value>
std::vector<Value> values_of(std::uint32_t bits) {
  std::vector<Value> values;
  for (std::uint8_t place = 0; place < 32; ++place) {
    if ((bits >> place & 1) != 0) values.push_back(static_cast<Value>(place));
  }
  return values;
}
template <class Value>
std::uint32_t bit_of(Value value) {
  return 1u << static_cast<unsigned>(value);
}

// Throws process::Garbage if the first byte of some answer is above `most_first`, or the second above `most_second`: they
// are enumerations. An answer costs a load and an `or`.
template <class Answer>
void expect_known(const Answer* answers, std::size_t count, std::uint8_t most_first,
                  std::uint8_t most_second, const std::string& name) {
  const auto bytes_of = [&](std::size_t i) {
    std::uint16_t bytes = 0;
    std::memcpy(&bytes, answers + i, sizeof bytes);
    return bytes;
  };
  const auto is_known = [&](std::uint16_t bytes) {
    return (bytes & 0xff) <= most_first && (bytes >> 8) <= most_second;
  };
  std::uint16_t seen = 0;
  for (std::size_t i = 0; i < count; ++i) seen |= bytes_of(i);
  if (is_known(seen)) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_known(bytes_of(i))) continue;
    throw process::Garbage(
        fmt::format("{}: answer {} begins with the bytes {} and {}; expected at most {} and {}",
                    name, i, bytes_of(i) & 0xff, bytes_of(i) >> 8, most_first, most_second));
  }
}
inline constexpr std::uint8_t most_status = TOUCHSTONE_MODULE_NOT_REPORTED;

// Throws base::InputError if one of these functions is null.
template <class Table>
void expect_functions(const Kept<Table>& kept,
                      std::initializer_list<std::pair<std::string_view, bool>> functions) {
  for (const auto& [function, is_there] : functions) {
    if (is_there) continue;
    kept.object->fail(
        fmt::format("'{}': its function {} is NULL; expected one", kept.name, function));
  }
}
// Throws base::InputError if no bit is set, or one that means nothing.
template <class Table>
void expect_bits(const Kept<Table>& kept, std::string_view what, std::uint32_t bits,
                 std::uint32_t known) {
  if (bits != 0 && (bits & ~known) == 0) return;
  kept.object->fail(fmt::format("'{}': found the {} {:#x}; expected some of the bits {:#x}",
                                kept.name, what, bits, known));
}

// The most answers of `supports` that tables of one kind have: of two kinds of shapes, and tasks or whether bodies turn.
inline constexpr std::size_t most_supports = all_shape_kinds.size() * all_shape_kinds.size() * 4;
// By kinds and task, or kinds and whether bodies turn.
using Supports = std::array<bool, most_supports>;
constexpr std::size_t supports_place(ShapeKind a, ShapeKind b, std::size_t rest) {
  return (static_cast<std::size_t>(a) * all_shape_kinds.size() + static_cast<std::size_t>(b)) * 4 +
         rest;
}
// What `supports`, a function of two kinds and of `rest`, says of all with kind_a <= kind_b.
template <class Function>
Supports supports_of(TrialAnswers& ahead, std::size_t rests, const Function& function) {
  Supports supports{};
  for (const ShapeKind a : all_shape_kinds) {
    for (const ShapeKind b : all_shape_kinds) {
      if (a > b) continue;
      for (std::size_t rest = 0; rest < rests; ++rest) {
        supports[supports_place(a, b, rest)] = ahead.answer([&] { return function(a, b, rest); });
      }
    }
  }
  return supports;
}

// Each adds the entry of a table to the registry. Throws base::InputError where the table is wrong.
void add(Offer<TouchstoneModuleBoxes> offer, AlgorithmInfo info, TrialAnswers& ahead);
void add(Offer<TouchstoneModulePairs> offer, AlgorithmInfo info, TrialAnswers& ahead);
void add(Offer<TouchstoneModuleRays> offer, AlgorithmInfo info, TrialAnswers& ahead);
void add(Offer<TouchstoneModulePoints> offer, AlgorithmInfo info, TrialAnswers& ahead);
void add(Offer<TouchstoneModuleMeshes> offer, AlgorithmInfo info, TrialAnswers& ahead);
void add(Offer<TouchstoneModuleCasts> offer, AlgorithmInfo info, TrialAnswers& ahead);
void add(Offer<TouchstoneModuleFeaturePairs> offer, AlgorithmInfo info, TrialAnswers& ahead);

}  // namespace touchstone::modules
