// How far a long job is.
#pragma once

#include <cstddef>
#include <string>

#include "harness/base/clock.h"

namespace touchstone {

// A bar that is drawn over itself on a terminal (standard error), a line a step otherwise.
class Progress {
 public:
  // `steps` > 0 in all.
  explicit Progress(std::size_t steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Step `label` begins.
  void start(const std::string& label);
  // How much of the present step is done, 0 to 1: moves the bar, prints no line.
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

}  // namespace touchstone
