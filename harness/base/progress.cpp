// Draws the progress of a long job on standard error.
#include "harness/base/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>

namespace touchstone::base {
namespace {

constexpr int bar_width = 24;
constexpr double redraw_seconds = 0.1;

}  // namespace

Progress::Progress(std::size_t steps)
    : steps_(std::max<std::size_t>(steps, 1)), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "{}", line_begin);
}

void Progress::start(const std::string& label) {
  label_ = label;
  ++begun_;
  if (terminal_) {
    drawn_at_ = -1;
    draw(0);
  } else {
    fmt::print(stderr, "[{}/{}] {:.0f} s  {}\n", begun_, steps_, watch_.seconds(), label_);
  }
}

void Progress::part(double fraction) {
  if (terminal_) draw(fraction);
}

void Progress::draw(double fraction) {
  const double now = watch_.seconds();
  if (drawn_at_ >= 0 && now - drawn_at_ < redraw_seconds) return;
  drawn_at_ = now;
  const double done = (static_cast<double>(begun_) - 1 + fraction) / static_cast<double>(steps_);
  const int filled = std::clamp(static_cast<int>(done * bar_width), 0, bar_width);
  fmt::print(stderr, "{}[{:#<{}}{:.<{}}] {:3.0f} %  {:.0f} s  {}", line_begin, "", filled, "",
             bar_width - filled, 100 * done, now, label_);
  std::fflush(stderr);
}

}  // namespace touchstone::base
