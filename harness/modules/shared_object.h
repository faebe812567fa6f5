// A file that is loaded into the program, and the tables that it offers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include "algorithms/module/touchstone_module.h"

namespace touchstone::modules {

// Yes-or-no answers of a module's functions that are needed before an instance is made, such as which kinds a table
// takes. The child process in which the file is tried asks for them. The program reads them in the same order, so a
// function that crashes, hangs or exits does not end it.
class TrialAnswers {
 public:
  TrialAnswers(std::span<std::uint8_t> answers, bool asks) : answers_(answers), asks_(asks) {}
  template <class Function>
  bool answer(const Function& function) {
    if (next_ == answers_.size()) return false;
    std::uint8_t& answer = answers_[next_++];
    if (asks_) answer = function() ? 1 : 0;
    return answer != 0;
  }

 private:
  std::span<std::uint8_t> answers_;
  std::size_t next_ = 0;
  bool asks_;
};

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
