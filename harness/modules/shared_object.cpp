// Opens shared objects.
#include "harness/modules/shared_object.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <utility>

#include "harness/base/error.h"
#include "harness/modules/table.h"

namespace touchstone::modules {
namespace {

constexpr const char* symbol = "touchstone_module";

// What is printed meanwhile goes to standard error, since standard output is for answers.
class OutputToError {
 public:
  OutputToError() {
    std::fflush(stdout);
    output_ = dup(STDOUT_FILENO);
    if (output_ >= 0) dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~OutputToError() {
    std::fflush(stdout);
    if (output_ < 0) return;
    dup2(output_, STDOUT_FILENO);
    close(output_);
  }
  OutputToError(const OutputToError&) = delete;
  OutputToError& operator=(const OutputToError&) = delete;

 private:
  int output_ = -1;
};

}  // namespace

SharedObject::SharedObject(std::filesystem::path file) : file_(std::move(file)) {
  const OutputToError quiet;
  handle_ = dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) fail(fmt::format("cannot be loaded: {}; expected a module", dlerror()));
  try {
    read();
  } catch (...) {
    dlclose(handle_);
    throw;
  }
}

SharedObject::~SharedObject() { dlclose(handle_); }

void SharedObject::fail(const std::string& found_and_expected) const {
  throw base::InputError(file_.string(), 0, found_and_expected);
}

void SharedObject::read() {
  void* const found = dlsym(handle_, symbol);
  if (found == nullptr) {
    fail(
        fmt::format("has no symbol {0}; expected a module, which exports the function {0}() of "
                    "touchstone_module.h",
                    symbol));
  }
  const TouchstoneModule* offer = nullptr;
  try {
    offer = reinterpret_cast<decltype(&touchstone_module)>(found)(TOUCHSTONE_MODULE_ABI);
  } catch (const std::exception& error) {
    fail(fmt::format("{}() threw: {}; expected its tables", symbol, error.what()));
  } catch (...) {
    fail(
        fmt::format("{}() threw something that is no std::exception; expected its tables", symbol));
  }
  if (offer == nullptr) {
    fail(fmt::format("{}() returned NULL; expected tables of version {}", symbol,
                     TOUCHSTONE_MODULE_ABI));
  }
  if (offer->abi != TOUCHSTONE_MODULE_ABI) {
    fail(fmt::format("is of version {} of touchstone_module.h; expected version {}", offer->abi,
                     TOUCHSTONE_MODULE_ABI));
  }
  offer_ = copy_of(*offer, offsetof(TouchstoneModule, boxes), *this, "TouchstoneModule");
}

}  // namespace touchstone::modules
