// Reads the facts of machine, program and source, and files of facts.
#include "harness/record/machine.h"

#include <fmt/chrono.h>
#include <link.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <cpuid.h>
#endif
#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>
#include <vector>

#include "algorithms/core/isa.h"
#include "harness/base/hash.h"
#include "harness/base/names.h"
#include "harness/record/build.h"
#include "harness/record/build_info.h"

namespace touchstone::record {

Facts read_facts(const std::filesystem::path& file) {
  Facts facts;
  files::CsvReader(file, {"name", "value"}).read([&](const files::CsvReader::Row& row) {
    facts.emplace_back(row.text(0), row.text(1));
  });
  return facts;
}

void write_facts(const std::filesystem::path& file, const Facts& facts,
                 files::CsvWriter::Durable durable) {
  files::CsvWriter csv(file, {"name", "value"});
  for (const auto& [name, value] : facts) csv.field(name).field(value).end_row();
  csv.close(durable);
}

std::string value_of(const Facts& facts, std::string_view name) {
  const auto at = std::ranges::find(facts, name, &Facts::value_type::first);
  return at == facts.end() ? "" : at->second;
}

namespace {

constexpr std::string_view unknown = "unknown";

std::string first_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  return std::getline(stream, line) && !line.empty() ? line : std::string(unknown);
}

// Returns the value behind "key : value" in a file such as /proc/cpuinfo.
std::string value_behind(const std::string& file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? std::string(unknown) : line.substr(begin);
  }
  return std::string(unknown);
}

// Returns numbers in the kernel's notation: "0-3,6".
std::string ranges(const std::set<int>& places) {
  std::string text;
  for (auto at = places.begin(); at != places.end();) {
    const int first = *at;
    int last = first;
    while (++at != places.end() && *at == last + 1) last = *at;
    if (!text.empty()) text += ',';
    text += first == last ? std::to_string(first) : fmt::format("{}-{}", first, last);
  }
  return text;
}

// Returns the processors that this process may run on.
std::string affinity() {
  cpu_set_t mask;
  if (sched_getaffinity(0, sizeof mask, &mask) != 0) return {};
  std::set<int> allowed;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(cpu, &mask)) allowed.insert(cpu);
  }
  return ranges(allowed);
}

// Returns the number of cores, as pairs of package and number: processors that share one count
// once.
std::string physical_cores(const std::string& folder) {
  std::set<std::string> cores;
  for (int cpu = 0;; ++cpu) {
    const std::string place = fmt::format("{}cpu{}/", folder, cpu);
    if (!std::filesystem::exists(place)) break;
    const std::string core = first_line(place + "topology/core_id");
    if (core != unknown) cores.insert(first_line(place + "topology/physical_package_id") + core);
  }
  return cores.empty() ? std::string() : std::to_string(cores.size());
}

std::string boost(const std::string& folder) {
  const std::string off = first_line(folder + "intel_pstate/no_turbo");
  if (off != unknown) return off == "0" ? "1" : "0";
  return first_line(folder + "cpufreq/boost");
}

// Reads the bit and the leaf that processors reserve for it, because some hypervisors are not in
// /sys.
std::string hypervisor() {
  const std::string named = first_line("/sys/hypervisor/type");
  if (named != unknown) return named;
#if defined(__x86_64__)
  unsigned a = 0, b = 0, c = 0, d = 0;
  constexpr unsigned present = 1u << 31;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0) return {};
  if ((c & present) == 0) return "none";
  __cpuid(0x40000000, a, b, c, d);
  char vendor[13] = {};
  std::memcpy(vendor, &b, 4);
  std::memcpy(vendor + 4, &c, 4);
  std::memcpy(vendor + 8, &d, 4);
  // Vendors repeat their name to fill twelve letters: "KVMKVMKVM", "bhyve bhyve ".
  const std::string name = vendor;
  for (const char* known : {"KVM", "bhyve", "Xen", "VMware"}) {
    if (name.starts_with(known)) return known;
  }
  return name;
#else
  return {};
#endif
}

// Returns the limits that hold for this process: those of its group and of the groups above it.
// `first` is the file's name in version 1, which separates the controllers; `second` is that in
// version 2.
std::string group_limits(const std::string& controller, const std::string& first,
                         const std::string& second) {
  const std::filesystem::path root = "/sys/fs/cgroup";
  std::string limits;
  bool any = false;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t colon = line.find(':');
    const std::size_t end = line.find(':', colon + 1);
    if (colon == std::string::npos || end == std::string::npos) continue;
    const std::string names = "," + line.substr(colon + 1, end - colon - 1) + ",";
    const bool unified = names == ",,";
    if (!unified && names.find("," + controller + ",") == std::string::npos) continue;
    const std::filesystem::path folder = unified ? root : root / controller;
    std::filesystem::path group = line.substr(end + 2);
    for (bool at_root = false; !at_root; group = group.parent_path()) {
      at_root = group.empty();
      const std::string value = first_line(folder / group / (unified ? second : first));
      if (value == unknown) continue;
      any = true;
      const bool none = value.starts_with("max") || value == "-1" || value.size() >= 19;
      if (!none) limits += (limits.empty() ? "" : "; ") + value;
    }
  }
  return !any ? "" : limits.empty() ? "none" : limits;
}

