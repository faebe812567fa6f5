// Reads a results folder for the page.
#include "harness/report/results_view.h"

#include <fmt/format.h>

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "harness/base/error.h"
#include "harness/files/packed_files.h"
#include "harness/report/case_view.h"
#include "harness/report/recorded_pairs.h"
#include "harness/stats/cell_results.h"
#include "harness/stats/cell_tables.h"
#include "harness/stats/samples.h"
#include "harness/stats/tables/tables.h"

namespace touchstone::report {
namespace {

namespace fs = std::filesystem;

// A browser holds a file of this size as text; its rows are parsed when they are looked at.
constexpr std::uintmax_t most_bytes = 256u << 20;

// These files say how a job went on, and nothing about results.
constexpr std::array<std::string_view, 2> of_the_job = {"progress.csv", "jobs.csv"};

// The folder of tables of each machine, where several measured times.
constexpr const char* machines = "machines";

// These folders hold pairs and frames that somebody got wrong.
constexpr std::array<std::string_view, 2> of_cases = {"reproductions", "failures"};

// Returns the content of a file, unpacked, or nothing if it has more than `most_bytes`.
std::optional<std::string> content_of(const fs::path& file) {
  if (fs::file_size(file) > most_bytes) return std::nullopt;
  files::ByteReader bytes(file);
  std::string content;
  for (std::size_t size = 0;;) {
    content.resize(size + (std::size_t{1} << 20));
    const std::size_t got = bytes.read(std::span(content).subspan(size));
    content.resize(size += got);
    if (size > most_bytes) return std::nullopt;
    if (got == 0) return content;
  }
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

// Returns the tables of a folder by name, times.csv for one; each is a plain file, or a packed one
// where there is no plain one.
std::map<std::string, fs::path> tables_in(const fs::path& folder) {
  std::map<std::string, fs::path> tables;
  for (const fs::path& file : files_ending(folder, ".csv")) {
    tables.emplace(file.filename().string(), file);
  }
  for (const fs::path& file : files_ending(folder, files::packed_name(".csv").string())) {
    tables.emplace(file.stem().string(), file);
  }
  return tables;
}

// A file that is read for two ends is named once.
void add_note(files::OrderedJson& notes, const std::string& note) {
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

files::OrderedJson csv_files(const fs::path& folder, files::OrderedJson& notes) {
  files::OrderedJson shown = files::OrderedJson::object();
  for (const auto& [name, file] : tables_in(folder)) {
    if (std::ranges::find(of_the_job, name) != of_the_job.end()) continue;
    try {
      if (std::optional<std::string> content = content_of(file)) {
        shown[name] = std::move(*content);
      } else {
        notes.push_back(fmt::format("{} is left out: it has more than 256 MB.", name));
      }
    } catch (const base::InputError& error) {
      add_note(notes, error.what());
    }
  }
  for (const fs::path& file : files_ending(folder, ".csv.xz")) {
    notes.push_back(fmt::format("{} is packed and was not read; `xz -dk` unpacks it.",
                                file.filename().string()));
  }
  return shown;
}

// True for results of several machines, each of which has tables of its own.
bool has_machines(const fs::path& folder) { return fs::exists(folder / "across.csv"); }

// A run leaves its rows alone; its tables are those that `show --tables` would write into the folder.
void add_tables(const fs::path& folder, files::OrderedJson& shown, files::OrderedJson& notes) {
  const bool has_tables = shown.contains("times.csv") || shown.contains("set_times.csv");
  if (has_tables || !fs::exists(files::row_file(folder / "raw.csv"))) return;
  std::string name = (fs::temp_directory_path() / "touchstone-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw base::InputError(name + ": cannot be made");
  const std::shared_ptr<void> removed(nullptr, [&](void*) {
    std::error_code ignored;
    fs::remove_all(name, ignored);
  });
  try {
    if (stats::is_of_cells(folder)) {
      stats::write_cell_tables(folder, "cells", name);
    } else {
      stats::write_tables(stats::make_tables(stats::read_results(folder), stats::Noise::left_out),
                          0, name);
    }
    shown.update(csv_files(name, notes));
  } catch (const base::InputError& error) {
    add_note(notes, error.what());  // a run that was stopped has half a row, or none
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
    throw base::InputError(folder.string() +
                           (folder.extension() == ".jsonl"
                                ? ": holds single pairs; `touchstone query FILE --page OUT.html` "
                                  "draws them"
                                : ": expected a folder of results"));
  }
  std::vector<fs::path> folders;
  if (!tables_in(folder).empty()) {
    folders = {folder};
    if (has_machines(folder)) {
      for (const fs::path& machine : folders_with_tables(folder / machines))
        folders.push_back(machine);
    }
    return folders;
  }
  for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
    if (!at->is_directory()) continue;
    const std::string name = at->path().filename().string();
    if (std::ranges::find(of_cases, name) != of_cases.end()) {
      at.disable_recursion_pending();
    } else if (!tables_in(at->path()).empty()) {
      folders.push_back(at->path());
    }
  }
  if (folders.empty()) {
    throw base::InputError(folder.string() +
                           ": no CSV file in it; expected a folder that run, check or "
                           "advise wrote");
  }
  std::ranges::sort(folders);
  return folders;
}

files::OrderedJson results_view(const ResultsRequest& request) {
  files::OrderedJson notes = files::OrderedJson::array();
  files::OrderedJson shown = csv_files(request.folder, notes);
  if (has_machines(request.folder)) {
    shown.erase("raw.csv");
    notes.push_back("raw.csv has the rows of several machines; the tables of each are apart.");
  }
  add_tables(request.folder, shown, notes);
  files::OrderedJson cases =
      case_views(cases_of(request, notes), request.folder, request.time_limit);
  try {
    for (files::OrderedJson& view : recorded_pair_views(request.folder, request.time_limit)) {
      cases.push_back(std::move(view));
    }
  } catch (const base::InputError& error) {
    notes.push_back(error.what());
  }
  return {{"name", request.name},
          {"folder", request.folder.string()},
          {"files", std::move(shown)},
          {"cases", std::move(cases)},
          {"notes", std::move(notes)}};
}

}  // namespace touchstone::report
