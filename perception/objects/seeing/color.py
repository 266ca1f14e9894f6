"""The color of a thing in common words, under whatever light falls on it.

Shading scales all three channels alike: hue and saturation stay, value falls. So hue names the color, and value only
decides where a name depends on it (black, gray, white; brown is dark orange, pink is pale red).
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

PALETTE = (
    "red", "orange", "yellow", "green", "cyan", "blue", "purple", "pink", "brown", "beige", "black", "gray", "white",
)  # fmt: skip
_HUE_EDGES_DEG = (13.0, 42.0, 68.0, 165.0, 198.0, 258.0, 298.0, 342.0)
_HUE_NAMES = ("red", "orange", "yellow", "green", "cyan", "blue", "purple", "pink", "red")
Image = NDArray[np.uint8]
Mask = NDArray[np.bool_]
Pixels = NDArray[np.uint8]
_NO_PIXELS: Pixels = np.empty((0, 3), dtype=np.uint8)


@dataclass(frozen=True, kw_only=True)
class ColorSettings:
    """Which pixels tell a color. Chosen on rendered things."""

    minimum_pixels: int = 6
    """Fewer tell nothing."""
    maximum_pixels: int = 400
    """More are not looked at."""
    accent_pixels: int = 60
    """A thing that is smaller in the picture tells nothing of accents."""
    accent_share: float = 0.04
    """Of the pixels of a thing, a part of another color is as large at least: the edges of a phone's case."""
    around_share: float = 0.1
    """A color that so much of what is around has may shine in from there."""
    ring_px: int = 3
    """How far around a thing one looks for that."""
    apart_px: int = 13
    """Farther than half of this from where a color is outside, it does not shine in."""


def colors_of(
    rgb: Image, mask: Mask, settings: ColorSettings = ColorSettings()
) -> tuple[dict[str, float], frozenset[str] | None]:
    """Share of each palette color among the pixels of ``mask``, empty where there are too few; and its accents.

    Accents are what colors a part of the thing has that is not of its main color: the case around a phone's screen, a
    tag; ``None`` where it is too small in the picture to tell. A color that shows only close to where it is outside as
    well is none of them: it may shine in where the mask is not exact.

    Args:
        rgb: (H, W, 3) image.
        mask: (H, W); its rim is left out because neighbors shine in there.
        settings: which pixels tell.
    """
    pixels = _core(rgb, mask, settings)
    if not len(pixels):
        return {}, None
    names = _names(pixels)
    shares = _shares(names)
    if len(pixels) < settings.accent_pixels:
        return shares, None
    main = max(shares, key=lambda name: shares[name])
    rest, least = pixels[names != main], settings.accent_share * len(pixels)
    if len(rest) < max(settings.minimum_pixels, least):
        return shares, frozenset()
    around = _shares(_names(_surroundings(rgb, mask, settings)))
    parts = {name for name, share in _shares(_names(rest)).items() if share * len(rest) >= least}
    inner = {name for name in parts - {main} if around.get(name, 0.0) < settings.around_share}
    doubtful = {name: _share_apart(rgb, mask, name, settings) for name in parts - inner - {main}}
    return shares, frozenset(inner | {name for name, apart in doubtful.items() if apart >= settings.accent_share})


def named_color(red: float, green: float, blue: float) -> str:
    """The palette name of one color, channels 0 to 255."""
    pixel = np.array(((red, green, blue),), dtype=np.uint8)
    return str(_names(pixel)[0])


