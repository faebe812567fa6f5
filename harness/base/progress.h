// The progress of a long job.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/base/clock.h"

namespace touchstone::base {

// A bar that is redrawn on a terminal (standard error), or one line per step elsewhere. Both say how
// long the rest takes.
class Progress {
 public:
  // What the bar prints before each drawing: back to the line's begin, and the line is cleared.
  static constexpr const char* line_begin = "\r\033[K";

  // `expected` has the share of the time of each step: numbers of one unit, none below 0.
  explicit Progress(std::vector<double> expected);
  // These steps take equally long.
  explicit Progress(std::size_t steps) : Progress(std::vector<double>(steps, 1.0)) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Starts the step `label`.
  void start(const std::string& label);
  // Sets the finished fraction of the current step, 0 to 1. Moves the bar and prints no line.
  void part(double fraction);

 private:
  void draw(double fraction);
  // Returns the part of the work that is done, from 0 to 1.
  double done(double fraction) const;
  std::string time_left(double done) const;

  std::vector<double> expected_;
  double all_;                       // the sum of all
  double before_ = 0, current_ = 0;  // of the steps that are done, and of the current one
  std::size_t begun_ = 0;
  bool terminal_;
  std::string label_;
  Stopwatch watch_;
  double drawn_at_ = -1;
};

}  // namespace touchstone::base
