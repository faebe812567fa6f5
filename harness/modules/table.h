// Tables of functions as a module has them: how they are read, and how instances live.
#pragma once

#include <fmt/format.h>

#include <algorithm>
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
#include "harness/modules/shared_object.h"
#include "harness/process/child_process.h"

namespace touchstone::modules {

// A copy of a module's struct. What its size does not reach is null. Throws base::InputError if the size is below `least`.
template <class Struct>
Struct copy_of(const Struct& theirs, std::size_t least, const SharedObject& object,
               std::string_view what) {
  if (theirs.struct_size < least) {
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

// Each adds the entry of a table to the registry. Throws base::InputError where the table is wrong.
void add(Offer<TouchstoneModuleBoxes> offer, AlgorithmInfo info);
void add(Offer<TouchstoneModulePairs> offer, AlgorithmInfo info);
void add(Offer<TouchstoneModuleRays> offer, AlgorithmInfo info);
void add(Offer<TouchstoneModulePoints> offer, AlgorithmInfo info);
void add(Offer<TouchstoneModuleMeshes> offer, AlgorithmInfo info);
void add(Offer<TouchstoneModuleCasts> offer, AlgorithmInfo info);
void add(Offer<TouchstoneModuleFeaturePairs> offer, AlgorithmInfo info);

}  // namespace touchstone::modules
