// Reads frames of boxes from CSV or Broadmark's .aabbs files, writes these, and lists what changed
// between frames.
#include "harness/scene/box_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/scene/mesh_frames.h"

namespace touchstone::scene {
namespace {

// The file has two texts of 128 bytes, each ended by a zero; the number of boxes N and of steps K;
// two unused words; the world's box; K + 1 arrays of N boxes, the first with the initial state. A
// box is min x, y, z and an unused float, then max in the same way.
constexpr std::size_t text_size = 128;
constexpr std::size_t count_at = 2 * text_size;
constexpr std::size_t steps_at = count_at + 4;
constexpr std::size_t world_at = count_at + 16;
constexpr std::size_t box_size = 32;
constexpr std::size_t header_size = world_at + box_size;

std::uint32_t load(const char* from) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) word = (word << 8) | static_cast<unsigned char>(from[i]);
  return word;
}

void store(std::uint32_t word, char* to) {
  for (int i = 0; i < 4; ++i) to[i] = static_cast<char>((word >> (8 * i)) & 0xff);
}

Aabb load_box(const char* from) {
  Aabb box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.min[i] = std::bit_cast<float>(load(from + 4 * i));
    box.max[i] = std::bit_cast<float>(load(from + 16 + 4 * i));
  }
  return box;
}

void store_box(const Aabb& box, char* to) {
  std::memset(to, 0, box_size);
  for (std::size_t i = 0; i < 3; ++i) {
    store(std::bit_cast<std::uint32_t>(box.min[i]), to + 4 * i);
    store(std::bit_cast<std::uint32_t>(box.max[i]), to + 16 + 4 * i);
  }
}

// Describes the fault of a box; empty if it has none.
std::string fault(const Aabb& box) {
  for (std::size_t i = 0; i < 3; ++i) {
    const char axis = "xyz"[i];
    if (!std::isfinite(box.min[i]) || !std::isfinite(box.max[i])) {
      return fmt::format("{} from {} to {}; expected finite numbers", axis, box.min[i], box.max[i]);
    }
    if (box.min[i] > box.max[i]) {
      return fmt::format("{} from {} to {}; expected min <= max", axis, box.min[i], box.max[i]);
    }
  }
  return {};
}

std::string load_text(const char* from, const std::string& file, std::string_view what) {
  const void* end = std::memchr(from, 0, text_size);
  if (end == nullptr) {
    throw base::InputError(
        file, 0,
        fmt::format("the {} does not end; expected a text of at most 127 bytes and a "
                    "zero: is this a recording of Broadmark?",
                    what));
  }
  return std::string(from, static_cast<const char*>(end));
}

}  // namespace

BoxRecording read_aabbs(const std::filesystem::path& path) {
  const std::string file = path.string();
  base::check_kind(path, "a recording of boxes");
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw base::InputError(file, 0, "cannot be read: " + error.message());
  if (size < header_size) {
    throw base::InputError(file, 0,
                           fmt::format("{} bytes; expected a header of {}", size, header_size));
  }
  if (size > base::largest_file) {
    throw base::InputError(file, 0,
                           fmt::format("{} bytes; expected at most {}", size, base::largest_file));
  }
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> bytes(header_size);
  if (!stream.read(bytes.data(), header_size)) throw base::InputError(file, 0, "cannot be read");

  BoxRecording recording;
  recording.scene = load_text(bytes.data(), file, "scene's name");
  recording.type = load_text(bytes.data() + text_size, file, "objects' type");
  recording.world = load_box(bytes.data() + world_at);
  const auto count = static_cast<std::int32_t>(load(bytes.data() + count_at));
  const auto steps = static_cast<std::int32_t>(load(bytes.data() + steps_at));
  if (count < 1)
    throw base::InputError(file, 0, fmt::format("{} boxes; expected at least one", count));
  if (steps < 0)
    throw base::InputError(file, 0, fmt::format("{} steps; expected 0 or more", steps));
  // The check comes before anything of that size is allocated.
  const std::uintmax_t frames = std::uintmax_t{1} + static_cast<std::uintmax_t>(steps);
  const std::uintmax_t boxes = frames * static_cast<std::uintmax_t>(count);  // below 2^62
  if ((size - header_size) % box_size != 0 || (size - header_size) / box_size != boxes) {
    throw base::InputError(
        file, 0,
        fmt::format("{} bytes behind the header; expected {} frames of {} boxes of {} "
                    "bytes",
                    size - header_size, frames, count, box_size));
  }
  if (const std::string what = fault(recording.world); !what.empty()) {
    throw base::InputError(file, 0, "the world's box: " + what);
  }

  const auto n = static_cast<std::size_t>(count);
  bytes.resize(n * box_size);
  recording.frames.reserve(frames);
  for (std::uintmax_t frame = 0; frame < frames; ++frame) {
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
      throw base::InputError(file, 0, fmt::format("frame {} cannot be read", frame));
    }
    std::vector<Aabb>& list = recording.frames.emplace_back(n);
    for (std::size_t i = 0; i < n; ++i) {
      list[i] = load_box(bytes.data() + i * box_size);
      if (const std::string what = fault(list[i]); !what.empty()) {
        throw base::InputError(file, 0, fmt::format("frame {}, box {}: {}", frame, i, what));
      }
    }
  }
  return recording;
}

