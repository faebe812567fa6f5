// touchstone stress: how far each algorithm can be trusted, axis by axis.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>

#include "harness/base/error.h"
#include "harness/base/text_table.h"
#include "harness/campaign/selection.h"
#include "harness/check/axes/stress_run.h"
#include "harness/commands/checks.h"
#include "harness/commands/commands.h"
#include "harness/record/build_info.h"

namespace touchstone {
namespace {

struct Options {
  std::string narrow = "all", axes, out, page;
  bool quick = false;
  StressRequest request;
};

constexpr int quick_cases = 4;

std::vector<const Axis*> chosen_axes(const std::string& names) {
  std::vector<const Axis*> chosen;
  if (names.empty()) {
    for (const Axis& axis : axes()) chosen.push_back(&axis);
    return chosen;
  }
  for (const std::string& name : split_names(names)) {
    const auto at = std::ranges::find(axes(), name, &Axis::name);
    if (at == axes().end()) {
      std::vector<std::string_view> known;
      for (const Axis& axis : axes()) known.push_back(axis.name);
      throw InputError(
          fmt::format("no axis is called '{}'; expected some of {}", name, fmt::join(known, ", ")));
    }
    if (std::ranges::find(chosen, &*at) == chosen.end()) chosen.push_back(&*at);
  }
  return chosen;
}

// The oracle does not judge itself, unless it is asked to.
std::vector<const NarrowPhaseEntry*> chosen_narrow(const Options& options) {
  const std::vector<std::string> list = split_names(options.narrow);
  auto chosen = select(narrow_phases(), list, "narrow phase");
  const auto is_named = [&](const NarrowPhaseEntry* entry) {
    return std::ranges::find(list, entry->info.name) != list.end();
  };
  std::erase_if(chosen, [&](const NarrowPhaseEntry* entry) {
    return entry->info.origin == Origin::oracle && !is_named(entry);
  });
  for (const NarrowPhaseEntry* entry : chosen) {
    // With all of them, those without the scalar are left out; one that was named is not.
    const bool offered = std::ranges::any_of(
        options.request.scalars, [&](Precision scalar) { return offers(*entry, scalar); });
    if (!is_named(entry) || offered) continue;
    throw InputError(fmt::format("'{}' does not compute in {}; expected another --scalar",
                                 entry->info.name, to_string(options.request.scalars.front())));
  }
  if (chosen.empty()) throw InputError("--narrow names no algorithm; expected at least one");
  return chosen;
}

// A word of the shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += "'\\''";
    } else {
      word += c;
    }
  }
  return word + "'";
}

// Draws the maps where there is a Python with matplotlib; whether it did.
bool draw_maps(const std::filesystem::path& folder) {
  const std::filesystem::path script = std::filesystem::path(source_folder) / "plots" / "stress.py";
  for (const char* python : {"/usr/bin/python3", "python3"}) {
    if (std::system(fmt::format("{} -c 'import matplotlib' 2>/dev/null", python).c_str()) != 0) {
      continue;
    }
    std::fflush(stdout);
    return std::system(
               fmt::format("{} -B {} {}", python, quoted(script.string()), quoted(folder.string()))
                   .c_str()) == 0;
  }
  return false;
}

void write_page(const Options& options, const StressResult& result, const std::string& command,
                bool drawn) {
  const std::filesystem::path folder = std::filesystem::absolute(options.page).parent_path();
  const std::string pictures = std::filesystem::absolute(options.request.out / "figures")
                                   .lexically_relative(folder)
                                   .string();
  std::ofstream stream(options.page, std::ios::binary);
  stream << stress_page(options.request, result, command, drawn ? pictures : "");
  stream.close();
  if (!stream) throw InputError(options.page, 0, "cannot be written");
}

int stress(Options& options, const std::string& command) {
  StressRequest& request = options.request;
  request.narrow = chosen_narrow(options);
  request.cells = cells_of(chosen_axes(options.axes));
  if (options.quick) request.cases = quick_cases;
  request.out = options.out.empty() ? std::filesystem::path(source_folder) / "results/local/stress"
                                    : std::filesystem::path(options.out);
  if (!options.page.empty()) {
    // It may lie in the folder that the sweep is about to make.
    std::error_code ignored;
    std::filesystem::create_directories(request.out, ignored);
    check_output(options.page);
  }
  const StressResult result = run_stress(request);
  fmt::print("{}", stress_text(request, result, page_width()));
  fmt::print("\nRows in {}; case files of what is wrong in {}\n",
             (request.out / "stress.csv").string(), (request.out / "failures").string());
  const bool drawn = draw_maps(request.out);
  if (!drawn) {
    fmt::print(
        "The maps are not drawn: that takes Python 3 with matplotlib "
        "(Debian: python3-matplotlib)\n");
  }
  if (!options.page.empty()) write_page(options, result, command, drawn);
  return result.broken.empty() ? exit_done : exit_measured_wrong;
}

}  // namespace

void add_stress(CLI::App& app, int& status) {
  const auto options = std::make_shared<Options>();
  StressRequest& request = options->request;
  CLI::App& command = *app.add_subcommand(
      "stress",
      "Drive every narrow phase to where it breaks: scale, proportions, distance, gap, ...");
  command.add_option("--narrow", options->narrow, "Narrow phases: names, all, ours, peers")
      ->capture_default_str();
  command.add_option("--axes", options->axes, "Axes: names joined by commas (default: all)");
  const std::map<std::string, Precision> scalars = {{"float", Precision::float32},
                                                    {"double", Precision::float64}};
  command.add_option("--scalar", request.scalars, "float, double (default: both)")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(scalars).description(""));
  CLI::Option* const cases =
      command
          .add_option("--cases", request.cases, "Cases of each value; of large hulls at most 12")
          ->check(CLI::Range(1, 100'000))
          ->capture_default_str();
  command
      .add_flag("--quick", options->quick,
                fmt::format("The same as --cases {}, for a first look", quick_cases))
      ->excludes(cases);
  command.add_option("--seed", request.seed, "Of the cases")->capture_default_str();
  command.add_option("--threads", request.workers, "Processes that share the work")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command
      .add_option("--time-limit", request.time_limit,
                  "Seconds of the processor that a query may take")
      ->check(positive_number)
      ->capture_default_str();
  command.add_option("--out", options->out,
                     "Folder for what is found (default: results/local/stress in the project)");
  command.add_flag("--resume", request.resume, "Go on with the sweep that this folder is of");
  command.add_option("--page", options->page, "Also write the tables as a Markdown page");
  command.callback([options, &app, &status] {
    std::string line = "touchstone stress";
    for (const CLI::Option* option : app.get_subcommand("stress")->get_options()) {
      if (option->count() == 0 || option->get_name() == "--resume") continue;
      line += " " + option->get_name();
      if (option->get_expected_max() > 0) {
        line += " " + fmt::format("{}", fmt::join(option->results(), ","));
      }
    }
    status = stress(*options, line);
  });
}

}  // namespace touchstone
