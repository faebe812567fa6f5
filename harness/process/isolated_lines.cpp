// Children append lines to a temporary file and note where each one is. What a child wrote of a line that it did
// not finish is not noted, and so left out.
#include "harness/process/isolated_lines.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>

#include "harness/process/shared_array.h"

namespace touchstone::process {
namespace {

[[noreturn]] void throw_error(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

// A file that is gone when it is closed.
class TemporaryFile {
 public:
  TemporaryFile() {
    if (file_ == nullptr) throw_error("temporary file");
  }

  std::int64_t end() const {
    const std::int64_t at = lseek(descriptor(), 0, SEEK_END);
    if (at < 0) throw_error("temporary file");
    return at;
  }

  void write(std::string_view text, std::int64_t at) const {
    while (!text.empty()) {
      const auto written = pwrite(descriptor(), text.data(), text.size(), at);
      if (written < 0) throw_error("temporary file");
      text.remove_prefix(static_cast<std::size_t>(written));
      at += written;
    }
  }

  std::string read(std::int64_t at, std::size_t size) const {
    std::string text(size, '\0');
    for (std::size_t done = 0; done < size;) {
      errno = EIO;  // a file that is shorter than it was sets none
      const auto some = pread(descriptor(), text.data() + done, size - done,
                              at + static_cast<std::int64_t>(done));
      if (some <= 0) throw_error("temporary file");
      done += static_cast<std::size_t>(some);
    }
    return text;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  int descriptor() const { return fileno(file_.get()); }

  std::unique_ptr<std::FILE, Close> file_{std::tmpfile()};
};

struct Place {
  std::int64_t begin = 0;
  std::size_t size = 0;  // with the line break; 0 if there is no line
};

}  // namespace

LinesReport isolated_lines(std::size_t items, const IsolationLimits& limits,
                           const std::function<MakeLine()>& setup,
                           const std::function<void(const std::string& line)>& take) {
  const TemporaryFile file;
  SharedArray<Place> places(items);
  IsolationReport report = isolate(items, limits, [&]() -> ItemWork {
    return [&, make = setup(), end = file.end()](std::size_t item) mutable {
      const std::optional<std::string> line = make(item);
      if (!line) return;
      file.write(*line + '\n', end);
      places[item] = {end, line->size() + 1};
      end += static_cast<std::int64_t>(places[item].size);
    };
  });
  LinesReport lines{0, std::move(report.failures)};
  for (std::size_t item = 0; item < items; ++item) {
    if (report.states[item] != ItemState::done || places[item].size == 0) continue;
    take(file.read(places[item].begin, places[item].size));
    ++lines.lines;
  }
  return lines;
}

}  // namespace touchstone::process
