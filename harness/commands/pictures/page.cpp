// Runs the program's own command `report`.
#include "harness/commands/pictures/page.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include "harness/commands/program.h"
#include "harness/process/subprocess.h"

namespace touchstone::commands {

namespace {

void run_report(const std::filesystem::path& folder) {
  const std::filesystem::path log = folder / "report.txt";
  const std::string page = (folder / "report.html").string();
  const int status = process::run_and_wait(
      more_program(), {more_first_word(), "report", folder.string(), "--out", page}, log);
  if (status != 0) {
    std::ifstream stream(log);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    fmt::print(stderr, "touchstone: there is no page: {}", text);
  } else {
    fmt::print("{}: the page\n", page);
  }
  std::filesystem::remove(log);
}

}  // namespace

void make_page(const std::filesystem::path& folder) {
  try {
    run_report(folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "touchstone: there is no page: {}\n", error.what());
  }
}

}  // namespace touchstone::commands
