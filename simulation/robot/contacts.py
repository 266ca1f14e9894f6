"""How the robot's body and its fingers touch things."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class ContactSettings:
    """Of the robot's body and its fingers."""

    body_friction: float = 0.5
    """Chosen: painted metal and plastic."""
    finger_lateral_friction: float = 1.5
    finger_spinning_friction: float = 0.02
    finger_rolling_friction: float = 0.001
    """Chosen: as rubber pads, so that what the fingers press does not slide out."""
    finger_stiffness_npm: float = 2.0e4
    finger_damping_nspm: float = 200.0
    """Chosen: pads that give a little, so that a grip neither bounces nor sinks in."""
    position_gain: float = 0.3
    velocity_gain: float = 1.0
    """Of every servo, in PyBullet's units; chosen: its target is reached without overshoot."""
    gear_erp: float = 0.1
    gear_force_n: float = 100.0
    """How hard the fingers are held to mirror each other, as one drive moves both in a real gripper."""
    pressed_n: float = 0.05
    """A finger touches what it presses upon with more than this; less is the solver's noise."""
    touching_m: float = 0.001
    """What is nearer to a part of the body touches it, so exactly are shapes met; and so does what is pressed upon."""
    fresh_rad: float = 0.05
    """How far the hand turns before what its fingers hold is met anew. The solver keeps a contact with the normal, in
    the world, that it had when it began: after half a turn of the base, fingers would press a bottle aside and tilt it,
    and an open finger would go on holding it.
    """
    fresh_m: float = 0.004
    """How far the fingers open before that: a finger that has left what it held would go on carrying it."""
    still: float = 1e-3
    """A joint farther than this (rad, m) from its target is moving, and is held where it is when stopped."""
