// Files of cases in a folder, one case per line.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace touchstone::grade {

// Writes several such files; each is created with its first line.
class CaseFiles {
 public:
  explicit CaseFiles(std::filesystem::path folder);

  // Appends a line to NAME.jsonl; returns the file's path.
  std::filesystem::path add(const std::string& name, const std::string& line);
  // Throws InputError if a file could not be written.
  void close();

 private:
  std::filesystem::path folder_;
  std::map<std::filesystem::path, std::ofstream> streams_;
};

// Removes the case files of earlier work from the folder.
void remove_case_files(const std::filesystem::path& folder);

}  // namespace touchstone::grade
