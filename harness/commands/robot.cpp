// touchstone robot: which links of a robot touch, what its SRDF file hides, and who finds it out fastest.
#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/table.h"
#include "harness/cells/cell_run.h"
#include "harness/cells/read_cells.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/text_file.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/report/link_contacts.h"
#include "harness/scene/robot/planning_scene.h"
#include "harness/scene/robot/robot.h"
#include "harness/scene/scene.h"
#include "harness/stats/cell_results.h"
#include "harness/trade/advice/budget.h"

namespace touchstone::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_rows_shown = 12;
constexpr double frame_seconds = 10;
constexpr std::size_t most_timed = 1000;  // the first configurations

struct RobotOptions {
  std::string robot, scene, srdf, path, out, meshes = "surface";
  int random = 1000;
  std::int64_t seed = 1;
  std::vector<std::string> packages;
  bool overwrite = false;
};

// Each word is NAME=FOLDER, or a folder that has packages in it.
scene::Packages packages_of(const RobotOptions& options) {
  scene::Packages packages;
  for (const std::string& word : options.packages) {
    const std::size_t at = word.find('=');
    if (at == std::string::npos) {
      packages.folders.push_back(fs::absolute(word));
    } else {
      packages.named[word.substr(0, at)] = fs::absolute(word.substr(at + 1));
    }
  }
  if (!packages.named.empty() && !packages.folders.empty()) {
    throw base::InputError("--packages: expected NAME=FOLDER throughout, or folders of packages");
  }
  return packages;
}

// The text of a scene of the robot and what is around it, for `run` and others.
std::string scene_text(const RobotOptions& options) {
  toml::table keys;
  const auto absolute = [](const std::string& file) { return fs::absolute(file).string(); };
  toml::array imports{absolute(options.robot)};
  if (scene::is_yaml(options.scene)) {
    keys.insert("obstacles", absolute(options.scene));
  } else if (!options.scene.empty()) {
    imports.push_back(absolute(options.scene));
  }
  keys.insert("name", fs::path(options.robot).stem().string());
  keys.insert("import", std::move(imports));
  if (!options.srdf.empty()) keys.insert("srdf", absolute(options.srdf));
  const scene::Packages packages = packages_of(options);
  if (!packages.named.empty()) {
    toml::table named;
    for (const auto& [name, folder] : packages.named) named.insert(name, folder.string());
    keys.insert("packages", std::move(named));
  } else if (!packages.folders.empty()) {
    toml::array folders;
    for (const fs::path& folder : packages.folders) folders.push_back(folder.string());
    keys.insert("packages", std::move(folders));
  }
  keys.insert("meshes", options.meshes);
  keys.insert("moving", false);
  if (!options.path.empty()) {
    keys.insert("configurations", absolute(options.path));
  } else {
    keys.insert("configurations",
                toml::table{{"random", std::int64_t{options.random}}, {"seed", options.seed}});
  }
  std::ostringstream text;
  text << "# Written by `touchstone robot`: the robot, and around it bodies that stand still.\n"
       << keys << "\n";
  return text.str();
}

std::string share(std::size_t count, std::size_t of) {
  return fmt::format("{:.3g} %", 100 * static_cast<double>(count) / static_cast<double>(of));
}

void print_pairs(const std::string& title, std::vector<report::LinkPair> pairs, std::size_t of) {
  if (pairs.empty()) return;
  std::ranges::stable_sort(pairs, std::greater{}, &report::LinkPair::touching);
  fmt::print("\n{}\n", title);
  base::Table table({"links", "touch in", ""});
  for (std::size_t i = 0; i < std::min(pairs.size(), most_rows_shown); ++i) {
    const report::LinkPair& pair = pairs[i];
    table.add(
        {pair.first + ", " + pair.second, std::to_string(pair.touching), share(pair.touching, of)});
  }
  fmt::print("{}", table.text(base::page_width()));
  if (pairs.size() > most_rows_shown) {
    fmt::print("and {} more pairs\n", pairs.size() - most_rows_shown);
  }
}

