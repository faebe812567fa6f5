// Reads what adapters there are, and finds the one that is named.
#include "harness/peer/adapters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "harness/base/data_folder.h"
#include "harness/base/error.h"
#include "harness/files/toml_table.h"

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

// The adapter that is named, and what stands behind '@'; no adapter if it is a command.
std::pair<std::optional<Adapter>, std::string> adapter_of(const std::string& named) {
  // A folder may have '@' in its path.
  std::size_t at = named.rfind('@');
  if (at != std::string::npos && named.find('/', at) != std::string::npos) at = std::string::npos;
  const std::string name = named.substr(0, at);
  const std::string version = at == std::string::npos ? "" : named.substr(at + 1);
  if (fs::exists(fs::path(name) / "peer.toml")) {
    return {read_adapter((fs::path(name) / "").lexically_normal().parent_path()), version};
  }
  for (Adapter& adapter : adapters()) {
    if (adapter.name == name) return {std::move(adapter), version};
  }
  return {std::nullopt, version};
}

[[noreturn]] void throw_not_installed(const std::string& named, const AdapterVersion& version) {
  throw base::InputError(
      fmt::format("--peer {}: is not installed; expected it after `{}`", named, version.install));
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
  if (adapter.versions.empty()) {
    table.fail("versions", "found none; expected at least one version");
  }
  table.finish();
  return adapter;
}

std::vector<Adapter> adapters() {
  std::vector<Adapter> all;
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(base::data_folder().path / "datasets/adapters", ignored)) {
    if (fs::exists(entry.path() / "peer.toml")) all.push_back(read_adapter(entry.path()));
  }
  std::ranges::sort(all, {}, &Adapter::name);
  return all;
}

std::vector<std::string> named_versions(const std::string& named) {
  const auto [adapter, version] = adapter_of(named);
  if (!adapter || version != "all") return {named};
  std::vector<std::string> names;
  for (const AdapterVersion& one : adapter->versions) {
    if (one.is_installed) names.push_back(named.substr(0, named.rfind('@') + 1) + one.version);
  }
  if (names.empty()) throw_not_installed(named, adapter->versions.back());
  return names;
}

Program program_of(const std::string& named) {
  const auto [found, version] = adapter_of(named);
  if (!found) return {.command = named, .folder = {}};
  const Adapter& adapter = *found;
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
  if (latest == chosen.rend()) throw_not_installed(named, chosen.back());
  return {.command = latest->command, .folder = adapter.folder};
}

}  // namespace touchstone::peer