def _core(rgb: Image, mask: Mask, settings: ColorSettings) -> Pixels:
    """Pixels of the mask without its rim, (N, 3), every so many of a large one; none where there are too few."""
    x, y, width, height = cv2.boundingRect(mask.astype(np.uint8))
    if width * height < settings.minimum_pixels:
        return _NO_PIXELS
    rows, columns = slice(y, y + height), slice(x, x + width)
    inside = np.ascontiguousarray(mask[rows, columns]).view(np.uint8)
    core = _without_rim(inside)
    if np.count_nonzero(core) < settings.minimum_pixels:
        core = inside > 0
    pixels = rgb[rows, columns][core]
    enough = len(pixels) >= settings.minimum_pixels
    return pixels[:: -(-len(pixels) // settings.maximum_pixels)] if enough else _NO_PIXELS


def _square(side_px: int) -> NDArray[np.uint8]:
    return np.ones((side_px, side_px), np.uint8)


def _without_rim(inside: NDArray[np.uint8]) -> Mask:
    return cv2.erode(inside, np.ones((3, 3), np.uint8), borderType=cv2.BORDER_CONSTANT, borderValue=0) > 0


def _with_ring(mask: Mask, ring_px: int) -> tuple[slice, slice]:
    """Rows and columns of the mask and of what is close around it."""
    x, y, width, height = cv2.boundingRect(mask.astype(np.uint8))
    rows = slice(max(y - ring_px, 0), y + height + ring_px)
    return rows, slice(max(x - ring_px, 0), x + width + ring_px)


def _surroundings(rgb: Image, mask: Mask, settings: ColorSettings) -> Pixels:
    """Pixels close around the mask, (N, 3)."""
    crop = _with_ring(mask, settings.ring_px)
    inside = np.ascontiguousarray(mask[crop]).view(np.uint8)
    return rgb[crop][cv2.dilate(inside, _square(2 * settings.ring_px + 1)) > inside]


def _share_apart(rgb: Image, mask: Mask, name: str, settings: ColorSettings) -> float:
    """Share of the mask without its rim that has a color, and is not close to where that color is outside."""
    crop = _with_ring(mask, settings.ring_px)
    inside, pixels = mask[crop], rgb[crop]
    named = (_names(pixels.reshape(-1, 3)) == name).reshape(inside.shape)
    near = cv2.dilate((named & ~inside).astype(np.uint8), _square(settings.apart_px)) > 0
    core = _without_rim(np.ascontiguousarray(inside).view(np.uint8))
    return float((named & core & ~near).sum() / max(core.sum(), 1))


def _shares(names: NDArray[np.str_]) -> dict[str, float]:
    found, counts = np.unique(names, return_counts=True)
    return {str(name): float(count) / len(names) for name, count in zip(found, counts, strict=True)}


def _names(pixels: Pixels) -> NDArray[np.str_]:
    """The palette color of each pixel (N, 3), as the light on all of them lets it seem."""
    if not len(pixels):
        return np.empty(0, dtype=np.str_)
    hsv = cv2.cvtColor(pixels.astype(np.float32)[None] / 255.0, cv2.COLOR_RGB2HSV)[0].astype(np.float64)
    hue_deg, saturation, value = hsv[:, 0], hsv[:, 1], hsv[:, 2]
    lit = float(np.quantile(value, 0.8))
    index = np.searchsorted(_HUE_EDGES_DEG, hue_deg)
    names = np.array(_HUE_NAMES, dtype=object)[index]
    pale_red = (names == "red") & (saturation < 0.55) & (lit > 0.6)
    names[pale_red] = "pink"
    dark_orange = ((names == "orange") | ((names == "red") & (hue_deg > 8.0) & (hue_deg < 20.0))) & (
        (lit < 0.5) | ((lit < 0.68) & (saturation < 0.88)) | ((lit < 0.8) & (saturation < 0.62))
    )
    names[dark_orange] = "brown"
    names[(names == "yellow") & (lit < 0.42) & (hue_deg < 50.0)] = "brown"
    names[(names == "yellow") & (lit < 0.56) & (hue_deg >= 50.0)] = "green"
    names[(hue_deg > 18.0) & (hue_deg < 65.0) & (saturation < 0.35) & (lit > 0.55)] = "beige"
    colorless = (saturation < 0.15) | (value < 0.08) | ((saturation < 0.3) & (value < 0.15))
    names[colorless] = _shade(lit)
    named: NDArray[np.str_] = names.astype(np.str_)
    return named


def _shade(lit: float) -> str:
    """Black, gray or white by the value of the brighter faces."""
    if lit < 0.2:
        return "black"
    return "white" if lit > 0.6 else "gray"
