// A table of times with the fastest of each column marked, where the samples can tell.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/campaign/set_times.h"

namespace touchstone {

// Rows and columns keep the order in which they first came.
class TimeGrid {
 public:
  // `unit` in seconds: times are printed in it. `noisy`: rounds with flags count too.
  TimeGrid(double unit, bool noisy) : unit_(unit), noisy_(noisy) {}

  // The samples of a cell: those of this contestant in these sets.
  void add_samples(const std::string& row, const std::string& column, const SetTimes& set,
                   const std::string& contestant);
  // Stands in for a time, or behind it: a cell with a note cannot be the fastest.
  void add_note(const std::string& row, const std::string& column, const std::string& note);
  // Makes room for a row, so that it comes in this place.
  void add_cell(const std::string& row, const std::string& column);
  void add_remark(const std::string& row, std::string remark) { remarks_[row] = std::move(remark); }

  bool empty() const { return rows_.empty(); }
  const std::vector<std::string>& rows() const { return rows_; }

  // "*12.3 ±2%": the median and the half-width of its interval. * is the fastest by the interval of
  // the ratio, = cannot be told from the fastest, ? has no round without a flag.
  std::string text(const std::string& remark_title, std::size_t page_width) const;
  // One line a column: the winner against the runner-up.
  std::string winners() const;

 private:
  struct Cell {
    std::vector<std::pair<const SetTimes*, std::string>> parts;
    std::string note;
  };
  struct Ranking {  // of a column
    std::string first, second;
    bool alone = false;                // no other can be the fastest
    std::vector<std::string> leaders;  // that may be it
    stats::MedianInterval log_ratio;   // of the second to the first
  };
  const Cell* find(const std::string& row, const std::string& column) const;
  std::vector<double> times(const Cell& cell, bool noisy) const;
  double least(const Cell& cell) const;  // of the times, of which there is at least one
  double greatest(const Cell& cell) const;
  stats::MedianInterval log_ratio(const Cell& a, const Cell& b) const;
  Ranking rank(const std::string& column) const;
  std::string cell_text(const Cell& cell, const std::string& row, const Ranking& ranking) const;

  double unit_;
  bool noisy_;
  std::vector<std::string> rows_, columns_;
  std::map<std::pair<std::string, std::string>, Cell> cells_;
  std::map<std::string, std::string> remarks_;
};

}  // namespace touchstone