std::string command_line() {
  std::ifstream stream("/proc/self/cmdline", std::ios::binary);
  return shell_line({std::istreambuf_iterator<char>(stream), {}});
}

std::string preloaded() {
  const char* const value = std::getenv("LD_PRELOAD");
  return value == nullptr || *value == '\0' ? "none" : value;
}

constexpr Build not_said;
const Build* build_in_use = &not_said;

void mix_in(std::string_view bytes, std::uint64_t& hash) {
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    bytes.substr(i, 8).copy(reinterpret_cast<char*>(&word), 8);
    hash = base::mix(hash ^ word);
  }
}

// Mixes in the instructions of the first object that is loaded, which is the program, and stops.
int mix_in_instructions(dl_phdr_info* object, std::size_t, void* hash) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& part = object->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    const auto* const begin = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    mix_in({begin, part.p_filesz}, *static_cast<std::uint64_t*>(hash));
  }
  return 1;
}

}  // namespace

void set_build(const Build& build) { build_in_use = &build; }

const Build& build() { return *build_in_use; }

std::string shell_line(const std::string& words) {
  std::string line;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find('\0', at), words.size());
    std::string word = words.substr(at, end - at);
    if (at > 0 && word.starts_with(of_build_option)) {
      at = end + 1;
      continue;
    }
    // The program appears by its name alone, because its folder has no influence on the results.
    if (at == 0) word.erase(0, word.rfind('/') + 1);
    for (char& c : word) {
      if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    line += (at == 0 ? "" : " ") + base::shell_word(word);
    at = end + 1;
  }
  return line;
}

std::vector<std::pair<std::string, std::string>> machine_facts() {
  std::vector<std::pair<std::string, std::string>> facts;
  const auto add = [&](std::string_view name, std::string_view value) {
    facts.emplace_back(name, value.empty() ? unknown : value);
  };
  const std::string cpu = "/sys/devices/system/cpu/";
  add("processor", value_behind("/proc/cpuinfo", "model name"));
  add("microcode", value_behind("/proc/cpuinfo", "microcode"));
  add("cores_online", std::to_string(std::thread::hardware_concurrency()));
  add("cores_physical", physical_cores(cpu));
  add("affinity", affinity());
  add("numa_nodes", first_line("/sys/devices/system/node/online"));
  add("simultaneous_multithreading", first_line(cpu + "smt/active"));
  for (int level = 0; level < 4; ++level) {
    const std::string cache = fmt::format("{}cpu0/cache/index{}/", cpu, level);
    add(fmt::format("cache_{}", level),
        fmt::format("L{} {} {}", first_line(cache + "level"), first_line(cache + "type"),
                    first_line(cache + "size")));
  }
  add("governor", first_line(cpu + "cpu0/cpufreq/scaling_governor"));
  add("frequency_driver", first_line(cpu + "cpu0/cpufreq/scaling_driver"));
  add("greatest_frequency_khz", first_line(cpu + "cpu0/cpufreq/cpuinfo_max_freq"));
  add("boost", boost(cpu));
  add("clock_source",
      first_line("/sys/devices/system/clocksource/clocksource0/current_clocksource"));
  add("memory", value_behind("/proc/meminfo", "MemTotal"));
  utsname name{};
  uname(&name);
  add("kernel", fmt::format("{} {} {}", name.sysname, name.release, name.machine));
  add("hypervisor", hypervisor());
  add("processor_limit", group_limits("cpu", "cpu.cfs_quota_us", "cpu.max"));
  add("memory_limit", group_limits("memory", "memory.limit_in_bytes", "memory.max"));
  add("transparent_huge_pages", first_line("/sys/kernel/mm/transparent_hugepage/enabled"));
  add("perf_event_paranoid", first_line("/proc/sys/kernel/perf_event_paranoid"));
  add("address_randomisation", first_line("/proc/sys/kernel/randomize_va_space"));
  for (const auto& [key, value] : build_facts) add(key, value);
#if defined(__GLIBC__)
  add("c_library", std::string("glibc ") + gnu_get_libc_version());
#else
  add("c_library", "");
#endif
  add("preloaded", preloaded());
  add("instructions_of_machine", to_string(isa_of_machine()));
  add("instructions_in_use", to_string(isa()));
  add("commit", build().commit);
  add("tree", build().tree);
  add("sources", build().sources);
  add(command_line_fact, command_line());
  return facts;
}

std::string facts_as_list(std::initializer_list<std::string_view> names) {
  std::string text;
  for (const auto& [name, value] : machine_facts()) {
    if (std::ranges::find(names, name) != names.end())
      text += fmt::format("- {}: {}\n", name, value);
  }
  return text;
}

std::string date_now() {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)));
}

std::string hash_of_program() {
  std::uint64_t hash = 0;
  dl_iterate_phdr(mix_in_instructions, &hash);
  mix_in(build().id, hash);
  return base::to_hex(hash);
}

}  // namespace touchstone::record
