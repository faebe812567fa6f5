// Queries of continuous collision, in the form of the public benchmark data.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "algorithms/ccd.h"

namespace touchstone::files {

struct CcdQueries {
  std::vector<CcdQuery> queries;
  std::vector<char> contacts;  // the truths, one for each query; empty if the file has none
  std::size_t rounded = 0;     // coordinates that no double holds
};

// Reads a file of eight rows a query: the four vertices at time 0 in the order of CcdQuery, then at
// time 1. A row has three coordinates, each a number or a numerator and a denominator (two integers),
// and may end with the truth: 1 for contact, 0 for none. All rows have the same number of columns:
// 3, 4, 6 or 7. A fraction becomes the double that is nearest to it. The format and data: Wang et al.,
// "A Large-Scale Benchmark and an Inclusion-Based Algorithm for Continuous Collision Detection", ACM
// TOG 40(5), 2021. Where the rows have no truth, and a file ../mma_bool/STEM_mma_bool.json is there, as in the larger
// set, it has them: an array of true or false, one for each query. Throws InputError with file and line.
CcdQueries read_ccd_queries(const std::filesystem::path& file);

// A file of queries in a folder of the public data: SCENE/vertex-face/NAME.csv or SCENE/edge-edge/NAME.csv, and of the
// larger set SCENE/queries/NAMEvf.csv or SCENE/queries/NAMEee.csv.
struct CcdFile {
  std::filesystem::path file;
  std::string scene;
  FeaturePair pair = FeaturePair::vertex_face;
};

// Returns the files of a folder by scene, kind and name. The folder holds scenes, or is one. Other
// files are left alone. Throws InputError if there are none.
std::vector<CcdFile> ccd_files(const std::filesystem::path& folder);

}  // namespace touchstone::files
