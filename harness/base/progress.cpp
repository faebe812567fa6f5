// Draws the progress of a long job on standard error.
#include "harness/base/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace touchstone::base {
namespace {

constexpr int bar_width = 24;
constexpr double redraw_seconds = 0.1;
// Nothing is said of the rest before.
constexpr double least_seconds = 2, least_done = 0.02;

}  // namespace

Progress::Progress(std::vector<double> expected)
    : expected_(std::move(expected)),
      all_(std::accumulate(expected_.begin(), expected_.end(), 0.0)),
      terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "{}", line_begin);
}

void Progress::start(const std::string& label) {
  label_ = label;
  before_ += current_;
  current_ = begun_ < expected_.size() ? expected_[begun_] : 0;
  ++begun_;
  if (terminal_) {
    drawn_at_ = -1;
    draw(0);
  } else {
    fmt::print(stderr, "[{}/{}] {:.0f} s{}  {}\n", begun_, expected_.size(), watch_.seconds(),
               time_left(done(0)), label_);
  }
}

void Progress::part(double fraction) {
  if (terminal_) draw(fraction);
}

double Progress::done(double fraction) const {
  return all_ > 0 ? (before_ + fraction * current_) / all_ : 0;
}

std::string Progress::time_left(double done) const {
  const double seconds = watch_.seconds();
  if (seconds < least_seconds || done < least_done) return "";
  const int left = static_cast<int>(std::ceil(seconds * (1 - done) / done / 10)) * 10;
  return left < 60 ? fmt::format(", about {} s left", left)
                   : fmt::format(", about {} min {} s left", left / 60, left % 60);
}

void Progress::draw(double fraction) {
  const double now = watch_.seconds();
  if (drawn_at_ >= 0 && now - drawn_at_ < redraw_seconds) return;
  drawn_at_ = now;
  const double part = done(fraction);
  const int filled = std::clamp(static_cast<int>(part * bar_width), 0, bar_width);
  fmt::print(stderr, "{}[{:#<{}}{:.<{}}] {}/{}  {:.0f} s{}  {}", line_begin, "", filled, "",
             bar_width - filled, begun_, expected_.size(), now, time_left(part), label_);
  std::fflush(stderr);
}

}  // namespace touchstone::base
