"""A Spark-DSG document as it is read: what is used of it, with its types. All else is left alone."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, field_validator

from scene_graph.spark_dsg.layers import METADATA, NO_LABEL

Point3 = tuple[float, float, float]
SymbolNumber = Annotated[int, Field(ge=0, lt=1 << 64)]


class _Part(BaseModel):
    model_config = ConfigDict(extra="ignore", allow_inf_nan=False, frozen=True)


class Quaternion(_Part):
    """A rotation."""

    w: float = 1.0
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class Box(_Part):
    """A bounding box; older files write other fields, and theirs counts as none."""

    type: str | int = "INVALID"
    dimensions: Point3 | None = None
    world_P_center: Point3 = (0.0, 0.0, 0.0)
    world_R_center: Quaternion = Quaternion()

    @property
    def size_m(self) -> Point3 | None:
        """Lengths along its own axes, if it is a box at all."""
        if self.type == "INVALID" or self.dimensions is None or min(self.dimensions) < 0.0:
            return None
        return self.dimensions


class Attributes(_Part):
    """Of a node of any kind. ``position``: in the map, meters."""

    type: str = ""
    position: Point3
    name: str = ""
    semantic_label: int = NO_LABEL
    semantic_class_probabilities: dict[str, float] = Field(default_factory=dict)
    last_update_time_ns: Annotated[int, Field(ge=0)] = 0
    distance: float = 0.0
    bounding_box: Box = Box()
    orientation: Quaternion | None = None
    world_R_object: Quaternion | None = None
    world_R_body: Quaternion | None = None
    metadata: dict[str, Any] = Field(default_factory=dict)

    @field_validator("metadata", mode="before")
    @classmethod
    def _nothing_is_empty(cls, value: object) -> object:
        return {} if value is None else value

    @property
    def own(self) -> dict[str, Any] | None:
        """What ``writer`` left here, if it was there."""
        told = self.metadata.get(METADATA)
        return told if isinstance(told, dict) else None

    @property
    def turned(self) -> Quaternion:
        """How it is turned in the map; not at all where nobody says."""
        return self.world_R_object or self.world_R_body or self.orientation or Quaternion()


class Node(_Part):
    """A node; ``partition`` 0 is the layer itself."""

    id: SymbolNumber
    layer: int
    partition: int = 0
    attributes: Attributes


class EdgeInfo(_Part):
    """What an edge tells."""

    metadata: dict[str, Any] | None = None


class Edge(_Part):
    """An edge within a layer, or from a node to one in a lower layer."""

    source: SymbolNumber
    target: SymbolNumber
    info: EdgeInfo = EdgeInfo()

    @property
    def own(self) -> list[dict[str, Any]]:
        """What ``writer`` left here."""
        told = (self.info.metadata or {}).get(METADATA)
        return [part for part in told if isinstance(part, dict)] if isinstance(told, list) else []


class Document(_Part):
    """The whole."""

    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...] = ()
    metadata: dict[str, Any] | None = None

    @property
    def own(self) -> dict[str, Any]:
        """What ``writer`` left here."""
        told = (self.metadata or {}).get(METADATA)
        return told if isinstance(told, dict) else {}

    def labels(self, layer: int) -> dict[int, str]:
        """Names of the semantic labels of a layer."""
        spaces = (self.metadata or {}).get("labelspaces")
        pairs = spaces.get(f"_l{layer}p0", ()) if isinstance(spaces, dict) else ()
        return {
            pair[0]: pair[1]
            for pair in pairs
            if isinstance(pair, list) and len(pair) == 2 and isinstance(pair[0], int) and isinstance(pair[1], str)
        }
