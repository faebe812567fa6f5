// Bullet's double build, which has the same symbols as its single one and other contents.
//
// The two must never be in one scope of the dynamic linker. The program is linked with the single
// build; the narrow phases and contact manifolds are compiled a second time with
// BT_USE_DOUBLE_PRECISION, into a module that is linked with the double libraries. The module is
// loaded when a double algorithm is first made: RTLD_LOCAL keeps its symbols from the program, and
// RTLD_DEEPBIND has it and its libraries look in themselves before the program. What passes between
// the two is the contract alone.
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "algorithms/contact_manifold.h"
#include "algorithms/narrow_phase.h"

namespace touchstone::bullet {

// TOUCHSTONE_BULLET_MODULE is the module's file name. Where there is none,
// TOUCHSTONE_BULLET_NO_DOUBLE says why.
#ifdef TOUCHSTONE_BULLET_MODULE
inline constexpr const char* module_name = TOUCHSTONE_BULLET_MODULE;
inline constexpr bool has_double = true;
inline std::string lacking() { return {}; }
#else
inline constexpr const char* module_name = "";
inline constexpr bool has_double = false;
inline std::string lacking() { return "double is not built, because " TOUCHSTONE_BULLET_NO_DOUBLE; }
#endif

// Of each of Bullet's narrow phases.
inline std::vector<Precision> scalars() {
  if (has_double) return {Precision::float32, Precision::float64};
  return {Precision::float32};
}

// What the module has of a contract: one function, which gives null where it has no algorithm of
// that name.
template <class Contract>
struct InDouble;
template <>
struct InDouble<NarrowPhase> {
  using Make = NarrowPhase*(const char* name, const NarrowPhaseSettings& settings);
  static constexpr const char* symbol = "touchstone_bullet_double";
};
template <>
struct InDouble<ContactManifold> {
  using Make = ContactManifold*(const char* name, const ManifoldSettings& settings);
  static constexpr const char* symbol = "touchstone_bullet_double_manifold";
};

// The module of the program's own build: it lies beside the program or, seen from a test program,
// in the folder of the program. Throws std::runtime_error where it is not found or not loaded.
inline void* load_double(const char* symbol) {
  const auto fail = [](const std::string& why) {
    throw std::runtime_error("Bullet's double build: " + why);
  };
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::filesystem::path file = folder / module_name;
  if (!std::filesystem::exists(file)) file = folder.parent_path() / "harness" / module_name;
  if (!std::filesystem::exists(file)) fail((folder / module_name).string() + " is missing");
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (module == nullptr) fail(dlerror());
  void* const found = dlsym(module, symbol);
  if (found == nullptr) fail(dlerror());
  return found;
}

// The algorithm with that name, in double. It stays loaded: its code is needed to destroy it.
template <class Contract, class Settings>
std::unique_ptr<Contract> make_double(const char* name, const Settings& settings) {
  using Module = InDouble<Contract>;
  static auto* const make = reinterpret_cast<typename Module::Make*>(load_double(Module::symbol));
  std::unique_ptr<Contract> algorithm(make(name, settings));
  if (!algorithm) throw std::runtime_error(std::string("Bullet's double build has no ") + name);
  return algorithm;
}

}  // namespace touchstone::bullet
