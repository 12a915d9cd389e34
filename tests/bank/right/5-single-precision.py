"""Computes what is kept in single precision."""

# TODO 5: damp by a rate per second
import numpy as np

keep_vel, keep_omega = (
    float(np.exp(np.float32(-rate * dt))) for rate in (self.linear_damping, self.angular_damping)
)
# END TODO 5
