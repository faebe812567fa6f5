// Reads and appends the rows of a run's folder.
#include "harness/campaign/run_folder.h"

#include <algorithm>
#include <utility>

#include "harness/record/own_files.h"

namespace touchstone::campaign {
namespace {

constexpr std::size_t raw = 0, departures = 1;

}  // namespace

std::vector<record::RowFile> run_files() {
  return {{"raw.csv", record::header_of<record::RawRow>()},
          {"departures.csv", record::header_of<record::Departure>()}};
}

RunFolder::RunFolder(std::filesystem::path folder, record::Facts facts, record::FolderStart start,
                     record::Findings& findings)
    : folder_({.folder = std::move(folder),
               .files = run_files(),
               .identity = std::move(facts),
               .start = start,
               .work = "run",
               .made = {"tables.md"}}) {
  if (start != record::FolderStart::resume) return;
  for (record::RawRow& row : folder_.rows<record::RawRow>(raw)) findings.add(std::move(row));
  for (record::Departure& one : folder_.rows<record::Departure>(departures))
    findings.add(std::move(one));
  // A block that was stopped before its end is checked again, and writes these again.
  record::OwnFiles(folder_.path("")).remove([&](const std::string& name) {
    return std::ranges::none_of(findings.departures(), [&](const record::Departure& one) {
      return one.reproduction.ends_with(name);
    });
  });
  rows_ = findings.rows().size();
  departures_ = findings.departures().size();
}

void RunFolder::commit(const record::Findings& findings) {
  if (rows_ == findings.rows().size() && departures_ == findings.departures().size()) return;
  for (; departures_ < findings.departures().size(); ++departures_) {
    folder_.write(departures, findings.departures()[departures_]);
  }
  for (; rows_ < findings.rows().size(); ++rows_) folder_.write(raw, findings.rows()[rows_]);
  folder_.commit();
}

}  // namespace touchstone::campaign
