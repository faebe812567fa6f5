// touchstone advise: finds the cheapest configuration whose error on a scene is within a budget, or
// with --front those that no other beats.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/commands/trade.h"
#include "harness/trade/advice/advice_files.h"

namespace touchstone::commands {
namespace {

struct AdviseOptions {
  trade::TradeRequest request;
  trade::ErrorBudget budget;
  std::string scene, list, out, error;
  bool verify = false, front = false, motion = false, plain = false;
  int draws = 3;
};

void say(const std::string& text) { fmt::print(stderr, "{}\n", text); }

// Advises on one scene. Returns the exit status, and adds what it prints to `said`.
int advise(const trade::AdviceTask& task, const std::filesystem::path& folder, int draws,
           trade::VerificationRows* rows, std::string& said) {
  const trade::Representing ours = representing();
  trade::TradeScene scene(task.request, ours);
  files::expect_other_files(scene.scene.inputs(),
                            std::vector<files::NamedFile>{{"--out", folder / "advice.toml"}});
  std::filesystem::create_directories(folder);
  const trade::AdviceProblem problem{task.request, scene, ours, task.budget, say};
  const trade::Advice advice = trade::advise(problem);
  trade::write_advice(advice, problem, folder);
  const auto print = [&](const std::string& text) {
    fmt::print("{}", text);
    said += text;
  };
  print(trade::advice_text(advice, problem));
  if (!advice.best) {
    if (rows != nullptr) rows->write(problem, nullptr);
    return exit_measured_wrong;
  }
  print(
      fmt::format("\n{}: `touchstone run` measures it again\n", (folder / "advice.toml").string()));
  if (rows == nullptr) return exit_done;
  const trade::Verification verification = trade::verify(
      problem, advice.best->point.configuration, trade::verification_draw, draws, folder / "grid");
  rows->write(problem, &verification);
  print("\n" + trade::verification_text(verification));
  return verification.holds() ? exit_done : exit_measured_wrong;
}

int advise(AdviseOptions& options) {
  std::vector<trade::AdviceTask> tasks;
  std::filesystem::path folder;
  if (!options.list.empty()) {
    tasks = trade::read_advice_list(options.list, options.request);
    folder = results_folder(options.out, "advice");
  } else {
    trade::AdviceTask& task = tasks.emplace_back();
    task.request = options.request;
    task.request.scene = options.scene;
    task.name = task.request.scene.stem().string();
    task.request.name = task.name + "-advice";
    take_measure(options.error, task.request);
    task.budget = options.budget;
    folder = trade_folder(options.out, task.request.name);
  }
  // A file that is no scene, or a disk that is not for writing, is reported before hours of work.
  record::expect_writable(folder);
  for (const trade::AdviceTask& task : tasks) trade::TradeScene(task.request, representing());
  std::filesystem::create_directories(folder);
  std::optional<trade::VerificationRows> rows;
  if (options.verify) rows.emplace(folder, options.draws);
  int status = exit_done;
  std::string said;
  for (const trade::AdviceTask& task : tasks) {
    const int found = advise(task, options.list.empty() ? folder : folder / task.name,
                             options.draws, rows ? &*rows : nullptr, said);
    if (found != exit_done) status = found;
    if (tasks.size() > 1) fmt::print("\n");
    if (tasks.size() > 1) said += "\n";
  }
  keep_summary(folder, said);
  if (rows) {
    rows->close();
    fmt::print("\n{}: a row for each scene\n", (folder / "verification.csv").string());
  }
  return status;
}

int run_front(const AdviseOptions& options) {
  return run_front(FrontOptions{.request = options.request,
                                .scene = options.scene,
                                .out = options.out,
                                .error = options.error,
                                .plain = options.plain,
                                .motion = options.motion});
}

}  // namespace

void add_advise(Arguments command) {
  auto options = std::make_shared<AdviseOptions>();
  const Option scene =
      command.text("scene", options->scene, "Scene file: .toml or rigid-ipc's .json");
  Option list = command.text("--list", options->list, "File of scenes, each with its own error");
  command
      .number("--max-error", options->budget.most,
              "The greatest error that will do, as tests have to show at 95 %")
      .not_negative()
      .show_default();
  command.flag("--no-false-negatives", options->budget.no_false_negatives,
               "No contact may be missed, or be left without an answer");
  add_error_measure(command, options->error);
  const Option verify =
      command.flag("--verify", options->verify,
                   "Hold the advice against the full grid, and against scenes that were not "
                   "looked at");
  command.number("--seeds", options->draws, "How many such scenes")
      .within(1, 100)
      .needs(verify)
      .show_default();
  Option front =
      command.flag("--front", options->front,
                   "Measure every configuration instead, and draw those that no other beats in "
                   "both time and error: the Pareto front");
  command.flag("--no-figure", options->plain, "Leave the figure of the front out").needs(front);
  command
      .flag("--motion", options->motion,
            "Compare substeps of narrow phases with casts, on bodies that move within a frame")
      .needs(front);
  command.text("--out", options->out,
               "Folder (default: results/local/trade-NAME-advice in the project; with --front "
               "trade-NAME)");
  add_trade_axes(command, options->request);
  list.excludes(scene);
  for (const char* name :
       {"--max-error", "--no-false-negatives", "--error", "--task", "--count", "--seed"}) {
    list.excludes(command.option(name));
  }
  front.excludes(list);
  for (const char* name : {"--max-error", "--no-false-negatives", "--verify", "--seeds"}) {
    front.excludes(command.option(name));
  }
  command.job([options, scene, list] {
    if (!scene.given() && !list.given()) {
      throw base::InputError("advise: no scene; expected a scene file, or --list FILE");
    }
    return options->front ? run_front(*options) : advise(*options);
  });
}

}  // namespace touchstone::commands
