// Shorter and smoother paths: random shortcuts of all variables and of single ones, and cut corners.
#pragma once

#include <vector>

#include "validity.h"

namespace trundle::planning {

struct SimplifierSettings {
  int shortcuts = 60;
  int partial_shortcuts = 30;  // Geraerts and Overmars 2007
  int patience = 15;           // shortcuts in a row that gain nothing
  double cut = 0.15;           // [rad, m] greatest length that is cut off before and after a corner
};

double path_length(const StateSpace& space, const std::vector<State>& path);

// Shorten a valid path; every part is checked finely. Ends at the deadline at the latest.
void simplify(Validity& validity, std::vector<State>& path, const SimplifierSettings& settings, Random& random,
              const Deadline& deadline);

// First part of a path that is not valid; -1: none.
int find_invalid_part(Validity& validity, const std::vector<State>& path);

}  // namespace trundle::planning
