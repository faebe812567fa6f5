// The fuzzer: libFuzzer's entry points for one reader, which the environment names (TOUCHSTONE_READER).
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/fuzz/readers.h"

namespace {

std::filesystem::path folder_of_this_process() {
  std::string name = (std::filesystem::temp_directory_path() / "touchstone-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  return name;
}

std::optional<touchstone::fuzz::Trial> trial;
std::filesystem::path folder;

}  // namespace

// A short input takes about two thirds of the time so: what is freed is given out again after 2 MB, the stack is not moved
// to the heap, and a report has one frame of where a block was allocated. Give ASAN_OPTIONS to see more of what was found.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "quarantine_size_mb=2:thread_local_quarantine_size_kb=256:detect_stack_use_after_return=0:"
         "malloc_context_size=1";
}

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("TOUCHSTONE_READER");
  try {
    const auto& reader = touchstone::fuzz::reader_named(name == nullptr ? "" : name);
    folder = folder_of_this_process();
    std::atexit([] {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    });
    trial.emplace(reader, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(2);
  }
  return 0;
}

// What is thrown ends the fuzzer, and the input is kept.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  trial->fault({reinterpret_cast<const char*>(data), size});
  return 0;
}
