// Reads a results folder for the page.
#include "harness/report/results_view.h"

#include <fmt/format.h>

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "harness/base/error.h"
#include "harness/report/case_view.h"
#include "harness/stats/samples.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::report {
namespace {

namespace fs = std::filesystem;

// A browser holds a file of this size as text; its rows are parsed when they are looked at.
constexpr std::uintmax_t most_bytes = 256u << 20;

// These files say how a job went on, and nothing about results.
constexpr std::array<std::string_view, 2> of_the_job = {"progress.csv", "jobs.csv"};

// These folders hold pairs and frames that somebody got wrong.
constexpr std::array<std::string_view, 2> of_cases = {"reproductions", "failures"};

std::string read_all(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw base::InputError(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

// Returns the files in a folder whose names end so, in the order of their names.
std::vector<fs::path> files_ending(const fs::path& folder, std::string_view end) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename().string().ends_with(end)) {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

files::OrderedJson csv_files(const fs::path& folder, files::OrderedJson& notes) {
  files::OrderedJson shown = files::OrderedJson::object();
  for (const fs::path& file : files_ending(folder, ".csv")) {
    const std::string name = file.filename().string();
    if (std::ranges::find(of_the_job, name) != of_the_job.end()) continue;
    if (fs::file_size(file) > most_bytes) {
      notes.push_back(fmt::format("{} is left out: it has more than 256 MB.", name));
    } else {
      shown[name] = read_all(file);
    }
  }
  for (const fs::path& file : files_ending(folder, ".csv.xz")) {
    notes.push_back(fmt::format("{} is packed and was not read; `xz -dk` unpacks it.",
                                file.filename().string()));
  }
  return shown;
}

// A run leaves its rows alone; its tables are those that `tables` would write into the folder.
void add_tables(const fs::path& folder, files::OrderedJson& shown, files::OrderedJson& notes) {
  if (!shown.contains("raw.csv") || shown.contains("times.csv")) return;
  std::string name = (fs::temp_directory_path() / "touchstone-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw base::InputError(name + ": cannot be made");
  const std::shared_ptr<void> removed(nullptr, [&](void*) {
    std::error_code ignored;
    fs::remove_all(name, ignored);
  });
  try {
    stats::write_tables(stats::make_tables(stats::read_results(folder), stats::Noise::left_out), 0,
                        name);
    shown.update(csv_files(name, notes));
  } catch (const base::InputError& error) {
    notes.push_back(error.what());  // a run that was stopped has half a row, or none
  }
}

// Returns the case files below the folder, relative to it, in the order of their names.
std::vector<std::string> case_files(const fs::path& folder) {
  std::vector<std::string> files;
  for (const std::string_view below : of_cases) {
    if (!fs::is_directory(folder / below)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder / below)) {
      if (entry.path().extension() == ".jsonl") {
        files.push_back(fs::relative(entry.path(), folder).string());
      }
    }
  }
  std::ranges::sort(files);
  return files;
}

std::vector<ListedCase> cases_of(const ResultsRequest& request, files::OrderedJson& notes) {
  std::vector<ListedCase> cases;
  std::size_t left_out = 0;
  for (const std::string& file : case_files(request.folder)) {
    try {
      for (ListedCase& listed : listed_cases(request.folder, file)) {
        if (std::ssize(cases) == request.most_cases) {
          ++left_out;
        } else {
          cases.push_back(std::move(listed));
        }
      }
    } catch (const base::InputError& error) {
      notes.push_back(error.what());  // a run that was stopped leaves half a file
    }
  }
  if (left_out > 0) {
    notes.push_back(
        fmt::format("{} more pairs are in the folder's case files; --cases draws more.", left_out));
  }
  return cases;
}

}  // namespace

std::vector<fs::path> folders_with_tables(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw base::InputError(folder.string() + ": expected a folder of results");
  }
  std::vector<fs::path> folders;
  if (!files_ending(folder, ".csv").empty()) return {folder};
  for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
    if (!at->is_directory()) continue;
    const std::string name = at->path().filename().string();
    if (std::ranges::find(of_cases, name) != of_cases.end()) {
      at.disable_recursion_pending();
    } else if (!files_ending(at->path(), ".csv").empty()) {
      folders.push_back(at->path());
    }
  }
  if (folders.empty()) {
    throw base::InputError(folder.string() +
                           ": no CSV file in it; expected a folder that run, check, stress, soak, "
                           "trade or advise wrote");
  }
  std::ranges::sort(folders);
  return folders;
}

files::OrderedJson results_view(const ResultsRequest& request) {
  files::OrderedJson notes = files::OrderedJson::array();
  files::OrderedJson shown = csv_files(request.folder, notes);
  add_tables(request.folder, shown, notes);
  const std::vector<ListedCase> cases = cases_of(request, notes);
  return {{"name", request.name},
          {"folder", request.folder.string()},
          {"files", std::move(shown)},
          {"cases", case_views(cases, request.folder, request.time_limit)},
          {"notes", std::move(notes)}};
}

}  // namespace touchstone::report