void write_csv(const fs::path& file, const report::LinkContacts& found) {
  files::CsvWriter csv(file,
                       {"first", "second", "disabled", "configurations", "touching", "unknown"});
  for (const report::LinkPair& pair : found.pairs) {
    csv.field(pair.first).field(pair.second).field(pair.is_disabled ? "yes" : "no");
    csv.field(found.configurations).field(pair.touching).field(pair.unknown);
    csv.end_row();
  }
  csv.close();
}

std::string in_xml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '"': escaped += "&quot;"; break;
      default: escaped += base::has_control({&c, 1}) ? '?' : c;
    }
  }
  return escaped;
}

// Links with shapes that a joint joins.
std::vector<IndexPair> joined_with_shapes(const scene::Robot& robot) {
  std::vector<IndexPair> pairs;
  for (const auto& [a, b] : robot.joined) {
    if (!robot.links[a].shapes.empty() && !robot.links[b].shapes.empty()) pairs.push_back({a, b});
  }
  return pairs;
}

// What an SRDF file may disable: joined links, and links that always or, of configurations at random, never touched.
std::string proposal(const scene::Robot& robot, const report::LinkContacts& found,
                     bool are_at_random) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- Seen in {} configurations. Look at each line: what was never "
      "seen may happen. -->\n"
      "<robot name=\"{}\">\n",
      found.configurations, in_xml(robot.name));
  const auto add = [&](const std::string& first, const std::string& second, const char* reason) {
    text += fmt::format("  <disable_collisions link1=\"{}\" link2=\"{}\" reason=\"{}\"/>\n",
                        in_xml(first), in_xml(second), reason);
  };
  for (const auto& [a, b] : joined_with_shapes(robot)) {
    add(robot.links[a].name, robot.links[b].name, "Adjacent");
  }
  for (const report::LinkPair& pair : found.pairs) {
    if (!pair.is_of_links || pair.unknown > 0) continue;
    if (pair.touching == found.configurations) add(pair.first, pair.second, "Always");
    if (pair.touching == 0 && are_at_random) add(pair.first, pair.second, "Never");
  }
  return text + "</robot>\n";
}

std::string timed_text() {
  return fmt::format(
      R"(# Written by `touchstone robot`: who says fastest whether configurations are free, and who is wrong.
[[group]]
kind = "configuration"
scenes = ["scene.toml"]
tasks = ["free"]
queries = {}
rounds = 6
)",
      most_timed);
}

// The folder of the measurements that `timed_file` asks for.
fs::path times_folder(const fs::path& timed_file) { return timed_file.parent_path() / "times"; }

// What of the graded answers is wrong, in words.
std::string faults_of(const stats::GradeRow& grade) {
  std::vector<std::string> faults;
  const auto add = [&](std::int64_t count, std::string_view what) {
    if (count > 0) faults.push_back(fmt::format("{} {}", count, what));
  };
  add(grade.missed, "contacts that it missed");
  add(grade.false_hits, "contacts that are none");
  add(grade.inexact, "contacts with a pair that does not touch");
  return fmt::format("{}", fmt::join(faults, ", "));
}

// Times configuration queries, as `run` does with the file. Returns the exit status. `all`: the configurations, of which
// the first are timed.
int print_times(const fs::path& file, std::size_t all) {
  const fs::path folder = times_folder(file);
  const cells::CellRequest request = cells::read_cells(file);
  const cells::CellRunResult result =
      cells::run_cells(request, folder, record::FolderStart::overwrite, [](const std::string&) {});
  if (result.interrupted) return end_interrupted();
  for (const stats::CellTimes& set : stats::read_cell_times(folder)) {
    fmt::print("\nWho says fastest whether a configuration is free ({}){}:\n", set.name.first,
               all > most_timed ? fmt::format(", of the first {} of {}", most_timed, all) : "");
    base::Table table({"algorithm", "", "configurations a second", "wrong", "given up"});
    std::vector<stats::CellTimeRow> rows = set.rows;
    std::ranges::stable_sort(rows, [](const stats::CellTimeRow& a, const stats::CellTimeRow& b) {
      return std::pair(!(a.seconds > 0), a.seconds) < std::pair(!(b.seconds > 0), b.seconds);
    });
    for (const stats::CellTimeRow& row : rows) {
      const stats::GradeRow& grade = row.grade;
      table.add({grade.algorithm, grade.origin == "peer" ? "library" : grade.origin,
                 row.seconds > 0 ? fmt::format("{:.3g}", 1 / row.seconds) : grade.status,
                 fmt::format("{} of {}", grade.silent(), grade.graded),
                 std::to_string(grade.gave_up)});
    }
    fmt::print("{}", table.text(base::page_width()));
    for (const stats::CellTimeRow& row : rows) {
      if (row.grade.silent() == 0) continue;
      fmt::print("Wrong answers of {}: {}\n", row.grade.algorithm, faults_of(row.grade));
    }
  }
  return result.ours_wrong ? exit_measured_wrong : exit_done;
}

