// Runs the program's own command `report`, and the scripts of plots/.
#include "harness/commands/pictures.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include "harness/base/data_folder.h"
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

Drawing draw_figures(const std::string& script, const std::vector<std::string>& arguments,
                     const std::filesystem::path& log) {
  const std::filesystem::path plots = base::data_folder().path / "plots";
  std::vector<std::string> words = {"-B", (plots / script).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int status = process::run_and_wait((plots / "python").string(), words, log);
  if (status != 0 && status != 127) return Drawing::failed;
  std::filesystem::remove(log);
  return status == 0 ? Drawing::drawn : Drawing::no_matplotlib;
}

}  // namespace touchstone::commands
