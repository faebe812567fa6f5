// Writes and removes files of cases.
#include "harness/grade/failures/case_files.h"

namespace touchstone::grade {

std::filesystem::path CaseFiles::add(const std::string& name, const std::string& line) {
  std::unique_ptr<files::OutputFile>& file = files_[name];
  if (!file) {
    std::filesystem::path path = own_.free_stem(failures_folder, name);
    path += ".jsonl";
    own_.note({path});
    file = std::make_unique<files::OutputFile>(path);
  }
  file->write(line + "\n");
  return file->path();
}

void CaseFiles::close() {
  for (const auto& [name, file] : files_) file->close();
}

void remove_case_files(const std::filesystem::path& results) {
  record::OwnFiles(results).remove(
      [](const std::string& name) { return name.starts_with(std::string(failures_folder) + "/"); });
}

}  // namespace touchstone::grade
