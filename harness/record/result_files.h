// The folder of a run: rows as they are measured, and going on behind them after a stop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "harness/files/csv.h"
#include "harness/record/findings.h"

namespace touchstone {

enum class RunStart : std::uint8_t {
  fresh,      // refuses a folder that holds an unfinished run
  overwrite,  // begins anew whatever the folder holds
  resume,     // goes on with what the folder holds
};

using Facts = std::vector<std::pair<std::string, std::string>>;

// raw.csv, departures.csv and machine.csv. A run is unfinished until machine.csv says otherwise.
// The folder is this process's alone meanwhile.
class ResultFiles {
 public:
  // `facts` are those of machine.csv. To resume, they must be the same as in the folder, and the
  // findings are filled from it: without a last line that was cut off, and without the round or the
  // check pass at the end, of which nothing tells whether it is whole. They stay in the files until
  // something is appended: a run that is stopped again before that has lost nothing. InputError
  // where the folder cannot be written, is another run's at the moment, holds what must not be
  // lost, or cannot be resumed.
  ResultFiles(std::filesystem::path folder, Facts facts, RunStart start, Findings& findings);
  ~ResultFiles();
  ResultFiles(const ResultFiles&) = delete;
  ResultFiles& operator=(const ResultFiles&) = delete;

  bool was_finished() const { return was_finished_; }
  // Appends what is new in the findings, and flushes it.
  void write_new(const Findings& findings);
  void finish();

 private:
  std::filesystem::path raw() const { return folder_ / "raw.csv"; }
  std::filesystem::path departures() const { return folder_ / "departures.csv"; }
  std::filesystem::path machine() const { return folder_ / "machine.csv"; }
  void lock();
  void remove_leftovers() const;
  void write_facts(bool finished) const;
  void begin_anew(RunStart start);
  void take_up(Findings& findings);
  void compare_facts();
  void open();

  std::filesystem::path folder_;
  Facts facts_;
  int lock_ = -1;  // the folder, open
  bool was_finished_ = false;
  std::uintmax_t rows_end_ = 0, departures_end_ = 0;      // bytes that are kept
  std::unique_ptr<CsvWriter> row_file_, departure_file_;  // null until something is appended
  std::size_t rows_written_ = 0, departures_written_ = 0;
};

}  // namespace touchstone
