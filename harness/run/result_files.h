// The folder of a run: rows as they are measured, and going on behind them after a stop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/io/csv.h"
#include "harness/run/findings.h"

namespace touchstone {

enum class RunStart : std::uint8_t {
  fresh,      // refuses a folder that holds an unfinished run
  overwrite,  // begins anew whatever the folder holds
  resume,     // goes on with what the folder holds
};

using Facts = std::vector<std::pair<std::string, std::string>>;

// raw.csv, departures.csv and machine.csv. A run is unfinished until machine.csv says otherwise.
class ResultFiles {
 public:
  // `facts` are those of machine.csv. To resume, they must be the same as in the folder, and the
  // findings are filled from it: without a last line that was cut off, and without the round or the
  // check pass at the end, of which nothing tells whether it is whole. InputError where the folder
  // cannot be written, holds what must not be lost, or cannot be resumed.
  ResultFiles(std::filesystem::path folder, Facts facts, RunStart start, Findings& findings);

  bool was_finished() const { return was_finished_; }
  // Appends what is new in the findings, and flushes it.
  void write_new(const Findings& findings);
  void finish();

 private:
  std::filesystem::path raw() const { return folder_ / "raw.csv"; }
  std::filesystem::path departures() const { return folder_ / "departures.csv"; }
  std::filesystem::path machine() const { return folder_ / "machine.csv"; }
  void write_facts(bool finished) const;
  void begin_anew(RunStart start);
  void take_up(Findings& findings);
  void compare_facts();

  std::filesystem::path folder_;
  Facts facts_;
  bool was_finished_ = false;
  std::unique_ptr<CsvWriter> row_file_, departure_file_;
  std::size_t rows_written_ = 0, departures_written_ = 0;
};

}  // namespace touchstone