// Throws InputError for a file whose name ends otherwise.
void expect_ending(const std::string& file, std::initializer_list<std::string_view> endings,
                   std::string_view expected) {
  const std::string ending = fs::path(file).extension().string();
  if (std::ranges::find(endings, ending) != endings.end()) return;
  throw base::InputError(
      file, 0,
      fmt::format("found the ending '{}'; expected {}", base::printable(ending), expected));
}

int look_at(const RobotOptions& options) {
  const fs::path out =
      results_folder(options.out, fs::path(options.robot).stem().string(), "robot-");
  const fs::path scene_file = out / "scene.toml", pairs_file = out / "pairs.csv",
                 srdf_file = out / "proposed.srdf", timed_file = out / "configurations.toml";
  for (const std::string& file : {options.robot, options.scene, options.srdf, options.path}) {
    if (!file.empty()) base::check_kind(file, "a file of the robot");
  }
  expect_ending(options.robot, {".urdf"},
                fs::path(options.robot).extension() == ".xacro"
                    ? "a robot (.urdf): xacro FILE > robot.urdf makes one"
                    : "a robot (.urdf)");
  if (!options.scene.empty() && !scene::is_yaml(options.scene)) {
    expect_ending(options.scene, {".toml", ".json"},
                  "a scene (.toml, .json), or MoveIt's planning scene (.yaml)");
  }
  // Faults of the robot are told with its own lines.
  const scene::Robot robot = scene::read_robot(options.robot, options.srdf, packages_of(options));
  const std::string text = scene_text(options);
  const scene::Scene scene = scene::scene_of_text(text, scene_file);
  std::vector<files::NamedFile> outputs;
  for (const fs::path& file : {scene_file, pairs_file, srdf_file, timed_file}) {
    outputs.push_back({"--out", file});
  }
  for (const fs::path& file :
       {scene_file, pairs_file, srdf_file, timed_file, times_folder(timed_file)}) {
    std::error_code error;
    if (!options.overwrite && fs::exists(file, error)) {
      throw base::InputError(file.string() + " is there; expected another --out, or --overwrite");
    }
  }
  std::size_t shapes = 0;
  for (const scene::Link& link : robot.links) shapes += link.shapes.size();
  if (scene.tracks.bodies.size() != shapes) {
    throw base::InputError(
        options.scene, 0,
        "has bodies that follow poses of their own; expected bodies that stand still");
  }
  fs::create_directories(out);
  files::check_outputs(scene.inputs(), outputs);
  const report::LinkContacts found = report::link_contacts(scene, robot, frame_seconds);
  const std::size_t all = found.configurations;

  const auto moving = std::ranges::count_if(robot.joints, &scene::Joint::is_free);
  fmt::print("{}: {} links, {} shapes, {} joints with a value; {} bodies around it\n",
             base::printable(robot.name), robot.links.size(), shapes, moving,
             scene.bodies.size() - shapes);
  for (const std::string& link : robot.unknown_links) {
    fmt::print("Left out: what SRDF says of \"{}\", which the robot does not have\n",
               base::printable(link));
  }
  if (const std::size_t joined = joined_with_shapes(robot).size(); joined > 0) {
    fmt::print(
        "Not asked: {} pairs of links that a joint joins, directly or through links without "
        "shapes; proposed.srdf calls them Adjacent\n",
        joined);
  }
  const bool is_any_asked = std::ranges::any_of(
      found.pairs, [](const report::LinkPair& pair) { return !pair.is_disabled; });
  fmt::print("Free: {} of {} configurations, {}: {}{}\n", found.free, all, share(found.free, all),
             is_any_asked ? "no pair touches that is asked" : "no pair is asked",
             found.unknown > 0 ? fmt::format("; not known of {}", found.unknown) : "");

  std::vector<report::LinkPair> always, some, hidden;
  std::size_t never = 0, never_disabled = 0, unknown = 0;
  for (const report::LinkPair& pair : found.pairs) {
    if (pair.touching == 0 && pair.unknown > 0) {
      ++unknown;
    } else if (pair.touching == 0) {
      ++(pair.is_disabled ? never_disabled : never);
    } else if (pair.is_disabled) {
      hidden.push_back(pair);
    } else {
      (pair.touching == all ? always : some).push_back(pair);
    }
  }
  print_pairs("Contacts that SRDF hides, for it disables these pairs:", hidden, all);
  print_pairs("Always in contact: the shapes overlap, or something is placed wrong:", always, all);
  print_pairs("In contact in some configurations:", some, all);
  fmt::print("\nNever seen in contact: {} pairs that are asked, {} that SRDF disables\n", never,
             never_disabled);
  if (unknown > 0) fmt::print("Not known in some configuration: {} pairs\n", unknown);
  if (options.path.empty() && never + never_disabled > 0) {
    fmt::print("Each of them touches in less than {:.2g} % of such configurations, at 95 %\n",
               100 * trade::greatest_share(0, static_cast<std::int64_t>(all)));
  }
  files::write_text(scene_file, text);
  write_csv(pairs_file, found);
  files::write_text(srdf_file, proposal(robot, found, options.path.empty()));
  int status = exit_done;
  if (is_any_asked) {
    files::write_text(timed_file, timed_text());
    status = print_times(timed_file, all);
  }
  fmt::print("\nAll pairs that are asked, or that SRDF disables: {}\n", pairs_file.string());
  fmt::print("An SRDF file that leaves out joined links and what always{} touched: {}\n",
             options.path.empty() ? " or never" : "", srdf_file.string());
  if (!is_any_asked) return status;
  fmt::print(
      "These times again, with intervals: touchstone run {} --out {}\n"
      "Broad and narrow phases apart: touchstone run --scene {} --frames {} --out {}\n",
      timed_file.string(), (out / "times-again").string(), scene_file.string(),
      std::min<std::size_t>(64, all), (out / "phases").string());
  return status;
}

}  // namespace

