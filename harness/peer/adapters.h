// Adapters: the folders of datasets/adapters, each of which makes a library a peer, in some of its versions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/peer/peer_process.h"

namespace touchstone::peer {

// A version of a library that is known to work.
struct AdapterVersion {
  std::string version;
  std::string install;  // a line for the shell, in the project's folder
  bool is_installed = false;
  std::string command;
};

struct Adapter {
  std::string name;
  std::filesystem::path folder;
  std::string about, licence, lacks;
  std::vector<std::string> kinds;
  std::vector<AdapterVersion> versions;  // in order of release
};

// Reads the peer.toml of a folder. Throws base::InputError with file and line.
Adapter read_adapter(const std::filesystem::path& folder);
// Those of datasets/adapters, in the order of their names.
std::vector<Adapter> adapters();

// NAME@VERSION for each version that is installed where NAME@all is named, and else the name alone. Throws
// base::InputError if none is installed.
std::vector<std::string> named_versions(const std::string& named);

// What --peer names: an adapter, in the latest version that is installed or the one behind '@', or else a command.
// Throws base::InputError for an adapter that is not installed, with the line that installs it.
Program program_of(const std::string& named);

}  // namespace touchstone::peer
