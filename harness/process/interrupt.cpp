// Catches the signals that ask a program to end.
#include "harness/process/interrupt.h"

#include <array>
#include <csignal>

namespace touchstone::process {
namespace {

constexpr std::array<int, 2> caught = {SIGINT, SIGTERM};

volatile std::sig_atomic_t interrupt = 0;
int guards = 0;
std::array<void (*)(int), caught.size()> previous;

}  // namespace

InterruptGuard::InterruptGuard() {
  if (guards++ > 0) return;
  interrupt = 0;
  for (std::size_t i = 0; i < caught.size(); ++i) {
    previous[i] = std::signal(caught[i], [](int signal) {
      interrupt = signal;
      if (signal == SIGINT) std::signal(signal, SIG_DFL);
    });
  }
}

InterruptGuard::~InterruptGuard() {
  if (--guards > 0) return;
  for (std::size_t i = 0; i < caught.size(); ++i) std::signal(caught[i], previous[i]);
}

int InterruptGuard::signal() { return interrupt; }

}  // namespace touchstone::process
