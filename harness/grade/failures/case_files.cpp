// Writes and removes files of cases.
#include "harness/grade/failures/case_files.h"

#include <system_error>
#include <utility>

#include "harness/base/error.h"

namespace touchstone::grade {

CaseFiles::CaseFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

std::filesystem::path CaseFiles::add(const std::string& name, const std::string& line) {
  std::filesystem::path file = folder_ / (name + ".jsonl");
  std::ofstream& stream = streams_[file];
  if (!stream.is_open()) {
    std::error_code ignored;
    std::filesystem::create_directories(folder_, ignored);
    stream.open(file, std::ios::binary);
  }
  stream << line << '\n';
  return file;
}

void CaseFiles::close() {
  for (auto& [file, stream] : streams_) {
    stream.close();
    if (!stream) throw base::InputError(file.string(), 0, "cannot be written");
  }
}

void remove_case_files(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".jsonl" || ending == ".off" || ending == ".csv") {
      std::filesystem::remove(entry.path());
    }
  }
}

}  // namespace touchstone::grade
