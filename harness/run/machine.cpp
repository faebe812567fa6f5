#include "harness/run/machine.h"

#include <fmt/core.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/io/csv.h"
#include "harness/run/build_info.h"
#include "harness/run/pair_hash.h"

namespace touchstone {
namespace {

constexpr std::string_view unknown = "unknown";

std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  return std::getline(stream, line) && !line.empty() ? line : std::string(unknown);
}

// The value behind "key : value" in a file such as /proc/cpuinfo.
std::string value_of(const std::string& file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? std::string(unknown) : line.substr(begin);
  }
  return std::string(unknown);
}

// What git says, or "unknown" where there is no git or no repository.
std::string git(const std::string& arguments) {
  const std::string command = fmt::format("git -C '{}' {} 2>/dev/null", source_folder, arguments);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  char buffer[256];
  while (pipe && std::fgets(buffer, sizeof buffer, pipe.get()) != nullptr) text += buffer;
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_facts() {
  std::vector<std::pair<std::string, std::string>> facts;
  const auto add = [&](std::string_view name, std::string_view value) {
    facts.emplace_back(name, value.empty() ? unknown : value);
  };
  const std::string cpu = "/sys/devices/system/cpu/";
  add("processor", value_of("/proc/cpuinfo", "model name"));
  add("microcode", value_of("/proc/cpuinfo", "microcode"));
  add("cores_online", std::to_string(std::thread::hardware_concurrency()));
  add("simultaneous_multithreading", first_line(cpu + "smt/active"));
  for (int level = 0; level < 4; ++level) {
    const std::string cache = fmt::format("{}cpu0/cache/index{}/", cpu, level);
    add(fmt::format("cache_{}", level),
        fmt::format("L{} {} {}", first_line(cache + "level"), first_line(cache + "type"),
                    first_line(cache + "size")));
  }
  add("governor", first_line(cpu + "cpu0/cpufreq/scaling_governor"));
  add("boost", first_line(cpu + "cpufreq/boost"));
  add("memory", value_of("/proc/meminfo", "MemTotal"));
  utsname name{};
  uname(&name);
  add("kernel", fmt::format("{} {} {}", name.sysname, name.release, name.machine));
  add("hypervisor", first_line("/sys/hypervisor/type"));
  add("address_randomisation", first_line("/proc/sys/kernel/randomize_va_space"));
  for (const auto& [key, value] : build_facts) add(key, value);
  add("instructions_of_machine", to_string(isa_of_machine()));
  add("instructions_in_use", to_string(isa()));
  std::string commit = git("rev-parse HEAD");
  if (!commit.empty()) commit.pop_back();
  add("commit", commit);
  add("tree", commit.empty() ? "" : git("status --porcelain").empty() ? "clean" : "changed");
  return facts;
}

std::string hash_of_program() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  std::uint64_t hash = 0;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (file) {
    std::ranges::fill(buffer, '\0');
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(file.gcount()); i += 8) {
      std::uint64_t word = 0;
      std::copy_n(buffer.data() + i, 8, reinterpret_cast<char*>(&word));
      hash = mix(hash ^ word);
    }
  }
  return to_hex(hash);
}

void write_facts(std::vector<std::pair<std::string, std::string>> first,
                 const std::filesystem::path& file) {
  CsvWriter csv(file, {"name", "value"});
  for (auto& fact : machine_facts()) first.push_back(std::move(fact));
  for (const auto& [name, value] : first) csv.field(name).field(value).end_row();
  csv.close();
}

std::vector<std::pair<std::string, std::string>> campaign_facts(
    const Campaign& campaign, const std::map<std::string, std::string>& scene_hashes) {
  std::uint64_t hash = 0;
  for (const char c : description(campaign)) hash = mix(hash ^ static_cast<unsigned char>(c));
  std::vector<std::pair<std::string, std::string>> facts = {{"campaign", campaign.name},
                                                            {"seed", std::to_string(campaign.seed)},
                                                            {"campaign_hash", to_hex(hash)}};
  facts.emplace_back("program", hash_of_program());
  for (const auto& [name, value] : scene_hashes) facts.emplace_back("scene " + name, value);
  for (auto& fact : machine_facts()) facts.push_back(std::move(fact));
  return facts;
}

}  // namespace touchstone
