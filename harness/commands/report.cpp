// touchstone report: makes a page of results and scenes that opens in a browser.
#include "harness/commands/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/data_folder.h"
#include "harness/base/error.h"
#include "harness/campaign/campaign.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/packed_files.h"
#include "harness/files/toml_table.h"
#include "harness/kinds/selection.h"
#include "harness/modules/file_word.h"
#include "harness/modules/modules.h"
#include "harness/record/machine.h"
#include "harness/report/page_file.h"
#include "harness/report/recording_view.h"
#include "harness/report/results_view.h"

namespace touchstone::commands {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::vector<std::string> results, versions, scenes, peers;
  std::string narrow = "certified,gjk", broad = "uniform-grid,linear-bvh,sweep-and-prune";
  std::string out, page, with;
  scene::SceneOverrides overrides;
  int frames = report::RecordingRequest{}.most_frames;
  int cases = report::ResultsRequest{}.most_cases;
  double time_limit = report::ResultsRequest{}.time_limit;
};

// The launcher builds the page beside the programs; an installation has it among its data.
fs::path usual_page() {
  if (base::data_folder().is_installed) return base::data_folder().path / "page.html";
  return fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "page" / "page.html";
}

files::OrderedJson made() {
  files::OrderedJson facts = {{"date", record::date_now()}};
  for (const auto& [name, value] : record::machine_facts()) {
    if (name == "touchstone") facts["version"] = value;
    if (name == "commit" || name == "tree") facts[name] = value;
    if (name == record::command_line_fact) facts["command"] = value;
  }
  return facts;
}

files::OrderedJson origins() {
  files::OrderedJson names = files::OrderedJson::object();
  const auto add = [&](const auto& entries) {
    for (const auto& entry : entries) names[entry.info.name] = to_string(entry.info.origin);
  };
  add(registry::entries<BroadPhaseEntry>());
  add(registry::entries<NarrowPhaseEntry>());
  return names;
}

// Algorithms whose errors are known by design, and are no fault.
files::OrderedJson approximate() {
  files::OrderedJson names = files::OrderedJson::array();
  for (const NarrowPhaseEntry& entry : registry::entries<NarrowPhaseEntry>()) {
    if (entry.traits.approximate) names.push_back(entry.info.name);
  }
  for (const ConcaveEntry& entry : registry::entries<ConcaveEntry>()) {
    if (entry.approximate) names.push_back(entry.info.name);
  }
  return names;
}

// Loads the modules of --with, and adds what they offer to the phases that a scene shows.
void add_modules(ReportOptions& options) {
  if (options.with.empty()) return;
  expect_module_files(options.with);
  modules::load_named(options.with);
  for (const std::string& word : kinds::split_names(options.with)) {
    const std::string file = modules::file_of(word);
    bool has_some = false;
    const auto add = [&]<class Entry>(std::span<const Entry> entries, std::string& names) {
      for (const Entry& entry : entries) {
        if (registry::module_of(entry.info) != file) continue;
        names = joined_names(names, entry.info.name);
        has_some = true;
      }
    };
    add(registry::entries<NarrowPhaseEntry>(), options.narrow);
    add(registry::entries<BroadPhaseEntry>(), options.broad);
    if (has_some) continue;
    throw base::InputError(
        fmt::format("--with {}: has neither narrow nor broad phases; expected some, since a scene "
                    "shows no other kinds",
                    word));
  }
}

// `peers` are asked too.
report::RecordingRequest recording_request(const ReportOptions& options, const std::string& peers) {
  report::RecordingRequest request;
  request.page = options.out;
  request.overrides = options.overrides;
  request.most_frames = options.frames;
  request.time_limit = options.time_limit;
  request.narrow =
      kinds::select(registry::entries<NarrowPhaseEntry>(),
                    kinds::split_names(joined_names(options.narrow, peers)), "narrow phase");
  request.broad = kinds::select(registry::entries<BroadPhaseEntry>(),
                                kinds::split_names(options.broad), "broad phase");
  return request;
}

// Adds a request for each scene of the group that is not among them yet.
void add_scenes(const campaign::CampaignGroup& group, report::RecordingRequest request,
                std::vector<report::RecordingRequest>& all) {
  for (const fs::path& scene : group.scenes) {
    for (const std::int64_t count : group.counts) {
      for (const std::int64_t seed : group.seeds) {
        for (const std::optional<double> gap : group.gaps) {
          request.scene = scene;
          request.overrides = {.count = count, .seed = seed, .frames = group.frames, .gap = gap};
          if (std::ranges::find(all, request.key(), &report::RecordingRequest::key) == all.end()) {
            all.push_back(request);
          }
        }
      }
    }
  }
}

// Returns the request for a scene, or for each scene of a campaign.
std::vector<report::RecordingRequest> recordings(const std::string& file,
                                                 report::RecordingRequest request) {
  request.scene = file;
  if (fs::path(file).extension() != ".toml" || !files::has_key(file, "group")) return {request};
  if (request.overrides.count >= 0 || request.overrides.seed >= 0) {
    throw base::InputError(file +
                           " is a campaign, which has counts and seeds; expected neither "
                           "--count nor --seed with it");
  }
  std::vector<report::RecordingRequest> all;
  for (const campaign::CampaignGroup& group : campaign::read_campaign(file).groups) {
    add_scenes(group, request, all);
  }
  return all;
}

