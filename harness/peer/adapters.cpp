// Reads what adapters there are, and finds the one that is named.
#include "harness/peer/adapters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>

#include "harness/base/error.h"
#include "harness/files/toml_table.h"
#include "harness/record/build_info.h"

namespace touchstone::peer {
namespace {

namespace fs = std::filesystem;

std::string with_version(std::string text, const std::string& version) {
  constexpr std::string_view place = "{version}";
  for (std::size_t at = 0; (at = text.find(place, at)) != std::string::npos;) {
    text.replace(at, place.size(), version);
    at += version.size();
  }
  return text;
}

}  // namespace

Adapter read_adapter(const fs::path& folder) {
  const fs::path file = folder / "peer.toml";
  const toml::table parsed = files::parse_toml(file);
  files::TomlTable table(parsed, file.string(), "");
  Adapter adapter = {.name = folder.filename().string(),
                     .folder = fs::absolute(folder),
                     .about = table.text("about"),
                     .licence = table.text("licence"),
                     .lacks = table.text("lacks"),
                     .kinds = table.texts("kinds", {}),
                     .versions = {}};
  table.text("settings");
  const std::string command = table.text("command"), install = table.text("install"),
                    installed = table.text("installed");
  for (const std::string& version : table.texts("versions", {})) {
    adapter.versions.push_back(
        {.version = version,
         .install = with_version(install, version),
         .is_installed = fs::exists(adapter.folder / with_version(installed, version)),
         .command = with_version(command, version)});
  }
  table.finish();
  return adapter;
}

std::vector<Adapter> adapters() {
  std::vector<Adapter> all;
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(fs::path(record::source_folder) / "datasets/adapters", ignored)) {
    if (fs::exists(entry.path() / "peer.toml")) all.push_back(read_adapter(entry.path()));
  }
  std::ranges::sort(all, {}, &Adapter::name);
  return all;
}

Program program_of(const std::string& named) {
  const std::size_t at = named.find('@');
  const std::string name = named.substr(0, at);
  const std::string version = at == std::string::npos ? "" : named.substr(at + 1);
  std::vector<Adapter> known;
  if (fs::exists(fs::path(name) / "peer.toml")) {
    known.push_back(read_adapter((fs::path(name) / "").lexically_normal().parent_path()));
  } else {
    known = adapters();
    std::erase_if(known, [&](const Adapter& adapter) { return adapter.name != name; });
  }
  if (known.empty()) return {.command = named, .folder = {}};
  const Adapter& adapter = known.front();
  std::vector<AdapterVersion> chosen = adapter.versions;
  if (!version.empty()) {
    std::erase_if(chosen, [&](const AdapterVersion& one) { return one.version != version; });
  }
  if (chosen.empty()) {
    std::vector<std::string> names;
    for (const AdapterVersion& one : adapter.versions) names.push_back(one.version);
    throw base::InputError(fmt::format("--peer {}: found the version '{}'; expected one of {}",
                                       named, version, fmt::join(names, ", ")));
  }
  const auto latest = std::find_if(chosen.rbegin(), chosen.rend(),
                                   [](const AdapterVersion& one) { return one.is_installed; });
  if (latest == chosen.rend()) {
    throw base::InputError(fmt::format("--peer {}: is not installed; expected it after `{}`", named,
                                       chosen.back().install));
  }
  return {.command = latest->command, .folder = adapter.folder};
}

}  // namespace touchstone::peer
