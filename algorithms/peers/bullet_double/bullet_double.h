// Used by Bullet's narrow phases and contact manifolds: access to Bullet's double build, whose
// symbols have the same names as those of its single build and other contents.
//
// The two must never be in one scope of the dynamic linker. The program is linked with the single
// build; the narrow phases and contact manifolds are compiled a second time, with
// BT_USE_DOUBLE_PRECISION, into a module that is linked with the double libraries. The program
// loads the module when it first makes a double algorithm: RTLD_LOCAL hides the module's symbols
// from the program, and RTLD_DEEPBIND makes the module and its libraries search themselves before
// the program. Only objects of the contract pass between the two.
#pragma once

#include <dlfcn.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "algorithms/contact_manifold.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/peers/not_built.h"

namespace touchstone::bullet {

// The module's file. TOUCHSTONE_BULLET_NO_DOUBLE says why there is none.
inline constexpr const char* module_name = "touchstone_bullet_double.so";
#ifdef TOUCHSTONE_BULLET_NO_DOUBLE
inline constexpr bool has_double = false;
inline std::string lacking() { return "double is not built, because " TOUCHSTONE_BULLET_NO_DOUBLE; }
#else
inline constexpr bool has_double = true;
inline std::string lacking() { return {}; }
#endif

// The scalars that each of Bullet's narrow phases supports.
inline std::vector<Precision> scalars() {
  if (has_double) return {Precision::float32, Precision::float64};
  return {Precision::float32};
}

// The module's function for a contract: it returns null if no algorithm has that name.
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

// Loads the module of the program's own build. It lies beside the program; from a test program, in
// the folder of the program; of an installation, in ../lib/touchstone. Throws std::runtime_error if it is missing or does not load.
inline void* load_double(const char* symbol) {
  const auto fail = [](const std::string& why) {
    throw std::runtime_error("Bullet's double build: " + why);
  };
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::filesystem::path file = folder / module_name;
  for (const char* const other : {"harness", "lib/touchstone"}) {
    if (!std::filesystem::exists(file)) file = folder.parent_path() / other / module_name;
  }
  if (!std::filesystem::exists(file)) fail((folder / module_name).string() + " is missing");
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (module == nullptr) fail(dlerror());
  void* const found = dlsym(module, symbol);
  if (found == nullptr) fail(dlerror());
  return found;
}

// Makes the algorithm with that name, in double. The module stays loaded, since destroying the
// algorithm needs its code.
template <class Contract, class Settings>
std::unique_ptr<Contract> make_double(const char* name, const Settings& settings) {
  using Module = InDouble<Contract>;
  static auto* const make = reinterpret_cast<typename Module::Make*>(load_double(Module::symbol));
  std::unique_ptr<Contract> algorithm(make(name, settings));
  if (!algorithm) throw std::runtime_error(std::string("Bullet's double build has no ") + name);
  return algorithm;
}

}  // namespace touchstone::bullet
