// Runs the scripts of plots/.
#include "harness/commands/pictures/figures.h"

#include "harness/process/subprocess.h"
#include "harness/record/build_info.h"

namespace touchstone::commands {

Drawing draw_figures(const std::string& script, const std::vector<std::string>& arguments,
                     const std::filesystem::path& log) {
  const std::filesystem::path plots = std::filesystem::path(record::source_folder) / "plots";
  std::vector<std::string> words = {"-B", (plots / script).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int status = process::run_and_wait((plots / "python").string(), words, log);
  if (status != 0 && status != 127) return Drawing::failed;
  std::filesystem::remove(log);
  return status == 0 ? Drawing::drawn : Drawing::no_matplotlib;
}

}  // namespace touchstone::commands
