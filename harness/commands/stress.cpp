// touchstone stress: finds the limits of each algorithm's reliability, axis by axis.
#include <fmt/format.h>

#include <memory>

#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/check/axes/stress_run.h"
#include "harness/check/requests/select_cases.h"
#include "harness/commands/arguments.h"
#include "harness/commands/case_selection.h"
#include "harness/commands/commands.h"
#include "harness/commands/pictures/figures.h"
#include "harness/commands/shared_options.h"
#include "harness/files/text_file.h"

namespace touchstone::commands {
namespace {

struct StressOptions {
  check::CaseSelection selection;
  std::string axes, out, page;
  bool quick = false;
  check::StressRequest request;
};

constexpr int quick_cases = 4;

void write_page(const StressOptions& options, const check::StressResult& result,
                const std::string& command, bool drawn) {
  const std::filesystem::path folder = std::filesystem::absolute(options.page).parent_path();
  const std::string pictures = std::filesystem::absolute(options.request.out / "figures")
                                   .lexically_relative(folder)
                                   .string();
  files::write_text(options.page,
                    check::stress_page(options.request, result, command, drawn ? pictures : ""));
}

int stress(StressOptions& options, const std::string& command) {
  check::StressRequest& request = options.request;
  check::select_axes_and_algorithms(options.selection, options.axes, request);
  if (options.quick) request.cases = quick_cases;
  request.out = results_folder(options.out, "stress");
  if (!options.page.empty()) {
    // The page may be in the folder that the sweep is about to make.
    std::error_code ignored;
    std::filesystem::create_directories(request.out, ignored);
    files::check_output(options.page);
  }
  const check::StressResult result = check::run_stress(request);
  if (result.interrupted) return end_interrupted();
  fmt::print("{}", check::stress_text(request, result, base::page_width()));
  fmt::print("\nRows in {}; case files of what is wrong in {}\n",
             (request.out / "stress.csv").string(), (request.out / "failures").string());
  const std::filesystem::path log = request.out / "figures.txt";
  const Drawing maps = draw_figures("stress.py", {request.out.string()}, log);
  if (maps == Drawing::no_matplotlib) {
    fmt::print(
        "The maps are not drawn: that takes Python 3 with matplotlib "
        "(Debian: python3-matplotlib)\n");
  } else if (maps == Drawing::failed) {
    fmt::print("The maps could not be drawn; {} says why\n", log.string());
  }
  if (!options.page.empty()) write_page(options, result, command, maps == Drawing::drawn);
  return result.broken.empty() ? exit_done : exit_measured_wrong;
}

}  // namespace

void add_stress(Arguments command) {
  const auto options = std::make_shared<StressOptions>();
  check::StressRequest& request = options->request;
  add_case_options(command, request, options->selection.pair, options->out, "stress", "sweep");
  add_kinds(command, options->selection);
  command.text("--axes", options->axes, "Axes: names joined by commas (default: all)");
  const Option cases =
      command.number("--cases", request.cases, "Cases of each value; of large hulls at most 12")
          .within(1, 100'000)
          .show_default();
  command
      .flag("--quick", options->quick,
            fmt::format("The same as --cases {}, for a first look", quick_cases))
      .excludes(cases);
  command.text("--page", options->page, "Also write the tables as a Markdown page");
  command.job([options, command] { return stress(*options, command.shell_line("--resume")); });
}

}  // namespace touchstone::commands