// The page calls a folder by its own name, or by its whole path where two have the same.
std::vector<report::ResultsRequest> results_requests(const ReportOptions& options) {
  std::vector<report::ResultsRequest> requests;
  std::map<std::string, int> folders_of;
  for (const std::string& given : options.results) {
    const fs::path whole = (fs::absolute(given) / "").lexically_normal().parent_path();
    for (const fs::path& folder : report::folders_with_tables(given)) {
      report::ResultsRequest& request = requests.emplace_back();
      request.folder = folder;
      request.name =
          (whole.filename() / folder.lexically_relative(given)).lexically_normal().string();
      if (request.name.ends_with('/')) request.name.pop_back();
      request.most_cases = options.cases;
      request.time_limit = options.time_limit;
      ++folders_of[request.name];
    }
  }
  for (report::ResultsRequest& request : requests) {
    if (folders_of[request.name] > 1) request.name = request.folder.string();
  }
  return requests;
}

// Whether the folder, or one below it, has counts of versions.
bool has_versions(const fs::path& folder) {
  if (!fs::is_directory(folder)) return false;
  return std::ranges::any_of(fs::recursive_directory_iterator(folder), [](const auto& entry) {
    return files::row_file(entry.path().parent_path() / "versions.csv") == entry.path();
  });
}

// Adds the folders of --versions to the results. Throws InputError for one without versions.
void add_versions(ReportOptions& options) {
  for (const std::string& folder : options.versions) {
    if (!has_versions(folder)) {
      throw base::InputError(folder, 0,
                             "no versions.csv in it; expected a folder of `check --peer NAME@all`");
    }
    options.results.push_back(folder);
  }
}

void make_report(ReportOptions options) {
  add_versions(options);
  add_modules(options);
  if (options.results.empty() && options.scenes.empty()) {
    throw base::InputError("nothing to report; expected folders of results, or --scene SCENE");
  }
  const std::string page = built_page(options.page);
  std::vector<files::NamedFile> inputs;
  for (const std::string& scene : options.scenes) inputs.push_back({"--scene", scene});
  files::check_outputs(inputs, std::vector<files::NamedFile>{{"--out", options.out}});
  const report::RecordingRequest recording = recording_request(options, start_peers(options.peers));
  files::OrderedJson results = files::OrderedJson::array(), scenes = files::OrderedJson::array();
  for (const report::ResultsRequest& request : results_requests(options)) {
    fmt::print(stderr, "{}\n", request.folder.string());
    results.push_back(report::results_view(request));
  }
  for (const std::string& scene : options.scenes) {
    for (const report::RecordingRequest& request : recordings(scene, recording)) {
      fmt::print(stderr, "{}\n", request.scene.string());
      scenes.push_back(report::recording_view(request));
    }
  }
  write_report(options.out, page, std::move(results), std::move(scenes));
}

}  // namespace

std::string built_page(const fs::path& given) {
  const fs::path file = given.empty() ? usual_page() : given;
  std::ifstream in(file, std::ios::binary);
  std::string page{std::istreambuf_iterator<char>(in), {}};
  if (page.empty()) {
    throw base::InputError(
        file.string() +
        (base::data_folder().is_installed
             ? ": the page is not installed; expected it from the target `page` of the build, "
               "which needs Node.js"
             : ": the page is not built; `./touchstone report` builds it, for which it needs "
               "Node.js (Debian: nodejs, npm)"));
  }
  return page;
}

void write_report(const fs::path& out, const std::string& page, files::OrderedJson results,
                  files::OrderedJson scenes) {
  const std::size_t bytes = report::write_page(out, page,
                                               {{"format", 1},
                                                {"made", made()},
                                                {"origins", origins()},
                                                {"approximate", approximate()},
                                                {"results", std::move(results)},
                                                {"scenes", std::move(scenes)}});
  fmt::print("{}: {:.1f} MB\n", out.string(), static_cast<double>(bytes) / 1e6);
}

void add_report(Arguments command) {
  const auto options = std::make_shared<ReportOptions>();
  command.texts("RESULTS", options->results, "Folders that run, check or advise wrote").is_read();
  command
      .texts("--versions", options->versions,
             "The same for folders in which `check` compared versions of libraries")
      .is_read()
      .once_each();
  command.text("--out", options->out, "The page, .html").required();
  command
      .texts("--scene", options->scenes,
             "Scenes to play: .toml, rigid-ipc's .json, .aabbs, or a campaign's")
      .is_read()
      .once_each();
  command.text("--narrow", options->narrow, "Narrow phases whose verdicts a scene shows: names")
      .show_default();
  command.text("--broad", options->broad, "Broad phases whose structure a scene shows: names")
      .show_default();
  add_peer(command, options->peers);
  command
      .text(
          "--with", options->with,
          "Also show the narrow and broad phases of these modules, joined by commas: ./libmine.so")
      .needs(command.option("--scene"));
  command.number("--frames", options->frames, "The most frames of a scene")
      .within(1, 100'000)
      .show_default();
  add_scene_overrides(command, options->overrides);
  command.number("--cases", options->cases, "The most pairs of a folder that are drawn")
      .within(0, 100'000)
      .show_default();
  add_time_limit(command, options->time_limit).show_default();
  command.text("--page", options->page, "Another built page than the launcher's");
  command.job([options] {
    make_report(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands
