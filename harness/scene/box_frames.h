// Frames of boxes from files: what the broad phases alone are run on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "algorithms/broad_phase.h"
#include "harness/files/csv.h"

namespace touchstone {

struct BoxFrame {
  std::int64_t number = 0;  // as in the file
  std::size_t count = 0;    // ids of this frame: 0 .. count - 1; those without a body are empty
  // Those boxes, and empty ones for the ids that only earlier frames had: FrameChange's array.
  std::vector<Aabb> boxes;
  // Against the frame before; empty lists in the first.
  std::vector<std::uint32_t> moved, inserted, removed;

  FrameChange change() const { return {boxes, moved, inserted, removed}; }
  // For a build that knows of no earlier frame.
  std::span<const Aabb> own_boxes() const { return std::span(boxes).first(count); }
};

// Reads a CSV file with the columns frame, id, min_x, min_y, min_z, max_x, max_y, max_z (metres),
// or a Broadmark recording, told by the ending .aabbs. In CSV the frames' numbers rise, and each
// frame's ids are 0, 1, 2, ... in order; frames may differ in how many. Six empty fields instead of
// a box: that id has no body. Numbers are rounded outward to float. Throws InputError with file and
// line: no box at all, NaN, infinity, a number beyond the range of float, min > max, an id or a
// frame out of order.
std::vector<BoxFrame> read_box_frames(const std::filesystem::path& file);

// The last six fields of a row of such a file.
void append_box(CsvWriter& csv, const Aabb& box);

// Writes such a CSV file, whole or not at all; frames are numbered from 0.
void write_box_frames(std::span<const std::vector<Aabb>> frames, const std::filesystem::path& file);

}  // namespace touchstone
