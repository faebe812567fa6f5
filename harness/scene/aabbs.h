// Broadmark's recordings of boxes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/core/aabb.h"

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

}  // namespace touchstone::scene
