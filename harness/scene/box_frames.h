// Frames of boxes from files, for broad phases without a scene, and Broadmark's recordings of
// boxes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "algorithms/broad_phase.h"
#include "algorithms/core/aabb.h"
#include "harness/files/csv.h"

namespace touchstone::scene {

// A recording: equally many boxes in each frame, at least one frame.
struct BoxRecording {
  std::string scene, type;  // at most 127 bytes each; free text
  Aabb world;
  std::vector<std::vector<Aabb>> frames;
};

// Reads the binary format of Broadmark's .aabbs files (Serpa and Rodrigues, "Broadmark: A Testing
// Framework for Broad-Phase Collision Detection Algorithms", Computer Graphics Forum 2020),
// little-endian. Throws InputError with the file's name and the place for a short file, a wrong
// count, NaN, or min > max.
BoxRecording read_aabbs(const std::filesystem::path& file);
// Writes the file whole or not at all (a temporary file, renamed).
void write_aabbs(const BoxRecording& recording, const std::filesystem::path& file);

struct BoxFrame {
  std::int64_t number = 0;  // the file's number
  // Ids of this frame are 0 .. count - 1; ids without a body have empty boxes.
  std::size_t count = 0;
  // The boxes of these ids, and empty ones for ids that only earlier frames had: the array of
  // FrameChange.
  std::vector<Aabb> boxes;
  std::size_t rounded = 0;  // coordinates in the file that no float holds
  // Changes since the previous frame; empty in the first.
  std::vector<std::uint32_t> moved, inserted, removed;
  std::vector<IndexPair>
      known_pairs;  // pairs that the file's authors know to meet, ascending; often none

  FrameChange change() const { return {boxes, moved, inserted, removed}; }
  // The boxes for a build without an earlier frame.
  std::span<const Aabb> own_boxes() const { return std::span(boxes).first(count); }
};

// Reads a CSV file with the columns frame, id, min_x, min_y, min_z, max_x, max_y, max_z (metres),
// or a Broadmark recording if the extension is .aabbs, or frames of a mesh (mesh_frames.h). In CSV the frames' numbers rise, and each
// frame's ids are 0, 1, 2, ... in order; frames may differ in their number. Six empty fields mean
// that the id has no body. Numbers are rounded outward to float. Throws InputError with file and
// line if there is no box, and for NaN, infinity, a number beyond the range of float, min > max,
// and an id or a frame out of order.
std::vector<BoxFrame> read_box_frames(const std::filesystem::path& file);

// Appends the last six fields of a row of such a file.
void append_box(files::CsvWriter& csv, const Aabb& box);

// Writes such a CSV file, whole or not at all. Frames are numbered from 0.
void write_box_frames(std::span<const std::vector<Aabb>> frames, const std::filesystem::path& file);

}  // namespace touchstone::scene
