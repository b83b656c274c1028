// Shorter and smoother paths: random shortcuts of all variables and of single ones, and cut corners.
#pragma once

#include <vector>

#include "validity.h"

namespace trundle::planning {

struct SimplifierSettings {
  int shortcuts = 100;
  int partial_shortcuts = 60;  // Geraerts and Overmars 2007
  int smoothings = 2;          // rounds in which corners are cut
};

double path_length(const StateSpace& space, const std::vector<State>& path);

// Shorten a valid path; every part is checked finely. Ends at the deadline at the latest.
void simplify(Validity& validity, std::vector<State>& path, const SimplifierSettings& settings, Random& random,
              const Deadline& deadline);

// First part of a path that is not valid; -1: none.
int find_invalid_part(Validity& validity, const std::vector<State>& path);

}  // namespace trundle::planning
