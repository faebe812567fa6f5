// A file that is loaded into the program, and the tables that it offers.
#pragma once

#include <filesystem>
#include <string>

#include "algorithms/module/touchstone_module.h"

namespace touchstone::modules {

// Keeps the file loaded.
class SharedObject {
 public:
  // Throws base::InputError where the file is no module, or one of another version.
  explicit SharedObject(std::filesystem::path file);
  ~SharedObject();
  SharedObject(const SharedObject&) = delete;
  SharedObject& operator=(const SharedObject&) = delete;

  const std::filesystem::path& file() const { return file_; }
  // What it offers; lists that it does not have are null.
  const TouchstoneModule& offer() const { return offer_; }
  // Throws base::InputError with the file's name.
  [[noreturn]] void fail(const std::string& found_and_expected) const;

 private:
  void read();

  std::filesystem::path file_;
  void* handle_ = nullptr;
  TouchstoneModule offer_{};
};

}  // namespace touchstone::modules
