"""The skills there are: the built-in ones, and those of installed packages (entry point group ``majordomo.skills``)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from importlib.metadata import entry_points
from typing import cast

from skills.errors import DuplicateSkill, NotASkill, SkillNotFound
from skills.goto.goto import Goto
from skills.pick.pick import Pick
from skills.place.place import Place
from skills.settings import SkillSettings
from skills.skill import Skill

ENTRY_POINT_GROUP = "majordomo.skills"
BUILT_IN = "majordomo"
_MEMBERS = ("name", "parameters", "schema", "conditions", "effects", "cost_s", "actions", "confirmed")


class SkillRegistry(Mapping[str, Skill]):
    """Skills by name, in order of registration."""

    def __init__(self) -> None:
        """Empty; ``load_registry`` gives the usual one."""
        self._skills: dict[str, Skill] = {}
        self._origins: dict[str, str] = {}

    def register(self, skill: object, origin: str) -> None:
        """Add a skill; ``origin`` says who provides it.

        Raises:
            NotASkill: it lacks members of the protocol.
            DuplicateSkill: another skill has its name.
        """
        if missing := [member for member in _MEMBERS if not hasattr(skill, member)]:
            raise NotASkill(origin, missing)
        known = cast("Skill", skill)
        if known.name in self._skills:
            raise DuplicateSkill(known.name, self._origins[known.name], origin)
        self._skills[known.name], self._origins[known.name] = known, origin

    def __getitem__(self, name: str) -> Skill:
        if name not in self._skills:
            raise SkillNotFound(name, self._skills)
        return self._skills[name]

    def __contains__(self, name: object) -> bool:
        return name in self._skills

    def __iter__(self) -> Iterator[str]:
        return iter(self._skills)

    def __len__(self) -> int:
        return len(self._skills)

    def described(self) -> dict[str, str]:
        """What a language model reads of each skill: its docstring."""
        return {name: (type(skill).__doc__ or "").strip() for name, skill in self._skills.items()}

    def phrases(self) -> dict[str, tuple[str, ...]]:
        """What a person says for the skills of installed packages: *open {door}*, parameters in braces."""
        declared = {name: tuple(getattr(skill, "phrases", ())) for name, skill in self._skills.items()}
        return {name: phrases for name, phrases in declared.items() if phrases}


def load_registry(
    more: Iterable[tuple[str, object]] | None = None, settings: SkillSettings = SkillSettings()
) -> SkillRegistry:
    """The built-in skills, then those of installed packages; ``more`` (origin, skill) replaces the latter in tests.
    ``settings``: what the built-in ones plan by; they act by those of the robot's context.

    Raises:
        NotASkill: an entry point gives something else.
        DuplicateSkill: two packages provide one name.
    """
    registry = SkillRegistry()
    for skill in (Goto(settings.goto), Pick(settings.hand), Place(settings.place.spots)):
        registry.register(skill, BUILT_IN)
    for origin, skill_or_class in installed_skills() if more is None else more:
        registry.register(skill_or_class() if isinstance(skill_or_class, type) else skill_or_class, origin)
    return registry


def installed_skills() -> list[tuple[str, object]]:
    """(origin, skill or its class) from the entry points, sorted by name so that the order never changes."""
    points = sorted(entry_points(group=ENTRY_POINT_GROUP), key=lambda point: (point.name, point.value))
    return [(point.value, point.load()) for point in points]
