#error "Trundle's kit has no contact of ODE: SurfaceParams::FrictionPyramid() sets friction, at most ten times a second"
