"""World → MuJoCo model: bodies, joints, geoms, contact pairs, solver settings."""
