// The progress of a long job.
#pragma once

#include <cstddef>
#include <string>

#include "harness/base/clock.h"

namespace touchstone::base {

// A bar that is redrawn on a terminal (standard error), or one line per step elsewhere.
class Progress {
 public:
  // What the bar prints before each drawing: back to the line's begin, and the line is cleared.
  static constexpr const char* line_begin = "\r\033[K";

  // `steps` > 0 is the total number of steps.
  explicit Progress(std::size_t steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Starts the step `label`.
  void start(const std::string& label);
  // Sets the finished fraction of the current step, 0 to 1. Moves the bar and prints no line.
  void part(double fraction);

 private:
  void draw(double fraction);

  std::size_t steps_;
  std::size_t begun_ = 0;
  bool terminal_;
  std::string label_;
  Stopwatch watch_;
  double drawn_at_ = -1;
};

}  // namespace touchstone::base
