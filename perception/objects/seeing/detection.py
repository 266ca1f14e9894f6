"""One frame's detections: every instance the network found, measured in three dimensions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from perception.objects.beliefs import LabelDistribution
from perception.objects.seeing.body import OwnBody
from perception.objects.seeing.color import ColorSettings, colors_of
from perception.objects.seeing.projection import Building, Cloud, ProjectionSettings, View, cloud_of
from perception.objects.seeing.shape import Shape, ShapeSettings, measure_shape
from perception.panoptic import Instance, PanopticScene
from perception.vocabulary import category_of, is_person


@dataclass(frozen=True, kw_only=True)
class DetectionSettings:
    """What of a frame is believed. Beyond ``range_limit_m`` things keep existing but are not measured."""

    projection: ProjectionSettings = field(default_factory=ProjectionSettings)
    range_limit_m: float = 4.5
    minimum_score: float = 0.15
    shape: ShapeSettings = field(default_factory=ShapeSettings)
    color: ColorSettings = field(default_factory=ColorSettings)
    same_mask_iou: float = 0.6
    """Of two masks that overlap as much, the surer one counts."""
    own_body_share: float = 0.5
    """What is the robot's own body to more than this is nothing."""
    hidden_share: float = 0.4
    """With so much of its rim hidden, the center of a thing does not count."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Detection:
    """An instance with its points and measures, in the room frame of the view.

    ``index`` is its place in the scene's instance list. ``measurable``: near, not cut by the image
    border and not mostly hidden, so that its center counts. ``accents``: colors besides the main one, where that can
    be told.
    """

    index: int
    label: str
    distribution: LabelDistribution
    mask: NDArray[np.bool_]
    cloud: Cloud
    shape: Shape
    colors: Mapping[str, float]
    in_range: bool
    measurable: bool
    accents: frozenset[str] | None = None

    @property
    def weight(self) -> float:
        """How good the view is, 0.2 to 1: small and cut things are told apart badly."""
        size = min(1.0, np.sqrt(self.cloud.pixels) / 20.0)
        return float(max(0.2, size * (1.0 if self.shape.complete else 0.6)))


def detections_of(
    scene: PanopticScene,
    rgb: NDArray[np.uint8],
    view: View,
    settings: DetectionSettings,
    own_body: OwnBody | None,
    building: Building,
) -> tuple[list[Detection], list[Detection]]:
    """Things and persons of one frame; background, doubles, the building and the robot's own arm are left out."""
    things: list[Detection] = []
    persons: list[Detection] = []
    for index in _without_doubles(scene.instances, settings):
        detection = _measure(index, scene.instances[index], rgb, view, settings, own_body, building)
        if detection is None:
            continue
        (persons if is_person(detection.label) else things).append(detection)
    return things, persons


def _measure(
    index: int,
    instance: Instance,
    rgb: NDArray[np.uint8],
    view: View,
    settings: DetectionSettings,
    own_body: OwnBody | None,
    building: Building,
) -> Detection | None:
    category = category_of(instance.label)
    before_walls = building if category.furniture and category.floor else None
    cloud = cloud_of(instance.mask, view, settings.projection, building=before_walls)
    cloud = _without_body(cloud, view, own_body, settings) if cloud is not None and own_body is not None else cloud
    if cloud is None:
        return None
    colors, accents = colors_of(rgb, instance.mask, settings.color)
    in_range = cloud.range_m <= settings.range_limit_m
    return Detection(
        index=index,
        label=instance.label,
        distribution=instance.label_distribution or ((instance.label, 1.0),),
        mask=instance.mask,
        cloud=cloud,
        shape=measure_shape(cloud, view, category, settings.shape),
        colors=colors,
        in_range=in_range,
        measurable=in_range and not cloud.truncated and cloud.occluded < settings.hidden_share,
        accents=accents,
    )


def _without_body(cloud: Cloud, view: View, own_body: OwnBody, settings: DetectionSettings) -> Cloud | None:
    """Without the robot's arm, which networks take for a part of what it reaches over, and which hides some of that;
    ``None`` if it is most of it.
    """
    own = own_body.covers(view.T_room_base.inverse().apply(cloud.points))
    if float(own.mean()) > settings.own_body_share:
        return None
    if not own.any():
        return cloud
    return replace(cloud, points=cloud.points[~own], occluded=max(cloud.occluded, float(own.mean())))


def _without_doubles(instances: tuple[Instance, ...], settings: DetectionSettings) -> list[int]:
    """Indices of instances that count; of two masks of the same pixels the surer one."""
    counted = [
        i
        for i, instance in enumerate(instances)
        if instance.score >= settings.minimum_score
        and not category_of(instance.label).background
        and instance.mask.any()
    ]
    if not counted:
        return []
    masks = np.stack([instances[i].mask[::2, ::2].ravel() for i in counted]).astype(np.float32)
    shared = masks @ masks.T
    areas = np.diag(shared)
    iou = shared / np.maximum(areas[:, None] + areas[None, :] - shared, 1.0)
    kept: list[int] = []
    for a in sorted(range(len(counted)), key=lambda a: (-instances[counted[a]].score, a)):
        if all(iou[a, b] < settings.same_mask_iou for b in kept):
            kept.append(a)
    return [counted[a] for a in sorted(kept)]
