"""How the physics library is set up."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class PhysicsSettings:
    """Of the whole house: everything that has a body obeys these."""

    step_s: float = 1.0 / 240.0
    """Duration of a physics step, PyBullet's own; its contacts are tuned for it."""
    solver_iterations: int = 200
    """With fewer, friction creeps: what a level hand holds around its middle turns and falls when it is put down."""
    gravity_mps2: float = 9.81
    """On earth."""
    lateral_friction: float = 0.9
    """Chosen: nothing slides off a level top by itself."""
    spinning_friction: float = 0.004
    rolling_friction: float = 0.002
    """Enough that a ball on a table stays where it is put."""
    linear_damping: float = 0.05
    angular_damping: float = 0.2
    """Chosen: things come to rest and then sleep, which is what makes a house with many of them fast."""
    settle_steps: int = 120
    """Half a second at the start, in which things come to stand."""
