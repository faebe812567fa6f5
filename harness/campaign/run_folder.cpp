// Reads and appends the rows of a run's folder.
#include "harness/campaign/run_folder.h"

#include <utility>

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
               .removed = {"reproductions", "tables.md"}}) {
  if (start != record::FolderStart::resume) return;
  for (record::RawRow& row : folder_.rows<record::RawRow>(raw)) findings.add(std::move(row));
  for (record::Departure& one : folder_.rows<record::Departure>(departures))
    findings.add(std::move(one));
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
