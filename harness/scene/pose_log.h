// Logs of a simulator: where bodies are in each frame, as CSV.
#pragma once

#include <filesystem>

#include "harness/scene/scene.h"

namespace touchstone::scene {

// Reads a CSV file with the columns frame, body (a number, or a name that one body has), and x, y, z (metres), qw, qx, qy,
// qz (of any length but 0), or m00, m01 ... m23, the rows of a 3 x 4 matrix. Frames rise from 0 by one. The bodies that
// the file has get tracks, and count as moving; the scene has as many frames as the file. Throws InputError with
// file and line.
void read_pose_log(const std::filesystem::path& file, Scene& scene);

// Writes such a file, as matrices, of all frames of the scene and the bodies that may move. Returns the number of frames.
int write_pose_log(const Scene& scene, const std::filesystem::path& file);

}  // namespace touchstone::scene
