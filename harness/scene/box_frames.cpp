// Reads frames of boxes from CSV or recordings, and lists what changed between them.
#include "harness/scene/box_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/file_text.h"
#include "harness/files/csv.h"
#include "harness/scene/aabbs.h"
#include "harness/scene/mesh_frames.h"

namespace touchstone::scene {
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
