// Counts instructions of narrow-phase queries under Callgrind.
#include "harness/bench/benchmarks.h"

#include <fmt/format.h>

#include <cstdlib>
#include <deque>
#include <fstream>
#include <regex>
#include <vector>

#include "harness/base/error.h"
#include "harness/bench/placed_pairs.h"
#include "harness/files/callgrind.h"
#include "harness/files/csv.h"
#include "harness/process/subprocess.h"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define TOUCHSTONE_CALLGRIND 1
#else
#define TOUCHSTONE_CALLGRIND 0
#endif

namespace touchstone::bench {
namespace {

namespace fs = std::filesystem;

std::vector<NarrowSubject> subjects_of(const std::string& filter) {
  std::regex expression;
  try {
    expression = filter;
  } catch (const std::regex_error& error) {
    throw base::InputError(fmt::format("the filter '{}': {}", filter, error.what()));
  }
  std::vector<NarrowSubject> subjects = narrow_subjects();
  std::erase_if(subjects, [&](const NarrowSubject& subject) {
    return !std::regex_search(subject.name(), expression);
  });
  if (subjects.empty()) {
    throw base::InputError(fmt::format("no narrow-phase benchmark's name matches '{}'", filter));
  }
  return subjects;
}

// A temporary folder for the dumps.
class DumpFolder {
 public:
  DumpFolder() {
    std::string name = (fs::temp_directory_path() / "touchstone-callgrind-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw base::InputError(name, 0, "cannot be made");
    path_ = name;
  }
  ~DumpFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  DumpFolder(const DumpFolder&) = delete;
  DumpFolder& operator=(const DumpFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void count_under_valgrind([[maybe_unused]] const std::string& filter) {
#if TOUCHSTONE_CALLGRIND
  std::deque<std::string> names;  // Callgrind keeps the pointers
  for (const NarrowSubject& subject : subjects_of(filter)) {
    const PlacedPairs& pairs = placed_pairs(subject.families, subject.regime);
    const auto algorithm = subject.entry->make({.scalar = subject.scalar});
    algorithm->bind(pairs.shapes);
    std::vector<Outcome> outcomes(PlacedPairs::count);
    const PairBatch batch = pairs.batch(0, PlacedPairs::count);
    algorithm->solve(subject.task, batch, outcomes);  // allocations that happen once
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    algorithm->solve(subject.task, batch, outcomes);
    names.push_back(subject.name());
    CALLGRIND_DUMP_STATS_AT(names.back().c_str());
    CALLGRIND_STOP_INSTRUMENTATION;
  }
#endif
}

void count_instructions(const std::string& filter, const fs::path& out) {
  if (TOUCHSTONE_CALLGRIND == 0) {
    throw base::InputError(
        "built without Valgrind's headers, which count instructions "
        "(Debian: valgrind)");
  }
  subjects_of(filter);  // a wrong filter is reported at once
  files::check_output(out);
  const DumpFolder folder;
  const int status = process::run_and_wait(
      "valgrind",
      {"--tool=callgrind", "--instr-atstart=no",
       "--callgrind-out-file=" + (folder.path() / "dump").string(),
       fs::read_symlink("/proc/self/exe").string(), "--under-valgrind=" + filter},
      folder.path() / "log");
  if (status != 0) {
    std::ifstream log(folder.path() / "log");
    std::string words((std::istreambuf_iterator<char>(log)), {});
    throw base::InputError(
        fmt::format("valgrind ended with {}: {}", status,
                    words.substr(words.size() - std::min<std::size_t>(words.size(), 500))));
  }
  files::CsvWriter csv(out, {"benchmark", "queries", "instructions"});
  for (int i = 1;; ++i) {
    const fs::path file = folder.path() / fmt::format("dump.{}", i);
    if (!fs::exists(file)) break;
    const files::CallgrindCount dump = files::read_callgrind(file);
    csv.field(dump.name).field(PlacedPairs::count);
    csv.field(static_cast<double>(dump.instructions) / PlacedPairs::count).end_row();
  }
  csv.close();
}

}  // namespace touchstone::bench
