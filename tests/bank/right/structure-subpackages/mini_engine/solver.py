from .core.solver import (
    apply_impulse, arms, effective_mass, friction_limit, relative_velocity, solve_friction, solve_normal, target_speed,
)
