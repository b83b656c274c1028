// ODE's friction pyramid for contacts with two different coefficients: friction in each direction is bounded by its
// coefficient times the load, independently of the other.
//
// MuJoCo's cone is an ellipse. Through every point of the pyramid's rectangle there is an ellipse around it whose
// normal there is the slip's direction, so that its friction is the pyramid's: both semi-axes grow, by the ratio of the
// two slips. The slips after the step are predicted from the step before. Equal coefficients keep Coulomb's cone.
#pragma once

#include "law_tables.h"

namespace trundle {

// True if a contact has a friction pyramid.
bool has_pyramid(const mjContact& contact);

// Set the ellipses of this step; call last, once the constraints are final.
void shape_pyramids(const LawTables& laws, const mjModel* m, mjData* d);

}  // namespace trundle
