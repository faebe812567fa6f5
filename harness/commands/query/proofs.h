// What the commands that save and verify certificates share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "harness/files/output_file.h"
#include "harness/process/isolated_lines.h"

namespace touchstone::commands {

// Writes certificates, one a line. The file is whole after `close`, and its old content stays without.
class SavedCertificates {
 public:
  explicit SavedCertificates(const std::string& file);

  // A line that is no certificate, such as one that others refer to.
  void head(const std::string& line);
  // Adds a certificate for each item, one after the other, in a child process; `setup` is not bounded in time, and an
  // item without a proof within `seconds` is left out. Prints which were; `name_of` names an item. Throws
  // InputError if the setup fails.
  void add_each(std::size_t items, double seconds, const std::function<process::MakeLine()>& setup,
                const std::function<std::string(std::size_t)>& name_of);
  // Prints how many there are. Throws InputError if the file cannot be written.
  void close();

 private:
  files::OutputFile output_;
  std::int64_t count_ = 0;
};

// Counts the certificates of a file, and prints where one is refused and why.
class Verdicts {
 public:
  explicit Verdicts(const std::string& file) : file_(file) {}

  // `why` is empty if the certificate is verified.
  void add(std::int64_t line, const std::string& name, const std::string& why);
  // Prints the numbers; returns the program's exit status.
  int end() const;

 private:
  std::string file_;
  std::int64_t verified_ = 0, refused_ = 0;
};

// Throws InputError if the value is missing that a command needs where it does not verify certificates alone.
void expect_without_certificates(const std::string& value, const char* name);

}  // namespace touchstone::commands
