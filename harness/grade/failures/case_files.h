// Files of cases below a folder of results, one case per line.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "harness/files/output_file.h"
#include "harness/record/own_files.h"

namespace touchstone::grade {

inline constexpr const char* failures_folder = "failures";

// Writes several such files, each of which is whole or absent.
class CaseFiles {
 public:
  // They are in failures/ of the results folder, and listed there. Throws InputError.
  explicit CaseFiles(const std::filesystem::path& results) : own_(results) {}

  // Appends a line to NAME.jsonl; returns the file's path, with "-2" or so if somebody else has a
  // file of that name there. Throws InputError.
  std::filesystem::path add(const std::string& name, const std::string& line);
  // Throws InputError if a file could not be written.
  void close();

 private:
  record::OwnFiles own_;
  std::map<std::string, std::unique_ptr<files::OutputFile>> files_;  // by name
};

// Removes the files of failures/ that earlier work wrote. Throws InputError.
void remove_case_files(const std::filesystem::path& results);

}  // namespace touchstone::grade