void write_aabbs(const BoxRecording& recording, const std::filesystem::path& path) {
  const std::size_t n = recording.frames.empty() ? 0 : recording.frames.front().size();
  const bool even = std::all_of(recording.frames.begin(), recording.frames.end(),
                                [n](const auto& frame) { return frame.size() == n; });
  if (n == 0 || !even || n > INT32_MAX || recording.frames.size() > INT32_MAX) {
    throw base::InputError(
        path.string(), 0,
        "cannot hold this recording; expected frames of equally many boxes, from 1 to "
        "2147483647 of each");
  }
  files::OutputFile output(path);
  std::vector<char> bytes(header_size);
  recording.scene.copy(bytes.data(), text_size - 1);
  recording.type.copy(bytes.data() + text_size, text_size - 1);
  store(static_cast<std::uint32_t>(n), bytes.data() + count_at);
  store(static_cast<std::uint32_t>(recording.frames.size() - 1), bytes.data() + steps_at);
  store_box(recording.world, bytes.data() + world_at);
  output.write({bytes.data(), header_size});
  bytes.resize(n * box_size);
  for (const auto& frame : recording.frames) {
    for (std::size_t i = 0; i < n; ++i) store_box(frame[i], bytes.data() + i * box_size);
    output.write({bytes.data(), bytes.size()});
  }
  output.close();
}

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();  // an empty field
constexpr std::size_t frame_column = 0, id_column = 1, min_column = 2, max_column = 5;

double coordinate(const files::CsvReader::Row& row, std::size_t column) {
  const double value = row.number(column);
  if (!(std::abs(value) <= double{std::numeric_limits<float>::max()})) {
    row.fail(fmt::format("found {}; expected a finite number in the range of float",
                         base::shortened(row.text(column))));
  }
  return value;
}

bool is_absent(const files::CsvReader::Row& row) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!row.text(min_column + i).empty() || !row.text(max_column + i).empty()) return false;
  }
  return true;
}

// Counts the coordinates that no float holds.
Aabb read_box(const files::CsvReader::Row& row, std::size_t& rounded) {
  if (is_absent(row)) return Aabb::empty();
  Aabb box;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = coordinate(row, min_column + i);
    const double high = coordinate(row, max_column + i);
    if (low > high) {
      row.fail(fmt::format("{} from {} to {}; expected min <= max", "xyz"[i],
                           base::shortened(row.text(min_column + i)),
                           base::shortened(row.text(max_column + i))));
    }
    box.min[i] = round_down(low);
    box.max[i] = round_up(high);
    rounded += (box.min[i] != low ? 1U : 0U) + (box.max[i] != high ? 1U : 0U);
  }
  return box;
}

