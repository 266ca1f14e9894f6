"""A panoptic scene graph network from an ONNX file."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import onnxruntime
from numpy.typing import NDArray
from onnxruntime.capi import onnxruntime_pybind11_state as ort_errors

from perception.network.contract import INPUT, INSTANCE_OUTPUTS, Signature, check_declared, check_names, check_results
from perception.network.errors import NetworkUnreadable
from perception.network.frame_checks import FrameCheckSettings, check_frame
from perception.network.metadata import Description, read_metadata
from perception.network.postprocessing import Outputs, panoptic_scene
from perception.network.recognition import DistributionSettings
from perception.network.resize import Placement, input_tensor, place
from perception.objects.errors import InferenceFailed
from perception.panoptic import PanopticScene
from perception.ports import RgbdFrame

_WARM_UP_FRAME = (240, 320)
_QUIET = 3
"""Severity from which on onnxruntime speaks: errors."""
_ORT_ERRORS = tuple(
    error for error in vars(ort_errors).values() if isinstance(error, type) and issubclass(error, Exception)
)


@dataclass(frozen=True, kw_only=True)
class NetworkSettings:
    """How a network is run, and the stages before and after it."""

    threads: int = 2
    """Of the processor that one frame takes: the service needs the others."""
    busy_s: float = 10.0
    """Longest that a frame waits for an earlier one. Chosen."""
    frames: FrameCheckSettings = field(default_factory=FrameCheckSettings)
    distribution: DistributionSettings = field(default_factory=DistributionSettings)


class OnnxPanopticModel:
    """``PanopticModel`` of a file that keeps the contract; make one with ``load``.

    Attributes:
        file: its path.
        description: what the file says of itself.
    """

    def __init__(
        self,
        file: str,
        session: Any,
        description: Description,
        signature: Signature,
        settings: NetworkSettings = NetworkSettings(),
    ) -> None:
        self.file, self._settings = file, settings
        self.description = description
        self._session, self._signature = session, signature
        self._one_at_a_time = threading.Lock()

    @classmethod
    def load(cls, path: Path | str, settings: NetworkSettings = NetworkSettings()) -> OnnxPanopticModel:
        """Read a file, check it against the contract, and let it see one gray image, since free sizes show only then.

        Raises:
            NetworkRefused: it does not keep the contract; one sentence says where.
        """
        file = str(path)
        session = _open(Path(path), settings.threads)
        check_names(file, session.get_inputs(), session.get_outputs())
        description = read_metadata(file, session.get_modelmeta().custom_metadata_map)
        signature = check_declared(file, session.get_inputs()[0], session.get_outputs(), description)
        model = cls(file, session, description, signature, settings)
        placement = place(_WARM_UP_FRAME, description.resize, signature.canvas)
        gray = np.full((*_WARM_UP_FRAME, 3), 128, dtype=np.uint8)
        try:
            model._run(gray, placement, onnxruntime.RunOptions())
        except _ORT_ERRORS as error:
            raise NetworkUnreadable(file, f"does not run on an image: {_first_line(error)}") from error
        return model

    async def infer(self, frame: RgbdFrame) -> PanopticScene:
        """Instances and relations of ``frame``, worked out in a thread; who stops waiting also stops the network.

        Raises:
            InferenceFailed: the frame cannot be used, or the network gave numbers that are none.
            TensorMismatch: shapes that were right at first are wrong for this frame.
        """
        options = onnxruntime.RunOptions()
        try:
            return await asyncio.to_thread(self.understand, frame, options)
        except asyncio.CancelledError:
            options.terminate = True
            raise

    def understand(self, frame: RgbdFrame, options: Any = None) -> PanopticScene:
        """As ``infer``, in the calling thread. ``options``: onnxruntime's, to end the run early."""
        check_frame(frame, self._settings.frames)
        placement = self.placement(frame.rgb.shape[:2])
        if not self._one_at_a_time.acquire(timeout=self._settings.busy_s):
            raise InferenceFailed("the network is still busy with an earlier frame", frame.stamp_s)
        try:
            results = self._run(frame.rgb, placement, options or onnxruntime.RunOptions())
        except _ORT_ERRORS as error:
            raise InferenceFailed(_first_line(error), frame.stamp_s) from error
        finally:
            self._one_at_a_time.release()
        return panoptic_scene(
            _outputs(results, frame.stamp_s),
            self.description,
            placement,
            stamp_s=frame.stamp_s,
            settings=self._settings.distribution,
        )

    def placement(self, size: tuple[int, int]) -> Placement:
        """Where a frame of this height and width lies in the network's input."""
        return place(size, self.description.resize, self._signature.canvas)

    def _run(self, rgb: NDArray[np.uint8], placement: Placement, options: Any) -> dict[str, NDArray[np.float32]]:
        tensor = input_tensor(rgb, placement, self.description.mean, self.description.std)
        names = self._signature.outputs
        arrays = self._session.run(names, {INPUT: tensor}, options)
        results = {name: np.asarray(array, dtype=np.float32) for name, array in zip(names, arrays, strict=True)}
        check_results(self.file, results, self.description)
        return results


def _open(path: Path, threads: int) -> Any:
    """A session on the processor. Its threads do not spin while they wait: the service needs the cores as well."""
    if not path.is_file():
        raise NetworkUnreadable(str(path), "there is no such file")
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = threads
    options.inter_op_num_threads = 1
    options.log_severity_level = _QUIET
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    try:
        return onnxruntime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
    except _ORT_ERRORS as error:
        reason = f"is cut short or no ONNX model ({_first_line(error)})"
        raise NetworkUnreadable(str(path), reason) from error


def _outputs(results: Mapping[str, NDArray[np.float32]], stamp_s: float) -> Outputs:
    """The first image's arrays, all numbers finite.

    Raises:
        InferenceFailed: naming the outputs that hold other things than numbers.
    """
    broken = [
        name for name, array in results.items() if not np.isfinite((array.min(initial=0), array.max(initial=0))).all()
    ]
    if broken:
        raise InferenceFailed(f"the network gave no finite numbers in {', '.join(broken)}", stamp_s)
    first = {name: array[0] for name, array in results.items() if not name.endswith("_boxes")}
    for name, like in zip(INSTANCE_OUTPUTS, ("sub_logits", "sub_masks"), strict=True):
        first.setdefault(name, first[like][:0])
    return Outputs(**first)


def _first_line(error: Exception) -> str:
    return str(error).strip().splitlines()[0][:200] if str(error).strip() else type(error).__name__
