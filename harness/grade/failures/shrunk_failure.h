// A failing query, with its case made as small as possible, and the files of cases below a folder
// of results.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "harness/files/cases.h"
#include "harness/files/output_file.h"
#include "harness/grade/graded_answer.h"
#include "harness/record/folder_files.h"

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

struct FailedQuery {
  const NarrowPhaseEntry* algorithm;
  bool extreme;       // trait of the regime, see margins.h
  double time_limit;  // seconds for one query
  files::Case original;
  GradedAnswer answer;  // the answer for the original
};

struct ShrunkFailure {
  GradedAnswer answer;  // the answer for the case in the line
  // A line of a case file: the case, and further keys, which readers of cases ignore, for the exact
  // answer and the fault.
  std::string line;

  template <class Visit>
  void for_each_field(Visit visit) {
    visit(answer);
    visit(line);
  }
};

// Shrinks the case while it still fails in the same way, for at most a second. This takes place in
// a child process, since a query on the way may kill it; in that event the case stays as it is.
ShrunkFailure shrunk_failure(const FailedQuery& failed);

}  // namespace touchstone::grade