std::vector<BoxFrame> read_csv(const std::filesystem::path& file) {
  std::vector<BoxFrame> frames;
  const files::CsvReader reader(
      file, {"frame", "id", "min_x", "min_y", "min_z", "max_x", "max_y", "max_z"});
  reader.read([&](const files::CsvReader::Row& row) {
    const std::int64_t number = row.integer(frame_column);
    if (frames.empty() || number != frames.back().number) {
      if (number < (frames.empty() ? 0 : frames.back().number)) {
        row.fail(frames.empty()
                     ? fmt::format("frame {}; expected frames from 0 on", number)
                     : fmt::format("frame {} after frame {}; expected frames in rising order",
                                   number, frames.back().number));
      }
      frames.emplace_back().number = number;
    }
    std::vector<Aabb>& boxes = frames.back().boxes;
    if (const std::int64_t id = row.integer(id_column); std::cmp_not_equal(id, boxes.size())) {
      row.fail(fmt::format("id {}; expected {}: the ids of each frame are 0, 1, 2, ... in order",
                           id, boxes.size()));
    }
    if (boxes.size() == std::numeric_limits<std::uint32_t>::max()) {
      row.fail("too many boxes in a frame");
    }
    boxes.push_back(read_box(row, frames.back().rounded));
  });
  if (frames.empty()) {
    throw base::InputError(file.string(), 1, "no box behind the header; expected at least one");
  }
  return frames;
}

std::vector<BoxFrame> read_recording(const std::filesystem::path& file) {
  BoxRecording recording = read_aabbs(file);
  std::vector<BoxFrame> frames;
  for (std::vector<Aabb>& boxes : recording.frames) {
    const auto number = static_cast<std::int64_t>(frames.size());
    BoxFrame& frame = frames.emplace_back();
    frame.number = number;
    frame.boxes = std::move(boxes);
  }
  return frames;
}

// Compares bits, since the contract of updates distinguishes 0 from -0.
bool same_bits(const Aabb& a, const Aabb& b) {
  using Bits = std::array<std::uint32_t, 6>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

// Pads the frame's array and lists the changes since the previous frame.
void compare(const BoxFrame& before, BoxFrame& now) {
  now.boxes.resize(std::max(now.count, before.boxes.size()), Aabb::empty());
  for (std::uint32_t id = 0; id < now.boxes.size(); ++id) {
    const bool was = id < before.count && !before.boxes[id].is_empty();
    const bool is = id < now.count && !now.boxes[id].is_empty();
    if (was && !is) now.removed.push_back(id);
    if (!was && is) now.inserted.push_back(id);
    if (was && is && !same_bits(before.boxes[id], now.boxes[id])) now.moved.push_back(id);
  }
}

}  // namespace

std::vector<BoxFrame> read_box_frames(const std::filesystem::path& file) {
  std::vector<BoxFrame> frames = are_mesh_frames(file)          ? read_mesh_frames(file)
                                 : file.extension() == ".aabbs" ? read_recording(file)
                                                                : read_csv(file);
  for (BoxFrame& frame : frames) frame.count = frame.boxes.size();
  for (std::size_t i = 1; i < frames.size(); ++i) compare(frames[i - 1], frames[i]);
  return frames;
}

void append_box(files::CsvWriter& csv, const Aabb& box) {
  for (const auto& end : {box.min, box.max}) {
    for (const float value : end) csv.field(box.is_empty() ? nan : double{value});
  }
}

void write_box_frames(std::span<const std::vector<Aabb>> frames,
                      const std::filesystem::path& file) {
  files::CsvWriter csv(file, {"frame", "id", "min_x", "min_y", "min_z", "max_x", "max_y", "max_z"});
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    for (std::size_t id = 0; id < frames[frame].size(); ++id) {
      const Aabb& box = frames[frame][id];
      csv.field(frame).field(id);
      append_box(csv, box);
      csv.end_row();
    }
  }
  csv.close();
}

}  // namespace touchstone::scene
