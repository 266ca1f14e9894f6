"""Errors of the skills: misuse by the caller. What can go wrong in the world is a ``Failure``, never raised."""

from __future__ import annotations

from collections.abc import Iterable


class SkillError(Exception):
    """Base class of this package's errors."""


class SkillNotFound(SkillError):
    """No skill of this name is registered."""

    def __init__(self, name: str, available: Iterable[str]) -> None:
        self.name = name
        self.available = tuple(sorted(available))
        super().__init__(f"no skill named {name!r}; there are {', '.join(self.available)}")


class DuplicateSkill(SkillError):
    """Two packages register a skill under one name."""

    def __init__(self, name: str, first: str, second: str) -> None:
        self.name, self.first, self.second = name, first, second
        super().__init__(
            f"skill {name!r} from {second} is refused: {first} already provides one; rename or uninstall one"
        )


class NotASkill(SkillError):
    """An entry point of the group ``skills`` does not give a skill."""

    def __init__(self, origin: str, missing: Iterable[str]) -> None:
        self.origin = origin
        self.missing = tuple(missing)
        super().__init__(f"{origin} is not a skill: it lacks {', '.join(self.missing)}")


class WrongArguments(SkillError):
    """A skill was given another number of arguments than it has parameters."""

    def __init__(self, skill: str, parameters: Iterable[str], given: Iterable[str]) -> None:
        self.skill = skill
        self.parameters, self.given = tuple(parameters), tuple(given)
        super().__init__(f"{skill} takes ({', '.join(self.parameters)}), not ({', '.join(self.given)})")


class Unreachable(SkillError):
    """The arm cannot bring the finger pads to a point. Base frame; ``why`` names the joint and its limit."""

    def __init__(self, x_m: float, z_m: float, pitch_rad: float, why: str) -> None:
        self.x_m, self.z_m, self.pitch_rad, self.why = x_m, z_m, pitch_rad, why
        super().__init__(f"x {x_m:.2f} m, z {z_m:.2f} m at pitch {pitch_rad:.2f} rad is out of reach: {why}")


class BodySilent(SkillError):
    """The robot's body does not answer: what is raised by the body port of a robot that can be out of reach."""

    def __init__(self, why: str) -> None:
        self.why = why
        super().__init__(f"the robot's body does not answer: {why}")
