// Frames of a deforming mesh, as boxes of its vertices, edges and faces.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/scene/box_frames.h"

namespace touchstone::scene {

// True for a PLY file, and for a folder in which one is.
bool are_mesh_frames(const std::filesystem::path& file);

// Reads the frames of a simulation: a folder of PLY files with a number at the end of their names, such as ball92.ply;
// or one of these files, for the step from it to the next. Each step is a frame: the boxes of what the vertices, edges
// and faces sweep when the vertices move in straight lines. The frame has the number of the file from which it starts.
// Ids: the vertices, then the edges, then the faces. Edges are in the order of their greater vertex, then of their
// lesser one, as in the lists below.
// SCENE/frames/92.ply may have the pairs that are known to meet in SCENE/boxes/92vf.json and 92ee.json, arrays of pairs
// of ids: `known_pairs`. Format of the data of Belgrod et al., "Time of Impact Dataset for Continuous Collision
// Detection and a Scalable Conservative Algorithm", arXiv 2112.06300.
// Throws InputError if a file is malformed, there is no next frame, two frames differ in their faces, or a known pair
// names no box or two boxes that are apart.
std::vector<BoxFrame> read_mesh_frames(const std::filesystem::path& file);

}  // namespace touchstone::scene