void add_robot(Arguments command) {
  const auto options = std::make_shared<RobotOptions>();
  command.text("ROBOT", options->robot, "URDF file").is_read().required();
  command
      .text("--scene", options->scene,
            "Bodies around it, which stand still: a scene file, or MoveIt's planning scene (.yaml)")
      .is_read();
  command.text("--srdf", options->srdf, "Default: the file of that ending beside the URDF file")
      .is_read();
  const Option path = command
                          .text("--configurations", options->path,
                                "A CSV of joint values, or MoveIt's request (.yaml)")
                          .is_read();
  command.number("--random", options->random, "Configurations at random within the limits")
      .within(1, 1'000'000)
      .show_default()
      .excludes(path);
  command.number("--seed", options->seed, "Of the random ones")
      .within(0, INT64_MAX)
      .show_default()
      .excludes(path);
  command
      .texts("--packages", options->packages,
             "Where package:// lies: NAME=FOLDER, or folders in which packages are")
      .separated_by_commas();
  command.flag("--overwrite", options->overwrite, "Replaces the files of an earlier call");
  const auto& uses = geometry::mesh_use_names;
  command.text("--meshes", options->meshes, "What meshes are")
      .among({uses.begin(), uses.end()})
      .show_default();
  command.text("--out", options->out,
               "Folder for pairs.csv, proposed.srdf, scene.toml and times (default: "
               "results/local/robot-NAME)");
  command.footer(
      "Convex bodies are asked by `certified`, meshes by `fused`. scene.toml is for `run --scene`, "
      "`advise` and `report --scene`.");
  command.job([options] { return look_at(*options); });
}

}  // namespace touchstone::commands
