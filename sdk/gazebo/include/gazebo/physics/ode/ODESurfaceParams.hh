#error "Trundle's kit has no friction that changes while the simulation runs: set <mu>, <mu2> and <fdir1> in the model"
