// Tests that lines of items that end are kept, whatever others do.
#include "harness/process/isolate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <sstream>
#include <stdexcept>
#include <string>

namespace touchstone {
namespace {

using process::isolated_lines;
using process::MakeLine;

// Item 3 kills the child, item 5 hangs, item 7 throws; 1 has no line, and that of 8 is long.
std::optional<std::string> line_of(std::size_t item) {
  if (item == 1) return {};
  if (item == 3) std::raise(SIGKILL);
  if (item == 5) pause();
  if (item == 7) throw std::runtime_error("no seven");
  return std::string(item == 8 ? 1'000'000 : 1, static_cast<char>('0' + item));
}

TEST(IsolatedLines, ThoseOfItemsThatEndAreInOrder) {
  std::ostringstream out;
  out << "head\n";
  const auto report = isolated_lines(
      10, {.item_seconds = 1}, []() -> MakeLine { return line_of; },
      [&](const std::string& line) { out << line; });
  EXPECT_EQ(out.str(), "head\n0\n2\n4\n6\n" + std::string(1'000'000, '8') + "\n9\n");
  EXPECT_EQ(report.lines, 6);
  ASSERT_EQ(report.failures.size(), 3u);
  EXPECT_EQ(report.failures[0].item, 3u);
  EXPECT_EQ(report.failures[1].state, process::ItemState::timed_out);
  EXPECT_EQ(report.failures[2].words, "no seven");
}

TEST(IsolatedLines, ASetupThatFailsMakesNone) {
  std::ostringstream out;
  const auto report = isolated_lines(
      4, {}, []() -> MakeLine { throw std::runtime_error("no setup"); },
      [&](const std::string& line) { out << line; });
  EXPECT_EQ(report.lines, 0);
  EXPECT_EQ(out.str(), "");
  ASSERT_EQ(report.failures.size(), 1u);
  EXPECT_TRUE(report.failures[0].in_setup);
  EXPECT_EQ(report.failures[0].words, "no setup");
}

TEST(IsolatedLines, NoItemsMakeNone) {
  std::ostringstream out;
  const auto report = isolated_lines(
      0, {}, []() -> MakeLine { return line_of; }, [&](const std::string& line) { out << line; });
  EXPECT_EQ(report.lines, 0);
  EXPECT_TRUE(report.failures.empty());
}

}  // namespace
}  // namespace touchstone
