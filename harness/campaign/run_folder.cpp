#include "harness/campaign/run_folder.h"

#include <utility>

namespace touchstone {
namespace {

constexpr std::size_t raw = 0, departures = 1;

}  // namespace

RunFolder::RunFolder(std::filesystem::path folder, Facts facts, FolderStart start,
                     Findings& findings)
    : folder_(
          {.folder = std::move(folder),
           .files = {{"raw.csv", header_of<RawRow>()}, {"departures.csv", header_of<Departure>()}},
           .identity = std::move(facts),
           .start = start,
           .work = "run",
           .removed = {"reproductions", "tables.md"}}) {
  if (start != FolderStart::resume) return;
  for (RawRow& row : folder_.rows<RawRow>(raw)) findings.add(std::move(row));
  for (Departure& one : folder_.rows<Departure>(departures)) findings.add(std::move(one));
  rows_ = findings.rows().size();
  departures_ = findings.departures().size();
}

void RunFolder::commit(const Findings& findings) {
  if (rows_ == findings.rows().size() && departures_ == findings.departures().size()) return;
  for (; departures_ < findings.departures().size(); ++departures_) {
    folder_.write(departures, findings.departures()[departures_]);
  }
  for (; rows_ < findings.rows().size(); ++rows_) folder_.write(raw, findings.rows()[rows_]);
  folder_.commit();
}

}  // namespace touchstone
